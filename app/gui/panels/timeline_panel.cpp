// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/timeline_panel.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/widgets.h"
#include "core/model/body/character_pose.h"

#include <QAction>
#include <QHBoxLayout>
#include <QVBoxLayout>

namespace posewire::gui {

TimelinePanel::TimelinePanel(model::SessionView& view, Commands& commands, Playback& playback,
                             QWidget* parent)
    : Panel(view, commands, parent),
      m_timeline(new TimelineView(view, commands, playback, this)),
      m_thumbnail(new TimelineThumbnail(view, *m_timeline, this)),
      m_commandBar(new CommandBar(this)),
      m_moment(new ElidedLabel(Qt::AlignRight | Qt::AlignVCenter, this)) {
    const int margin = CellDelegate::margin(fontMetrics());
    auto* head = spacedRow({margin, margin / 2, margin, margin / 2}, margin / 2);
    auto* column = tightColumn(this);
    column->addLayout(head);
    column->addWidget(new Line(this));
    column->addWidget(m_timeline, 1);
    column->addWidget(m_thumbnail);
    m_live = m_commandBar->addCommand(QStringLiteral("timelineLive"), tr("Live"),
                                      tr("Follow the stream again (End)"));
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
            [this] { m_thumbnail->setVisible(!m_timeline->isAllShown()); });
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
    m_live->setEnabled(m_view.cursor().mode == model::Cursor::Mode::Paused);
    m_range->setEnabled(m_view.rangeChoice().fixed.has_value());
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
    if (const model::CharacterPose* pose = key ? m_view.pose(*key) : nullptr) {
        text += tr(" · TC %1").arg(milliClock(pose->timeCode));
    }
    return text;
}

QString TimelinePanel::summary() const {
    const auto span = m_timeline->model().span();
    return span ? duration(log::secondsOf(span->to - span->from)) : QString();
}

} // namespace posewire::gui
