// SPDX-License-Identifier: GPL-3.0-or-later
// How the timeline looks.
#include "app/gui/models/incident_words.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/panels/timeline_view.h"
#include "app/gui/theme/theme.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"

#include <QDateTime>
#include <QPainter>
#include <QScrollBar>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

namespace posewire::gui {

namespace {

using namespace std::chrono_literals;

constexpr double kLeastMark = 2.5; ///< pixels: what was lost is seen, however little

/// The shortest round step that is at least as long.
log::Duration roundStep(log::Duration least) {
    constexpr std::array<log::Duration, 33> kSteps{1us,   2us,   5us, 10us, 20us, 50us, 100us, 200us, 500us,
                                                   1ms,   2ms,   5ms, 10ms, 20ms, 50ms, 100ms, 200ms, 500ms,
                                                   1s,    2s,    5s,  10s,  15s,  30s,  1min,  2min,  5min,
                                                   10min, 30min, 1h,  3h,   6h,   12h};
    const auto step = std::ranges::lower_bound(kSteps, least);
    return step == kSteps.end() ? log::Duration(24h) : *step;
}

/// As exact as the step needs.
QString tickText(log::WallTime time, log::Duration step) {
    const QString whole = timeOfDay(time);
    if (step >= 1s) {
        return whole.chopped(4);
    }
    const auto micros = std::chrono::floor<std::chrono::microseconds>(time).time_since_epoch() % 1ms;
    return step >= 1ms ? whole : whole + QStringLiteral("%1").arg(micros / 1us, 3, 10, QLatin1Char('0'));
}

QString inSight(log::Duration length) {
    const double seconds = log::secondsOf(length);
    return seconds < 0.1 ? fixed(seconds * 1'000, 1) + QStringLiteral(" ms") : duration(seconds);
}

/// Marks of the worst lie on top of others.
std::vector<const model::Incident*> worstLast(const auto& incidents) {
    std::vector<const model::Incident*> ordered;
    std::ranges::transform(incidents, std::back_inserter(ordered), [](const auto& one) { return &one; });
    std::ranges::stable_sort(ordered, {}, [](const auto* one) { return one->severity(); });
    return ordered;
}

/// What came, by part. Parts about as long as a sample have one, two or none of it by chance: there each
/// counts with its neighbours, or a steady stream would look like a comb.
std::vector<double> heightsOf(const std::vector<model::RangePart>& parts,
                              const std::vector<TimelineModel::Gap>& gaps) {
    const auto cameIn = [&parts](std::size_t i) { return static_cast<double>(parts[i].datagrams); };
    const std::size_t spacing = TimelineModel::spacingOf(parts);
    std::vector<double> heights(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        heights[i] = cameIn(i);
        if ((spacing == 1 || spacing == 2) && i > 0 && i + 1 < parts.size()) {
            heights[i] = (cameIn(i - 1) + 2 * cameIn(i) + cameIn(i + 1)) / 4;
        }
    }
    for (const auto& [from, to] : gaps) {
        std::fill(heights.begin() + static_cast<std::ptrdiff_t>(from),
                  heights.begin() + static_cast<std::ptrdiff_t>(to), 0);
    }
    return heights;
}

} // namespace

void TimelineView::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(viewport());
    painter.fillRect(viewport()->rect(), theme().panel);
    if (!m_model.span() || m_model.rows().empty()) {
        drawEmptyText(*viewport(),
                      tr("No stream received yet.\nWhat each character sends appears here: when, how "
                         "much, and what was lost."));
        return;
    }
    for (std::size_t row = 0; row < m_model.rows().size(); ++row) {
        const QRect rect = rowRect(row);
        if (rect.bottom() >= rulerHeight() && rect.top() < viewport()->height()) {
            paintRow(painter, row);
        }
    }
    painter.setClipRect(namesWidth(), 0, stripWidth(), viewport()->height());
    paintRange(painter);
    painter.setClipping(false);
    paintRuler(painter);
    painter.setClipRect(namesWidth(), 0, stripWidth(), viewport()->height());
    paintIncidents(painter);
    paintCursor(painter);
    if (hasFocus()) {
        painter.setClipping(false);
        painter.setPen(theme().accent);
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(QRectF(viewport()->rect()).adjusted(0.5, 0.5, -0.5, -0.5));
    }
}

void TimelineView::paintRuler(QPainter& painter) const {
    const QRect ruler(0, 0, viewport()->width(), rulerHeight());
    painter.fillRect(ruler, theme().header);
    painter.setPen(theme().line);
    painter.drawLine(0, ruler.bottom(), ruler.right(), ruler.bottom());
    painter.drawLine(namesWidth(), 0, namesWidth(), viewport()->height());
    painter.setFont(tabularFont());
    const QFontMetrics metrics = painter.fontMetrics();
    const auto length = m_window.to - m_window.from;
    const auto stepFor = [&](const QString& text) {
        return roundStep(length * metrics.horizontalAdvance(text) / stripWidth());
    };
    const log::Duration coarse = stepFor(QStringLiteral("00:00:00.000   "));
    const log::Duration step = coarse < 1ms ? stepFor(QStringLiteral("00:00:00.000000   ")) : coarse;
    const int lane = fontMetrics().height();
    painter.setClipRect(namesWidth(), 0, stripWidth(), viewport()->height());
    // Ticks stand at round times of day, which is the local one.
    const auto wall = m_view.wallOf(m_window.from).time_since_epoch();
    const auto seconds = std::chrono::floor<std::chrono::seconds>(wall).count();
    const std::chrono::seconds offset(QDateTime::fromSecsSinceEpoch(seconds).offsetFromUtc());
    for (log::Stamp tick = m_window.from - (wall + offset) % step; tick < m_window.to; tick += step) {
        const double x = placeOf(tick);
        painter.setPen(theme().line);
        painter.drawLine(QPointF(x, lane * 0.3), QPointF(x, rulerHeight()));
        if (x < namesWidth()) {
            continue; // half a label says nothing
        }
        painter.setPen(theme().dim);
        painter.drawText(QPointF(x + 4, lane * 0.3 + metrics.ascent()), tickText(m_view.wallOf(tick), step));
    }
    painter.setClipping(false);
    painter.setFont(font());
    painter.setPen(theme().dim);
    const int margin = CellDelegate::margin(fontMetrics());
    painter.drawText(QRect(margin, 0, namesWidth() - margin, ruler.height()),
                     Qt::AlignVCenter | Qt::AlignLeft, tr("%1 in sight").arg(inSight(length)));
}

void TimelineView::paintIncidents(QPainter& painter) const {
    const double y = rulerHeight() - fontMetrics().height() / 2.0;
    const double size = fontMetrics().height() * 0.28;
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    double last = -2 * size;
    for (const model::Incident* one : worstLast(m_view.verdicts().incidents().all())) {
        const model::Incident& incident = *one;
        const double x = placeOf(incident.firstStamp);
        const bool goesOn = incident.isCurrent && incident.kind == model::IncidentKind::Outage;
        const double end = std::min<double>(placeOf(goesOn ? m_view.cursorStamp() : incident.lastStamp),
                                            viewport()->width());
        const Health health = healthOf(incident.severity());
        const bool isNote = incident.severity() == model::IncidentSeverity::Info;
        painter.setBrush(isNote ? theme().dim : healthColour(health));
        if (!isNote && end > namesWidth() && x < viewport()->width()) { // how long it lasted
            painter.drawRect(
                QRectF(std::max<double>(x, namesWidth()), rulerHeight() - 2.5, std::max(0.0, end - x), 2));
        }
        const bool isSeen = x >= namesWidth() && x <= viewport()->width() && std::abs(x - last) >= 1;
        if (!isSeen) {
            continue;
        }
        last = x;
        if (health == Health::Error) {
            painter.drawRect(QRectF(x - size, y - size, 2 * size, 2 * size));
        } else if (health == Health::Warning) {
            painter.drawPolygon(QPolygonF({{x - size, y + size}, {x + size, y + size}, {x, y - size}}));
        } else {
            painter.drawEllipse(QPointF(x, y), size * 0.8, size * 0.8);
        }
    }
    painter.setRenderHint(QPainter::Antialiasing, false);
}

void TimelineView::paintRow(QPainter& painter, std::size_t row) {
    const TimelineModel::Row& shown = m_model.shown(row);
    const QRect rect = rowRect(row);
    const int margin = CellDelegate::margin(fontMetrics());
    if (row % 2 == 1) {
        painter.fillRect(rect, withAlpha(theme().raised, 0.5));
    }
    const bool isSelected = m_view.roster().isSelected(shown.character) && !shown.type;
    if (isSelected) {
        painter.fillRect(QRect(rect.left(), rect.top(), namesWidth(), rect.height()), theme().selection);
    }
    painter.setClipRect(0, rulerHeight(), namesWidth(), viewport()->height());
    QRect name(rect.left() + margin, rect.top(), namesWidth() - 2 * margin, rect.height());
    const int indent = fontMetrics().height();
    painter.setPen(shown.type ? theme().dim : theme().text);
    if (shown.type) {
        name.setLeft(name.left() + 2 * indent);
    } else {
        painter.drawText(name, Qt::AlignLeft | Qt::AlignVCenter,
                         shown.isOpen ? QStringLiteral("▾") : QStringLiteral("▸"));
        name.setLeft(name.left() + indent);
        name.setLeft(name.left() + CellDelegate::paintBefore(painter, name, indent / 2, shown.mark));
        painter.setPen(theme().text);
    }
    painter.drawText(name, Qt::AlignLeft | Qt::AlignVCenter,
                     fontMetrics().elidedText(shown.name, Qt::ElideRight, name.width()));
    const QRect strip(namesWidth() + 1, rect.top(), stripWidth() - 1, rect.height());
    painter.setClipRect(
        strip.intersected(QRect(0, rulerHeight(), viewport()->width(), viewport()->height())));
    paintStrip(painter, shown, strip);
    painter.setClipping(false);
}

/// As high as the part with most, with the share that was lost at the bottom; where nothing came for longer
/// than usual it is hatched.
void TimelineView::paintStrip(QPainter& painter, const TimelineModel::Row& row, const QRect& strip) const {
    const model::RangeParts& parts = m_model.parts();
    const std::vector<TimelineModel::Gap> gaps = TimelineModel::gapsIn(row.parts);
    const std::vector<double> heights = heightsOf(row.parts, gaps);
    const double most = heights.empty() ? 1 : std::max(1e-9, std::ranges::max(heights));
    const double room = strip.height() - 5.0;
    const double bottom = strip.bottom() - 1.0;
    const QColor colour = withAlpha(row.mark.colour, row.type ? 0.45 : 0.7);
    painter.setPen(Qt::NoPen);
    for (const auto& [from, to] : gaps) {
        const double left = placeOf(parts.beginOf(from));
        painter.fillRect(QRectF(left, bottom - room, placeOf(parts.beginOf(to)) - left, room),
                         QBrush(withAlpha(theme().dim, 0.6), Qt::BDiagPattern));
    }
    for (std::size_t i = 0; i < row.parts.size(); ++i) {
        const model::RangePart& part = row.parts[i];
        const double left = placeOf(parts.beginOf(i));
        const double right = std::max(left + 1, placeOf(parts.beginOf(i + 1)));
        if (heights[i] > 0) {
            const double height = std::max(2.0, room * heights[i] / most);
            painter.fillRect(QRectF(left, bottom - height, right - left, height), colour);
        }
        if (part.lost != 0) {
            const double share = static_cast<double>(part.lost) / (part.lost + part.samples);
            const double height = std::max(kLeastMark, room * share);
            painter.fillRect(QRectF(left, bottom - height, std::max(kLeastMark, right - left), height),
                             theme().warning);
        }
    }
}

void TimelineView::paintRange(QPainter& painter) const {
    const auto range = m_view.range();
    if (!range || !m_view.choices().range.fixed) {
        return;
    }
    const QRectF shade(QPointF(placeOf(range->from), 0),
                       QPointF(std::max(placeOf(range->to), placeOf(range->from) + 1), viewport()->height()));
    painter.fillRect(shade, withAlpha(theme().accent, 0.16));
    painter.setPen(theme().accent);
    painter.drawLine(shade.topLeft(), shade.bottomLeft());
    painter.drawLine(shade.topRight(), shade.bottomRight());
}

void TimelineView::paintCursor(QPainter& painter) const {
    const double x = placeOf(m_view.cursorStamp());
    const double head = fontMetrics().height() * 0.35;
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(theme().text, 1.5));
    painter.drawLine(QPointF(x, head), QPointF(x, viewport()->height()));
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme().text);
    painter.drawPolygon(QPolygonF({{x - head, 0}, {x + head, 0}, {x, head * 1.4}}));
    painter.setRenderHint(QPainter::Antialiasing, false);
}

} // namespace posewire::gui
