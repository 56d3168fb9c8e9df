// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/timeline_panel.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/panels/range_bar.h"
#include "app/gui/theme/theme.h"
#include "core/model/body/character_pose.h"
#include "core/model/session/messages.h"

#include <QAction>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>

namespace posewire::gui {

TimelinePanel::TimelinePanel(model::SessionView& view, Commands& commands, Playback& playback,
                             QWidget* parent)
    : Panel(view, commands, parent), m_timeline(new TimelineView(view, commands, playback, this)) {
    const int margin = CellDelegate::margin(fontMetrics());
    auto* head = spacedRow({margin, margin / 2, margin, margin / 2}, margin / 2);
    auto* column = tightColumn(this);
    column->addLayout(head);
    column->addWidget(new Line(this));
    column->addWidget(m_timeline, 1);
    column->addWidget(m_thumbnail);
    m_live = m_commandBar->addCommand(QStringLiteral("timelineLive"), tr("Live"),
                                      tr("Follow the stream again (L)"));
    QAction* all =
        m_commandBar->addCommand(QStringLiteral("timelineAll"), tr("All"), tr("Show all there is (0)"));
    QAction* out =
        m_commandBar->addCommand(QStringLiteral("timelineOut"), QStringLiteral("−"), tr("Zoom out (−)"));
    QAction* in =
        m_commandBar->addCommand(QStringLiteral("timelineIn"), QStringLiteral("+"), tr("Zoom in (+)"));
    m_range = m_commandBar->addCommand(QStringLiteral("timelineRange"), tr("Selection"),
                                       tr("Show the selected range"));
    head->addWidget(m_commandBar);
    head->addWidget(m_moment, 1);
    m_moment->setToolTip(
        tr("The moment that is shown: by this computer's clock, since the first packet, and by the "
           "time code of the selected character"));
    m_moment->setObjectName(QStringLiteral("moment"));
    m_timeline->setObjectName(QStringLiteral("timelineView"));
    connect(m_live, &QAction::triggered, this, [&playback] { playback.goLive(); });
    connect(all, &QAction::triggered, this, &TimelinePanel::showAll);
    connect(m_range, &QAction::triggered, this, &TimelinePanel::showRange);
    m_thumbnail->hide();
    connect(m_timeline, &TimelineView::windowChanged, m_thumbnail,
            [this](bool isAll) { m_thumbnail->setVisible(!isAll); });
    connect(out, &QAction::triggered, this, &TimelinePanel::zoomOut);
    connect(in, &QAction::triggered, this, &TimelinePanel::zoomIn);
}

std::span<const ActionInfo> TimelinePanel::actionTable() {
    using Do = ActionsOf<TimelinePanel>;
    static constexpr const char* kMenu = QT_TRANSLATE_NOOP("Action", "&View/Tim&eline");
    static constexpr ActionInfo kActions[] = {
        {"timelineZoomIn", kMenu, QT_TRANSLATE_NOOP("Action", "Zoom &in"), "Ctrl++",
         Do::call<&TimelinePanel::zoomIn>},
        {"timelineZoomOut", kMenu, QT_TRANSLATE_NOOP("Action", "Zoom &out"), "Ctrl+-",
         Do::call<&TimelinePanel::zoomOut>},
        {"timelineShowAll", kMenu, QT_TRANSLATE_NOOP("Action", "&All there is"), "",
         Do::call<&TimelinePanel::showAll>},
        {"timelineShowRange", kMenu, QT_TRANSLATE_NOOP("Action", "The &selected range"), "",
         Do::call<&TimelinePanel::showRange>},
        {"timelineStreams", kMenu, QT_TRANSLATE_NOOP("Action", "Streams of t&he selected character"), "",
         Do::call<&TimelinePanel::toggleStreams>},
    };
    return kActions;
}

void TimelinePanel::refresh() {
    m_timeline->refresh();
    m_thumbnail->refresh();
    m_live->setVisible(!m_view.isRecording());
    m_live->setEnabled(m_view.choices().cursor.mode == model::Cursor::Mode::Paused);
    m_range->setEnabled(m_view.choices().range.fixed.has_value());
    m_moment->setText(momentText());
}

QString TimelinePanel::momentText() const {
    if (m_view.end() == 0) {
        return {};
    }
    const log::Stamp moment = m_view.cursorStamp();
    QString text =
        tr("%1 · +%2 s")
            .arg(timeOfDay(m_view.wallOf(moment)), fixed(log::secondsOf(moment - m_view.firstStamp()), 3));
    const auto key = shownCharacter(m_view);
    if (const model::CharacterPose* pose = key ? m_view.messages().pose(*key) : nullptr) {
        text += tr(" · TC %1").arg(milliClock(pose->timeCode));
    }
    return text;
}

QString TimelinePanel::summary() const {
    const auto span = m_timeline->model().span();
    return span ? duration(log::secondsOf(span->to - span->from)) : QString();
}

namespace {

constexpr double kLeastLens = 6; // pixels: it can be seen, however short the window is

using Nanoseconds = std::chrono::duration<double, std::nano>;

} // namespace

TimelineThumbnail::TimelineThumbnail(model::SessionView& view, TimelineView& timeline, QWidget* parent)
    : QWidget(parent), m_timeline(timeline), m_overview(view) {
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    setToolTip(tr("All there is, with losses marked; drag to move what the timeline shows"));
    connect(&timeline, &TimelineView::windowChanged, this, [this] { update(); });
}

void TimelineThumbnail::refresh() {
    m_overview.refresh();
    update();
}

QRectF TimelineThumbnail::strip() const {
    return QRectF(rect()).adjusted(m_timeline.namesWidth() + 1, 1, 0, 0);
}

QRectF TimelineThumbnail::lens() const {
    const model::TimeRange& span = m_overview.span();
    const Nanoseconds length = std::max(log::Duration(1), span.to - span.from);
    const QRectF all = strip();
    const double from = (m_timeline.window().from - span.from) / length * all.width();
    const double wide = (m_timeline.window().to - m_timeline.window().from) / length * all.width();
    const double shown = std::clamp(wide, kLeastLens, all.width());
    const double left = std::clamp(from - (shown - wide) / 2, 0.0, all.width() - shown);
    return {all.left() + left, all.top(), shown, all.height()};
}

void TimelineThumbnail::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.fillRect(rect(), theme().header);
    painter.fillRect(QRect(0, 0, width(), 1), theme().line);
    if (m_overview.empty()) {
        return;
    }
    const int margin = CellDelegate::margin(fontMetrics());
    painter.setPen(theme().dim);
    painter.drawText(QRect(margin, 0, m_timeline.namesWidth() - margin, height()),
                     Qt::AlignVCenter | Qt::AlignLeft, tr("All"));
    paintOverview(painter, m_overview, strip());
    const QRectF shown = lens();
    const QColor shade = withAlpha(theme().header, 0.6);
    painter.fillRect(QRectF(strip().topLeft(), QPointF(shown.left(), strip().bottom())), shade);
    painter.fillRect(QRectF(shown.topRight(), strip().bottomRight()), shade);
    painter.setPen(QPen(theme().accent, 1));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(shown.adjusted(0.5, 0.5, -0.5, -0.5));
}

void TimelineThumbnail::mousePressEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton) {
        moveTo(event->position().x());
    }
}

void TimelineThumbnail::mouseMoveEvent(QMouseEvent* event) {
    if (event->buttons().testFlag(Qt::LeftButton)) {
        moveTo(event->position().x());
    }
}

/// The middle of what the timeline shows.
void TimelineThumbnail::moveTo(double place) {
    if (m_overview.empty()) {
        return;
    }
    const model::TimeRange& span = m_overview.span();
    const double share = std::clamp((place - strip().left()) / std::max(1.0, strip().width()), 0.0, 1.0);
    const log::Stamp middle =
        span.from + std::chrono::duration_cast<log::Duration>(share * Nanoseconds(span.to - span.from));
    const log::Duration half = (m_timeline.window().to - m_timeline.window().from) / 2;
    m_timeline.setWindow({middle - half, middle + half});
}

} // namespace posewire::gui
