// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/range_bar.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"
#include "core/model/accounting/count_history.h"
#include "core/model/session/verdict.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>
#include <cmath>

namespace posewire::gui {

namespace {

/// With fractions.
using Nanoseconds = std::chrono::duration<double, std::nano>;

constexpr double kGrip = 4; // pixels at either side of an edge

double placeIn(const QRectF& rect, const model::TimeRange& span, log::Stamp stamp) {
    const Nanoseconds length = std::max(log::Duration(1), span.to - span.from);
    return std::clamp(rect.left() + (stamp - span.from) / length * rect.width(), rect.left(), rect.right());
}

void paintRate(QPainter& painter, const RangeOverview& overview, const QRectF& rect) {
    const model::RangeParts& parts = overview.parts();
    const auto& counted = overview.counted();
    // The last part is still being filled: it would always look like a loss.
    const std::size_t count =
        parts.beginOf(parts.count) > overview.span().to && parts.count > 1 ? parts.count - 1 : parts.count;
    std::uint32_t most = 1;
    for (std::size_t i = 0; i < count; ++i) {
        most = std::max(most, counted[i].datagrams);
    }
    const auto placeOf = [&](log::Stamp stamp) { return placeIn(rect, overview.span(), stamp); };
    const double scale = (rect.height() - 4.0) / most;
    QPolygonF area{{placeOf(parts.first), rect.bottom()}};
    double right = rect.left();
    for (std::size_t i = 0; i < count; ++i) {
        const double y = rect.bottom() - counted[i].datagrams * scale;
        right = i + 1 == count ? rect.right() : placeOf(parts.beginOf(i + 1));
        area << QPointF(placeOf(parts.beginOf(i)), y) << QPointF(right, y);
    }
    area << QPointF(right, rect.bottom());
    painter.setBrush(withAlpha(theme().accent, 0.35));
    painter.drawPolygon(area);
}

void paintLosses(QPainter& painter, const RangeOverview& overview, const QRectF& rect) {
    const model::RangeParts& parts = overview.parts();
    painter.setBrush(theme().warning);
    for (std::size_t i = 0; i < parts.count; ++i) {
        if (overview.counted()[i].lost != 0) {
            const double left = placeIn(rect, overview.span(), parts.beginOf(i));
            const double right = placeIn(rect, overview.span(), parts.beginOf(i + 1));
            const double high = std::max(kLeastMark, rect.height() * overview.counted()[i].lossShare());
            painter.drawRect(QRectF(left, rect.bottom() - high, std::max(kLeastMark, right - left), high));
        }
    }
}

} // namespace

RangeStrip::RangeStrip(model::SessionView& view, Commands& commands, QWidget* parent)
    : QWidget(parent), m_view(view), m_commands(commands), m_overview(view) {
    setMouseTracking(true);
    setCursor(Qt::IBeamCursor);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setAccessibleName(tr("Range of time"));
}

void RangeStrip::refresh() {
    m_overview.refresh();
    update();
}

double RangeStrip::placeOf(log::Stamp stamp) const {
    const model::TimeRange& span = m_overview.span();
    const Nanoseconds length = std::max(log::Duration(1), span.to - span.from);
    return (stamp - span.from) / length * width();
}

log::Stamp RangeStrip::stampAt(double place) const {
    const model::TimeRange& span = m_overview.span();
    const double share = std::clamp(place / std::max(1, width()), 0.0, 1.0);
    return span.from + std::chrono::duration_cast<log::Duration>(share * (span.to - span.from));
}

void RangeStrip::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.fillRect(rect(), theme().raised);
    if (m_overview.empty()) {
        painter.setPen(theme().dim);
        painter.drawText(rect(), Qt::AlignCenter, tr("no history yet"));
    } else {
        paintOverview(painter, m_overview, rect());
        paintForgotten(painter, QRectF(0, 0, placeOf(m_view.keptSince()), height()));
        paintRange(painter);
        paintCursor(painter);
    }
}

void RangeStrip::paintRange(QPainter& painter) const {
    const auto range = m_view.range();
    if (!range) {
        return;
    }
    const double from = std::clamp(placeOf(range->from), 0.0, width() - 1.0);
    const double to = std::clamp(placeOf(range->to), from + 1, static_cast<double>(width()));
    const QColor shade = withAlpha(theme().panel, 0.62);
    painter.fillRect(QRectF(0, 0, from, height()), shade);
    painter.fillRect(QRectF(to, 0, width() - to, height()), shade);
    painter.setPen(QPen(theme().accent, 2));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(QRectF(from, 0, to - from, height()).adjusted(1, 1, -1, -1));
}

/// Only where it is not at the end.
void RangeStrip::paintCursor(QPainter& painter) const {
    if (m_view.choices().cursor.mode == model::Cursor::Mode::Paused) {
        const double x = std::clamp(placeOf(m_view.cursorStamp()), 0.0, width() - 1.0);
        painter.setPen(QPen(theme().text, 1.5));
        painter.drawLine(QPointF(x, 0), QPointF(x, height()));
    }
}

void RangeStrip::choose(log::Stamp from, log::Stamp to) {
    const model::TimeRange& span = m_overview.span();
    const log::Duration resolution = m_overview.resolution();
    model::TimeRange range{std::min(from, to), std::max(from, to)};
    range.from = std::clamp(range.from, span.from, span.to);
    range.to = std::clamp(range.to, range.from, span.to);
    // As buckets go: what is shown as chosen is what is counted.
    range.from = model::roundedDown(range.from, resolution);
    range.to = model::roundedUp(range.to, resolution);
    if (range.to == range.from) {
        range.to += resolution;
    }
    m_commands.selectRange({log::Duration::zero(), range});
    update();
}

std::optional<log::Stamp> RangeStrip::otherEnd(double place) const {
    const auto range = m_view.range();
    if (range && std::abs(place - placeOf(range->from)) <= kGrip) {
        return range->to;
    }
    return range && std::abs(place - placeOf(range->to)) <= kGrip ? std::optional(range->from) : std::nullopt;
}

void RangeStrip::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || m_overview.empty()) {
        return;
    }
    const double place = event->position().x();
    m_pressed = place;
    m_isMoved = false;
    m_anchor = otherEnd(place).value_or(stampAt(place));
}

void RangeStrip::mouseMoveEvent(QMouseEvent* event) {
    const double place = event->position().x();
    if (!m_anchor) {
        setCursor(otherEnd(place) ? Qt::SizeHorCursor : Qt::IBeamCursor);
        return;
    }
    if (m_isMoved || std::abs(place - m_pressed) >= kGrip) {
        m_isMoved = true;
        choose(*m_anchor, stampAt(place));
    }
}

void RangeStrip::mouseReleaseEvent(QMouseEvent*) {
    if (m_anchor && !m_isMoved) {
        m_commands.selectRange({}); // a click beside the range takes it away, as in any text
        update();
    }
    m_anchor.reset();
}

QString RangeStrip::partText(double place) const {
    const model::RangeParts& parts = m_overview.parts();
    const log::Duration at = stampAt(place) - parts.first;
    const auto part = static_cast<std::size_t>(std::max(log::Duration::zero(), at) / parts.width);
    if (part >= parts.count) {
        return {};
    }
    const model::RangePart& counted = m_overview.counted()[part];
    const double seconds = log::secondsOf(parts.width);
    return tr("%1: %2 datagrams/s, %3 samples lost\nDrag to choose a range.")
        .arg(timeOfDay(m_view.wallOf(parts.beginOf(part))).chopped(4), fixed(counted.datagrams / seconds, 0),
             grouped(counted.lost));
}

bool RangeStrip::event(QEvent* event) {
    if (event->type() == QEvent::ToolTip && !m_overview.empty()) {
        const auto* help = static_cast<QHelpEvent*>(event);
        QToolTip::showText(help->globalPos(), toolTipText(partText(help->pos().x())), this);
        return true;
    }
    return QWidget::event(event);
}

RangeBar::RangeBar(model::SessionView& view, Commands& commands, QWidget* parent)
    : QWidget(parent),
      m_view(view),
      m_strip(new RangeStrip(view, commands, this)),
      m_span(new SpanBar(view, commands, this)) {
    const int margin = CellDelegate::margin(fontMetrics());
    auto* column = tightColumn(this);
    auto* row = spacedRow({margin, margin / 2, margin, margin / 2}, margin / 2);
    row->addWidget(m_strip, 1);
    row->addWidget(m_span);
    column->addLayout(row);
    column->addWidget(m_verdict);
    m_verdict->setObjectName(QStringLiteral("rangeVerdict"));
    m_verdict->setContentsMargins(margin, 0, margin, margin / 2);
    m_verdict->setWordWrap(true);
}

void RangeBar::refresh() {
    m_strip->refresh();
    m_span->refresh();
    const auto& range = m_view.choices().range.fixed;
    m_verdict->setVisible(range.has_value());
    if (range) {
        const PropertyValue verdict = verdictState(verdictOf(m_view, model::spanOf(m_view, range)));
        m_verdict->setText(healthText(verdict.health, verdict.toolTip));
        setTextColour(*m_verdict, healthColour(verdict.health));
    }
}

void paintOverview(QPainter& painter, const RangeOverview& overview, const QRectF& rect) {
    painter.setPen(Qt::NoPen);
    paintRate(painter, overview, rect);
    paintLosses(painter, overview, rect);
}

SpanBar::SpanBar(model::SessionView& view, Commands& commands, QWidget* parent)
    : QWidget(parent), m_view(view), m_commands(commands) {
    static_cast<void>(spacedRow({}, CellDelegate::margin(fontMetrics()) / 2, this));
    add(tr("10 s"), tr("Figures of the last ten seconds"),
        model::RangeChoice{.last = std::chrono::seconds(10)});
    add(tr("1 min"), tr("Figures of the last minute"), model::RangeChoice{.last = std::chrono::seconds(60)});
    add(tr("Since reset"), tr("Figures since the reset before the take"),
        model::RangeChoice{.isSinceReset = true});
    add(tr("Selection"), tr("Figures of the range that was dragged in the strip; press to leave it"), {});
    add(tr("All"), tr("Figures of everything received"), model::RangeChoice{});
    refresh();
}

void SpanBar::add(const QString& text, const QString& toolTip,
                  const std::optional<model::RangeChoice>& choice) {
    QToolButton* button = framedButton(text, toolTip, this);
    button->setCheckable(true);
    button->setFocusPolicy(Qt::StrongFocus);
    layout()->addWidget(button);
    m_buttons.push_back({button, choice});
    connect(button, &QToolButton::clicked, this, [this, choice] {
        m_commands.selectRange(choice.value_or(model::RangeChoice{}));
        refresh();
    });
}

void SpanBar::refresh() {
    const model::RangeChoice& chosen = m_view.choices().range;
    for (const auto& [button, choice] : m_buttons) {
        const bool isDragged = !choice && chosen.fixed;
        const bool isThere =
            choice ? !choice->isSinceReset || m_view.choices().reset != log::Stamp() : isDragged;
        button->setChecked(isDragged || choice == std::optional(chosen));
        button->setVisible(isThere);
    }
}

} // namespace posewire::gui
