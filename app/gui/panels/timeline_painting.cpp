// SPDX-License-Identifier: GPL-3.0-or-later
// How the timeline looks.
#include "app/gui/models/incident_words.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/panels/time_ruler.h"
#include "app/gui/panels/timeline_view.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"

#include <QPainter>
#include <QScrollBar>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

namespace posewire::gui {

namespace {

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

class TimelinePainter {
public:
    explicit TimelinePainter(TimelineView& timeline) : m_timeline(timeline) {}

    void paint() {
        m_painter.fillRect(m_room, theme().panel);
        if (!m_model.span() || m_model.rows().empty()) {
            drawEmptyText(
                *m_timeline.viewport(),
                TimelineView::tr("No stream received yet.\nWhat each character sends appears here: when, how "
                                 "much, and what was lost."));
            return;
        }
        for (std::size_t row = 0; row < m_model.rows().size(); ++row) {
            const QRect rect = rowRect(row);
            if (rect.bottom() >= m_ruler && rect.top() < m_room.height()) {
                paintRow(row);
            }
        }
        m_painter.setClipRect(m_strips);
        paintForgotten(m_painter, QRectF(QPointF(m_timeline.placeOf(m_window.from), m_ruler),
                                         QPointF(m_timeline.placeOf(m_view.keptSince()), m_room.height())));
        paintRange();
        m_painter.setClipping(false);
        paintRuler();
        m_painter.setClipRect(m_strips);
        paintIncidents();
        paintCursor();
        if (m_timeline.hasFocus()) {
            m_painter.setClipping(false);
            m_painter.setPen(theme().accent);
            m_painter.setBrush(Qt::NoBrush);
            m_painter.drawRect(QRectF(m_room).adjusted(0.5, 0.5, -0.5, -0.5));
        }
    }

private:
    [[nodiscard]] QRect rowRect(std::size_t row) const {
        const int top = m_ruler + static_cast<int>(row) * m_timeline.rowHeight() -
                        m_timeline.verticalScrollBar()->value();
        return {0, top, m_room.width(), m_timeline.rowHeight()};
    }

    void paintRuler() {
        const QRect ruler(0, 0, m_room.width(), m_ruler);
        m_painter.fillRect(ruler, theme().header);
        m_painter.setPen(theme().line);
        m_painter.drawLine(0, ruler.bottom(), ruler.right(), ruler.bottom());
        m_painter.drawLine(m_names, 0, m_names, m_room.height());
        m_painter.setFont(tabularFont());
        const QFontMetrics metrics = m_painter.fontMetrics();
        const int lane = m_metrics.height();
        m_painter.setClipRect(m_strips);
        for (const TimeTick& tick : timeTicks(m_view, m_window, m_timeline.stripWidth(), metrics)) {
            const double x = m_timeline.placeOf(tick.stamp);
            m_painter.setPen(theme().line);
            m_painter.drawLine(QPointF(x, lane * 0.3), QPointF(x, m_ruler));
            if (x < m_names) {
                continue; // half a label says nothing
            }
            m_painter.setPen(theme().dim);
            m_painter.drawText(QPointF(x + 4, lane * 0.3 + metrics.ascent()), tick.text);
        }
        m_painter.setClipping(false);
        m_painter.setFont(m_timeline.font());
        m_painter.setPen(theme().dim);
        const int margin = CellDelegate::margin(m_metrics);
        m_painter.drawText(QRect(margin, 0, m_names - margin, ruler.height()),
                           Qt::AlignVCenter | Qt::AlignLeft,
                           TimelineView::tr("%1 in sight").arg(inSight(m_window.to - m_window.from)));
    }

    void paintIncidents() {
        const double y = m_ruler - m_metrics.height() / 2.0;
        const double size = m_metrics.height() * 0.28;
        m_painter.setRenderHint(QPainter::Antialiasing);
        m_painter.setPen(Qt::NoPen);
        double last = -2 * size;
        for (const model::Incident* one : worstLast(m_view.verdicts().incidents().all())) {
            const model::Incident& incident = *one;
            const double x = m_timeline.placeOf(incident.firstStamp);
            const bool goesOn = incident.isCurrent && incident.kind == model::IncidentKind::Outage;
            const double end = std::min<double>(
                m_timeline.placeOf(goesOn ? m_view.cursorStamp() : incident.lastStamp), m_room.width());
            const Health health = healthOf(incident.severity());
            const bool isNote = incident.severity() == model::IncidentSeverity::Info;
            m_painter.setBrush(isNote ? theme().dim : healthColour(health));
            if (!isNote && end > m_names && x < m_room.width()) { // how long it lasted
                m_painter.drawRect(
                    QRectF(std::max<double>(x, m_names), m_ruler - 2.5, std::max(0.0, end - x), 2));
            }
            const bool isSeen = x >= m_names && x <= m_room.width() && std::abs(x - last) >= 1;
            if (!isSeen) {
                continue;
            }
            last = x;
            if (health == Health::Error) {
                m_painter.drawRect(QRectF(x - size, y - size, 2 * size, 2 * size));
            } else if (health == Health::Warning) {
                m_painter.drawPolygon(QPolygonF({{x - size, y + size}, {x + size, y + size}, {x, y - size}}));
            } else {
                m_painter.drawEllipse(QPointF(x, y), size * 0.8, size * 0.8);
            }
        }
        m_painter.setRenderHint(QPainter::Antialiasing, false);
    }

    void paintRow(std::size_t row) {
        const TimelineModel::Row& shown = m_model.shown(row);
        const QRect rect = rowRect(row);
        const int margin = CellDelegate::margin(m_metrics);
        if (row % 2 == 1) {
            m_painter.fillRect(rect, withAlpha(theme().raised, 0.5));
        }
        const bool isSelected = m_view.roster().isSelected(shown.character) && !shown.type;
        if (isSelected) {
            m_painter.fillRect(QRect(rect.left(), rect.top(), m_names, rect.height()), theme().selection);
        }
        m_painter.setClipRect(0, m_ruler, m_names, m_room.height());
        QRect name(rect.left() + margin, rect.top(), m_names - 2 * margin, rect.height());
        const int indent = m_metrics.height();
        m_painter.setPen(shown.type ? theme().dim : theme().text);
        if (shown.type) {
            name.setLeft(name.left() + 2 * indent);
        } else {
            m_painter.drawText(name, Qt::AlignLeft | Qt::AlignVCenter,
                               shown.isOpen ? QStringLiteral("▾") : QStringLiteral("▸"));
            name.setLeft(name.left() + indent);
            name.setLeft(name.left() + CellDelegate::paintBefore(m_painter, name, indent / 2, shown.mark));
            m_painter.setPen(theme().text);
        }
        m_painter.drawText(name, Qt::AlignLeft | Qt::AlignVCenter,
                           m_metrics.elidedText(shown.name, Qt::ElideRight, name.width()));
        const QRect strip(m_names + 1, rect.top(), m_timeline.stripWidth() - 1, rect.height());
        m_painter.setClipRect(strip.intersected(QRect(0, m_ruler, m_room.width(), m_room.height())));
        paintStrip(shown, strip);
        m_painter.setClipping(false);
    }

    /// As high as the part with most, with the share that was lost at the bottom; hatched if nothing came for
    /// longer than usual.
    void paintStrip(const TimelineModel::Row& row, const QRect& strip) {
        const model::RangeParts& parts = m_model.parts();
        const std::vector<TimelineModel::Gap> gaps = TimelineModel::gapsIn(row.parts);
        const std::vector<double> heights = heightsOf(row.parts, gaps);
        const double most = heights.empty() ? 1 : std::max(1e-9, std::ranges::max(heights));
        const double room = strip.height() - 5.0;
        const double bottom = strip.bottom() - 1.0;
        const QColor colour = withAlpha(row.mark.colour, row.type ? 0.45 : 0.7);
        m_painter.setPen(Qt::NoPen);
        for (const auto& [from, to] : gaps) {
            const double left = m_timeline.placeOf(parts.beginOf(from));
            m_painter.fillRect(
                QRectF(left, bottom - room, m_timeline.placeOf(parts.beginOf(to)) - left, room),
                QBrush(withAlpha(theme().dim, 0.6), Qt::BDiagPattern));
        }
        for (std::size_t i = 0; i < row.parts.size(); ++i) {
            const model::RangePart& part = row.parts[i];
            const double left = m_timeline.placeOf(parts.beginOf(i));
            const double right = std::max(left + 1, m_timeline.placeOf(parts.beginOf(i + 1)));
            if (heights[i] > 0) {
                const double height = std::max(2.0, room * heights[i] / most);
                m_painter.fillRect(QRectF(left, bottom - height, right - left, height), colour);
            }
            if (part.lost != 0) {
                const double height = std::max(kLeastMark, room * part.lossShare());
                m_painter.fillRect(QRectF(left, bottom - height, std::max(kLeastMark, right - left), height),
                                   theme().warning);
            }
        }
    }

    void paintRange() {
        const auto range = m_view.range();
        if (!range || !m_view.choices().range.fixed) {
            return;
        }
        const QRectF shade(
            QPointF(m_timeline.placeOf(range->from), 0),
            QPointF(std::max(m_timeline.placeOf(range->to), m_timeline.placeOf(range->from) + 1),
                    m_room.height()));
        m_painter.fillRect(shade, withAlpha(theme().accent, 0.16));
        m_painter.setPen(theme().accent);
        m_painter.drawLine(shade.topLeft(), shade.bottomLeft());
        m_painter.drawLine(shade.topRight(), shade.bottomRight());
    }

    void paintCursor() {
        const double x = m_timeline.placeOf(m_view.cursorStamp());
        const double head = m_metrics.height() * 0.35;
        m_painter.setRenderHint(QPainter::Antialiasing);
        m_painter.setPen(QPen(theme().text, 1.5));
        m_painter.drawLine(QPointF(x, head), QPointF(x, m_room.height()));
        m_painter.setPen(Qt::NoPen);
        m_painter.setBrush(theme().text);
        m_painter.drawPolygon(QPolygonF({{x - head, 0}, {x + head, 0}, {x, head * 1.4}}));
        m_painter.setRenderHint(QPainter::Antialiasing, false);
    }

    TimelineView& m_timeline;
    model::SessionView& m_view = m_timeline.m_view;
    TimelineModel& m_model = m_timeline.m_model;
    const model::TimeRange& m_window = m_timeline.m_window;
    const QRect m_room = m_timeline.viewport()->rect();
    const int m_names = m_timeline.namesWidth();
    const int m_ruler = m_timeline.rulerHeight();
    const QRect m_strips{m_names, 0, m_timeline.stripWidth(), m_room.height()};
    const QFontMetrics m_metrics = m_timeline.fontMetrics();
    QPainter m_painter{m_timeline.viewport()};
};

void TimelineView::paintEvent(QPaintEvent* /*event*/) {
    TimelinePainter(*this).paint();
}

} // namespace posewire::gui
