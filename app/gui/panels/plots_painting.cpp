// SPDX-License-Identifier: GPL-3.0-or-later
// How the plots look.
#include "app/gui/models/incident_words.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/plots_view.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/panels/time_ruler.h"
#include "app/gui/theme/theme.h"
#include "core/model/session/verdict.h"

#include <QPainter>

#include <algorithm>
#include <cmath>
#include <set>

namespace posewire::gui {

namespace {

constexpr double kLeastGap = 4;  ///< pixels; shorter ones are marked at the bottom
constexpr double kDotsApart = 9; ///< pixels between values that are drawn one by one
/// A curve that goes up and down further than this, in widths of the chart, is a band of noise: drawing its
/// edges smoothly takes long and shows no more.
constexpr double kRestless = 8;

/// Values at which the axis has lines, the lowest first.
std::vector<double> ticksOf(double least, double most, bool isLog, double room) {
    std::vector<double> ticks;
    if (isLog && most / least > 10) {
        const double decades = std::log10(most / least);
        const int step = std::max(1, static_cast<int>(std::ceil(decades / std::max(1.0, room))));
        for (int i = static_cast<int>(std::ceil(std::log10(least))); std::pow(10.0, i) <= most; i += step) {
            ticks.push_back(std::pow(10.0, i));
        }
        return ticks;
    }
    const double wanted = (most - least) / std::max(1.0, room);
    const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
    const double step = decade * (wanted <= decade       ? 1
                                  : wanted <= 2 * decade ? 2
                                  : wanted <= 5 * decade ? 5
                                                         : 10);
    for (double i = std::ceil(least / step); i * step <= most; ++i) {
        ticks.push_back(i * step);
    }
    return ticks;
}

/// Writes a value with as many decimals as the ticks differ in.
QString tickLabel(double value, double step) {
    constexpr double kLarge = 1e6;
    if (std::abs(value) >= kLarge || (value != 0 && std::abs(step) < 1 / kLarge)) {
        return QString::number(value, 'g', 3).replace(QLatin1Char('-'), QChar(0x2212));
    }
    return fixed(value, std::clamp(-static_cast<int>(std::floor(std::log10(step) + 1e-9)), 0, 6));
}

} // namespace

class PlotsPainter {
public:
    PlotsPainter(PlotsView& plots, QPainter& painter) : m_plots(plots), m_painter(painter) {}

    void paintCharts() {
        m_painter.fillRect(m_plots.rect(), theme().panel);
        m_painter.setFont(tabularFont());
        for (std::size_t i = 0; i < m_shown.size(); ++i) {
            paintAxis(i);
            m_painter.setClipRect(m_shown[i].area);
            paintIncidents(m_shown[i].area);
            paintGaps(m_shown[i]);
            for (std::size_t curve = 0; curve < m_shown[i].points.size(); ++curve) {
                paintCurve(i, curve);
            }
            m_painter.setClipping(false);
        }
        paintRuler();
    }

    void paintOver() {
        const log::Stamp stamp = m_plots.legendStamp();
        for (std::size_t i = 0; i < m_shown.size(); ++i) {
            paintLegend(i, stamp);
            m_painter.setClipRect(m_shown[i].area.adjusted(-4, 0, 4, 0));
            paintRange(m_shown[i].area);
            paintMoment(i, m_plots.m_view.cursorStamp(), QPen(theme().text, 1.5));
            if (stamp != m_plots.m_view.cursorStamp()) {
                paintMoment(i, stamp, QPen(theme().dim, 1, Qt::DashLine));
            }
            m_painter.setClipping(false);
        }
        if (stamp != m_plots.m_view.cursorStamp()) {
            paintTime(stamp);
        }
        m_plots.m_curves.resume();
    }

private:
    void paintAxis(std::size_t chart) {
        const PlotsView::Shown& shown = m_shown[chart];
        const bool isLog = charts()[chart].isLog;
        if (chart != 0) {
            m_painter.fillRect(QRect(0, shown.head.top() - m_line / 4, m_plots.width(), 1), theme().line);
        }
        constexpr double kApart = 2.2; // lines of text
        const auto ticks =
            ticksOf(shown.least, shown.most, isLog, std::max(2.5, shown.area.height() / (kApart * m_line)));
        for (std::size_t i = 0; i < ticks.size(); ++i) {
            const int y = qRound(m_plots.placeOf(chart, ticks[i]));
            const double step = isLog              ? ticks[i]
                                : ticks.size() > 1 ? ticks[1] - ticks[0]
                                                   : shown.most - shown.least;
            m_painter.fillRect(QRect(shown.area.left(), y, shown.area.width(), 1),
                               withAlpha(theme().line, 0.6));
            m_painter.setPen(theme().dim);
            m_painter.drawText(QRect(0, y - m_line / 2, shown.area.left() - m_line / 3, m_line),
                               Qt::AlignRight | Qt::AlignVCenter, tickLabel(ticks[i], step));
        }
        m_painter.fillRect(QRect(shown.area.left() - 1, shown.area.top(), 1, shown.area.height()),
                           theme().line);
        m_painter.fillRect(QRect(shown.area.left() - 1, shown.area.bottom() + 1, shown.area.width() + 1, 1),
                           theme().line);
        m_painter.setPen(theme().dim);
        m_painter.drawText(QRect(0, shown.head.top(), shown.area.left() - m_line / 3, m_plots.lineHeight()),
                           Qt::AlignRight | Qt::AlignVCenter,
                           isLog ? PlotsView::tr("%1 log").arg(charts()[chart].unit()).trimmed()
                                 : charts()[chart].unit());
    }

    void paintIncidents(const QRect& area) {
        for (const model::Incident& incident : m_plots.m_view.verdicts().incidents().all()) {
            const bool isNote = incident.severity() == model::IncidentSeverity::Info;
            const bool goesOn = incident.isCurrent && incident.kind == model::IncidentKind::Outage;
            const double from = m_plots.placeOf(incident.firstStamp);
            const double to = m_plots.placeOf(goesOn ? m_plots.m_view.now() : incident.lastStamp);
            if (isNote || !concerns(incident) || to < area.left() || from > area.right()) {
                continue;
            }
            const QColor colour = healthColour(healthOf(incident.severity()));
            const QRectF band(from, area.top(), std::max(kLeastMark, to - from), area.height());
            if (band.width() < area.width() / 2.0) { // what lasts longer would only tint the chart
                m_painter.fillRect(band, withAlpha(colour, 0.09));
            }
            m_painter.fillRect(QRectF(band.topLeft(), QSizeF(band.width(), 2)), colour);
        }
    }

    [[nodiscard]] bool concerns(const model::Incident& incident) const {
        return std::ranges::any_of(charts(), [&](const PlotChart& chart) {
            return std::ranges::any_of(chart.curves, [&](const PlotCurve& curve) {
                return curve.key && incident.concerns(*curve.key);
            });
        });
    }

    /// Those of all curves: each where it is seen once.
    void paintGaps(const PlotsView::Shown& shown) {
        std::set<std::pair<int, int>> gaps;
        for (const auto& points : shown.points) {
            for (std::size_t i = 1; i < points.size(); ++i) {
                if (points[i].followsGap) {
                    gaps.emplace(qRound(placeOf(points[i - 1])), qRound(placeOf(points[i])));
                }
            }
        }
        int marked = -1;
        m_painter.setPen(Qt::NoPen);
        m_painter.setRenderHint(QPainter::Antialiasing);
        m_painter.setBrush(theme().warning);
        for (const auto& [from, to] : gaps) {
            if (to - from >= kLeastGap) {
                m_painter.fillRect(QRect(from, shown.area.top(), to - from, shown.area.height()),
                                   QBrush(withAlpha(theme().warning, 0.55), Qt::BDiagPattern));
            } else if (to > marked) {
                marked = to + 1;
                const double size = m_line * 0.22;
                const double y = shown.area.bottom();
                m_painter.drawPolygon(
                    QPolygonF({{to - size, y}, {to + size, y}, {to + 0.0, y - 1.8 * size}}));
            }
        }
        m_painter.setRenderHint(QPainter::Antialiasing, false);
    }

    void paintCurve(std::size_t chart, std::size_t curve) {
        const auto& points = m_shown[chart].points[curve];
        const bool isLog = charts()[chart].isLog;
        std::vector<QPolygonF> lines(1);
        std::vector<QPointF> dots;
        double travelled = 0;
        const auto draw = [&](double x, double y) {
            travelled += lines.back().isEmpty() ? 0 : std::abs(y - lines.back().back().y());
            lines.back().append(QPointF(x, y));
        };
        for (std::size_t i = 0; i < points.size(); ++i) {
            const PlotPoint& point = points[i];
            const double x = placeOf(point);
            if (point.followsGap || (isLog && point.most <= 0)) {
                lines.emplace_back();
            }
            if (isLog && point.most <= 0) {
                continue;
            }
            const double high = m_plots.placeOf(chart, point.most);
            const double low = point.least == point.most || (isLog && point.least <= 0)
                                   ? high
                                   : m_plots.placeOf(chart, point.least);
            const bool isAbove = !lines.back().isEmpty() && lines.back().back().y() < (high + low) / 2;
            draw(x, isAbove ? high : low);
            if (high != low) {
                draw(x, isAbove ? low : high);
            }
            const bool isApart = (i == 0 || x - placeOf(points[i - 1]) >= kDotsApart) &&
                                 (i + 1 == points.size() || placeOf(points[i + 1]) - x >= kDotsApart);
            if (isApart) {
                dots.emplace_back(x, high);
            }
        }
        const QColor colour = plotColour(charts()[chart].curves[curve].colour);
        const bool isCalm = travelled < kRestless * m_shown[chart].area.width();
        m_painter.setRenderHint(QPainter::Antialiasing, isCalm);
        m_painter.setPen(QPen(colour, 1)); // wider ones take many times as long
        m_painter.setBrush(Qt::NoBrush);
        for (const QPolygonF& line : lines) {
            line.size() == 1 ? m_painter.drawPoint(line.front()) : m_painter.drawPolyline(line);
        }
        m_painter.setRenderHint(QPainter::Antialiasing);
        m_painter.setPen(Qt::NoPen);
        m_painter.setBrush(colour);
        for (const QPointF& dot : dots) {
            m_painter.drawEllipse(dot, 2, 2);
        }
        m_painter.setRenderHint(QPainter::Antialiasing, false);
    }

    void paintRuler() {
        const QRect ruler(0, m_plots.height() - m_plots.rulerHeight(), m_plots.width(),
                          m_plots.rulerHeight());
        m_painter.fillRect(ruler, theme().header);
        m_painter.fillRect(QRect(ruler.topLeft(), QSize(ruler.width(), 1)), theme().line);
        m_painter.setPen(theme().dim);
        m_painter.drawText(ruler.adjusted(m_line / 2, 0, 0, 0), Qt::AlignLeft | Qt::AlignVCenter,
                           inSight(m_plots.m_window.to - m_plots.m_window.from));
        m_painter.setClipRect(m_plots.gutter(), 0, m_plots.width(), m_plots.height());
        const QFontMetrics metrics = m_painter.fontMetrics();
        for (const TimeTick& tick :
             timeTicks(m_plots.m_view, m_plots.m_window, m_plots.stripWidth(), metrics)) {
            const int x = qRound(m_plots.placeOf(tick.stamp));
            m_painter.fillRect(QRect(x, ruler.top(), 1, ruler.height() / 4), theme().dim);
            if (x < m_plots.gutter()) {
                continue; // half a label says nothing
            }
            m_painter.drawText(QRect(x + 4, ruler.top(), m_plots.width(), ruler.height()),
                               Qt::AlignLeft | Qt::AlignVCenter, tick.text);
            for (const PlotsView::Shown& shown : m_shown) {
                m_painter.fillRect(QRect(x, shown.area.top(), 1, shown.area.height()),
                                   withAlpha(theme().line, 0.3));
            }
        }
        m_painter.setClipping(false);
    }

    void paintLegend(std::size_t chart, log::Stamp stamp) {
        const auto& curves = charts()[chart].curves;
        const QFontMetrics names = m_plots.fontMetrics();
        for (std::size_t i = 0; i < curves.size(); ++i) {
            QRect entry = m_plots.entryOf(chart, i).adjusted(0, 0, -m_line, 0);
            const int swatch = m_line * 2 / 3;
            m_painter.fillRect(QRect(entry.left(), entry.center().y() - 1, swatch, 3),
                               plotColour(curves[i].colour));
            entry.setLeft(entry.left() + swatch + m_line / 3);
            const QString value = curves[i].parts.empty() ? PlotsView::tr("not on the air")
                                                          : m_plots.valueText(chart, curves[i], stamp);
            const bool isNone = value == dash() || curves[i].parts.empty();
            m_painter.setFont(tabularFont());
            const int room = m_painter.fontMetrics().horizontalAdvance(value);
            m_painter.setPen(isNone ? theme().dim : theme().text);
            m_painter.drawText(entry, Qt::AlignRight | Qt::AlignVCenter, value);
            m_painter.setFont(m_plots.font());
            m_painter.setPen(theme().dim);
            m_painter.drawText(entry, Qt::AlignLeft | Qt::AlignVCenter,
                               names.elidedText(m_plots.nameOf(curves[i]), Qt::ElideMiddle,
                                                entry.width() - room - m_line / 2));
        }
    }

    void paintRange(const QRect& area) {
        const auto range = m_plots.m_view.range();
        if (!range || !m_plots.m_view.choices().range.fixed) {
            return;
        }
        const double from = m_plots.placeOf(range->from);
        const double to = std::max(m_plots.placeOf(range->to), from + 1);
        m_painter.fillRect(QRectF(from, area.top(), to - from, area.height()),
                           withAlpha(theme().accent, 0.14));
        m_painter.fillRect(QRectF(from, area.top(), 1, area.height()), theme().accent);
        m_painter.fillRect(QRectF(to, area.top(), 1, area.height()), theme().accent);
    }

    /// A line, and a dot where a curve meets it.
    void paintMoment(std::size_t chart, log::Stamp stamp, const QPen& pen) {
        const QRect& area = m_shown[chart].area;
        const double x = m_plots.placeOf(stamp);
        if (x < area.left() - 1 || x > area.right() + 2) {
            return;
        }
        m_painter.setRenderHint(QPainter::Antialiasing);
        m_painter.setPen(pen);
        m_painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
        m_painter.setPen(QPen(theme().panel, 1.5));
        for (const PlotCurve& curve : charts()[chart].curves) {
            const auto value = m_plots.m_curves.valueAt(curve, stamp);
            if (value && (!charts()[chart].isLog || value->value > 0)) {
                m_painter.setBrush(plotColour(curve.colour));
                m_painter.drawEllipse(QPointF(x, m_plots.placeOf(chart, value->value)), 3.5, 3.5);
            }
        }
        m_painter.setRenderHint(QPainter::Antialiasing, false);
    }

    /// Of the pointer, in the ruler.
    void paintTime(log::Stamp stamp) {
        m_painter.setFont(tabularFont());
        const QString text = timeOfDay(m_plots.m_view.wallOf(stamp));
        const int wide = m_painter.fontMetrics().horizontalAdvance(text) + m_line;
        const int left = std::clamp(qRound(m_plots.placeOf(stamp)) - wide / 2, 0, m_plots.width() - wide);
        const QRect label(left, m_plots.height() - m_plots.rulerHeight() + 1, wide,
                          m_plots.rulerHeight() - 1);
        m_painter.fillRect(label, theme().selection);
        m_painter.setPen(theme().text);
        m_painter.drawText(label, Qt::AlignCenter, text);
    }

    [[nodiscard]] const std::vector<PlotChart>& charts() const { return m_plots.m_curves.charts(); }
    [[nodiscard]] double placeOf(const PlotPoint& point) const {
        return m_plots.gutter() + point.seconds * m_scale;
    }

    PlotsView& m_plots;
    QPainter& m_painter;
    const std::vector<PlotsView::Shown>& m_shown = m_plots.m_shown;
    const int m_line = m_plots.fontMetrics().height();
    /// Pixels a second.
    const double m_scale =
        m_plots.stripWidth() / std::max(1e-9, log::secondsOf(m_plots.m_window.to - m_plots.m_window.from));
};

void PlotsView::paint(QPainter& painter) {
    const auto pointer = std::exchange(m_pointer, std::nullopt);
    PlotsPainter painting(*this, painter);
    painting.paintCharts();
    painting.paintOver();
    m_pointer = pointer;
}

void PlotsView::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    if (m_shown.empty()) {
        painter.fillRect(rect(), theme().panel);
        drawEmptyText(
            *this, tr("No curves yet.\nWrite a field above, such as “position.z of Pelvis”, or drag one here "
                      "from the Inspector or Trackers."));
        return;
    }
    if (m_picture.isNull()) {
        m_picture = QPixmap(size() * devicePixelRatioF());
        m_picture.setDevicePixelRatio(devicePixelRatioF());
        QPainter picture(&m_picture);
        PlotsPainter(*this, picture).paintCharts();
    }
    painter.drawPixmap(0, 0, m_picture);
    PlotsPainter(*this, painter).paintOver();
    if (hasFocus()) {
        painter.setPen(theme().accent);
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
    }
}

} // namespace posewire::gui
