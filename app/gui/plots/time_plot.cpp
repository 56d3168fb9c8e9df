// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/plots/time_plot.h"

#include "app/gui/theme/widgets.h"

#include <qcustomplot.h>

#include <algorithm>

namespace posewire::gui {

namespace {

/// Hatches in each chart. Further gaps still break the curves.
constexpr std::size_t kMostHatches = 32;
/// Shorter gaps (s) are hardly a pixel wide: they are marked at the bottom instead, where dense loss shows as
/// a line and does not hide the curves.
constexpr double kLeastHatch = 0.06;

/// Writes the minus sign and the decimal point as tables do.
class Ticker : public QCPAxisTicker {
protected:
    QString getTickLabel(double tick, const QLocale& /*of the country*/, QChar format,
                         int precision) override {
        return QCPAxisTicker::getTickLabel(tick, QLocale::c(), format, precision)
            .replace(QLatin1Char('-'), QChar(0x2212));
    }
};

} // namespace

struct TimePlot::Parts {
    struct Chart {
        QCPAxisRect* axes;
        QCPTextElement* title;
        QString words;
        double leastRange;
    };
    struct Curve {
        QCPGraph* graph;
        QColor Theme::*colour;
        std::size_t chart;
    };

    [[nodiscard]] static QCPAxis* time(const Chart& chart) { return chart.axes->axis(QCPAxis::atBottom); }
    [[nodiscard]] static QCPAxis* values(const Chart& chart) { return chart.axes->axis(QCPAxis::atLeft); }

    void fitValues(std::size_t number);
    /// As many labels of values as stand above each other; none where there is no room for two.
    void fitLabels(const Chart& chart);
    void showTitles();
    /// One rectangle in each chart.
    void addHatch();

    double secondsShown;
    QCustomPlot* plot;
    QCPMarginGroup* margins;
    std::vector<Chart> charts;
    std::vector<Curve> curves;
    QCPGraph* marks = nullptr; ///< gaps too short to be hatched
    std::vector<QCPItemRect*> hatches;
    std::vector<double> shortGaps;             ///< their middles
    std::vector<QCPItemStraightLine*> cursors; ///< one in each chart; none before a cursor was set
    QString past;                              ///< why it is not how it is now
};

TimePlot::TimePlot(const QString& name, double secondsShown, QWidget* parent)
    : QWidget(parent),
      m_parts(new Parts{secondsShown, new QCustomPlot(this), nullptr, {}, {}, nullptr, {}, {}, {}, {}}) {
    setAccessibleName(name);
    QCustomPlot* plot = m_parts->plot;
    tightColumn(this)->addWidget(plot);
    plot->setMinimumSize(fontMetrics().height() * 4, fontMetrics().height() * 4);
    plot->plotLayout()->clear();
    plot->plotLayout()->setRowSpacing(0);
    // Fast for thin lines; and a plot must not make the whole window paint at once, out of turn.
    plot->setPlottingHint(QCP::phFastPolylines);
    plot->setPlottingHint(QCP::phImmediateRefresh, false);
    m_parts->margins = new QCPMarginGroup(plot);
}

TimePlot::~TimePlot() = default;

int TimePlot::addChart(const QString& title, int share, double leastRange) {
    QCustomPlot* plot = m_parts->plot;
    const int row = plot->plotLayout()->rowCount();
    const int space = fontMetrics().height() / 2;
    auto* words = new QCPTextElement(plot, title);
    words->setTextFlags(Qt::AlignLeft | Qt::AlignVCenter);
    words->setMargins({space, fontMetrics().height() / 3, 0, 0});
    plot->plotLayout()->addElement(row, 0, words);
    auto* axes = new QCPAxisRect(plot);
    axes->setMinimumSize(0, fontMetrics().height() * 2);
    axes->setMinimumMargins({space, space / 3, space, space / 3});
    axes->setMarginGroup(QCP::msLeft | QCP::msRight, m_parts->margins);
    plot->plotLayout()->addElement(row + 1, 0, axes);
    plot->plotLayout()->setRowStretchFactor(row + 1, share);
    if (!m_parts->charts.empty()) {
        Parts::time(m_parts->charts.back())->setTickLabels(false); // the lowest one's are for all
    }
    const Parts::Chart& chart = m_parts->charts.emplace_back(Parts::Chart{axes, words, title, leastRange});
    Parts::time(chart)->setRange(-m_parts->secondsShown, 0);
    for (QCPAxis* axis : {Parts::time(chart), Parts::values(chart)}) {
        axis->setTicker(QSharedPointer<Ticker>::create());
    }
    Parts::time(chart)->ticker()->setTickCount(5);
    Parts::values(chart)->ticker()->setTickCount(3);
    if (m_parts->marks == nullptr) {
        m_parts->marks = plot->addGraph(Parts::time(chart), Parts::values(chart));
        m_parts->marks->setLineStyle(QCPGraph::lsNone);
        m_parts->marks->setLayer(QStringLiteral("axes")); // over the curves
    }
    applyColours();
    return static_cast<int>(m_parts->charts.size()) - 1;
}

int TimePlot::addCurve(int chart, QColor Theme::*colour) {
    const auto number = static_cast<std::size_t>(chart);
    const Parts::Chart& at = m_parts->charts[number];
    m_parts->curves.push_back({m_parts->plot->addGraph(Parts::time(at), Parts::values(at)), colour, number});
    applyColours();
    return static_cast<int>(m_parts->curves.size()) - 1;
}

void TimePlot::setTitle(int chart, const QString& title) {
    m_parts->charts[static_cast<std::size_t>(chart)].words = title;
    m_parts->showTitles();
}

void TimePlot::setPast(const QString& why) {
    const bool isOther = why.isEmpty() != m_parts->past.isEmpty();
    m_parts->past = why;
    m_parts->showTitles();
    if (isOther) {
        applyColours();
    }
}

void TimePlot::Parts::showTitles() {
    for (const Chart& chart : charts) {
        const bool isFirst = &chart == &charts.front();
        chart.title->setText(isFirst && !past.isEmpty() ? chart.words + QStringLiteral(" · ") + past
                                                        : chart.words);
    }
}

void TimePlot::setSpan(double from, double to) {
    for (const Parts::Chart& chart : m_parts->charts) {
        Parts::time(chart)->setRange(from, to);
    }
}

void TimePlot::setCursor(std::optional<double> time) {
    while (m_parts->cursors.size() < m_parts->charts.size()) {
        const Parts::Chart& chart = m_parts->charts[m_parts->cursors.size()];
        auto* line = new QCPItemStraightLine(m_parts->plot);
        line->setClipAxisRect(chart.axes);
        line->setAntialiased(false); // one pixel, sharp
        for (QCPItemPosition* point : {line->point1, line->point2}) {
            point->setAxisRect(chart.axes);
            point->setAxes(Parts::time(chart), Parts::values(chart));
        }
        m_parts->cursors.push_back(line);
        m_parts->plot->installEventFilter(this);
        applyColours();
    }
    for (QCPItemStraightLine* line : m_parts->cursors) {
        line->setVisible(time.has_value());
        line->point1->setCoords(time.value_or(0), 0);
        line->point2->setCoords(time.value_or(0), 1);
    }
}

bool TimePlot::eventFilter(QObject* watched, QEvent* event) {
    if (watched == m_parts->plot && event->type() == QEvent::MouseButtonPress) {
        const QPointF at = static_cast<QMouseEvent*>(event)->position();
        const auto* axes = m_parts->charts.front().axes;
        if (at.x() >= axes->left() && at.x() <= axes->right()) {
            emit momentPicked(Parts::time(m_parts->charts.front())->pixelToCoord(at.x()));
        }
    }
    return QWidget::eventFilter(watched, event);
}

void TimePlot::setCurve(int curve, std::span<const Point> points) {
    QVector<QCPGraphData> values;
    values.reserve(static_cast<qsizetype>(points.size()));
    for (const Point& point : points) {
        values.append({point.time, point.value});
    }
    m_parts->curves[static_cast<std::size_t>(curve)].graph->data()->set(values, true);
}

void TimePlot::setGaps(std::span<const Gap> gaps) {
    std::vector<Gap> wide;
    m_parts->shortGaps.clear();
    for (const Gap& gap : gaps) {
        if (gap.second - gap.first >= kLeastHatch) {
            wide.push_back(gap);
        } else {
            m_parts->shortGaps.push_back((gap.first + gap.second) / 2);
        }
    }
    const std::size_t charts = m_parts->charts.size();
    const std::size_t count = std::min(wide.size(), kMostHatches);
    while (m_parts->hatches.size() < charts * count) {
        m_parts->addHatch();
    }
    for (std::size_t i = 0; i < m_parts->hatches.size(); ++i) {
        const std::size_t gap = i / charts;
        m_parts->hatches[i]->setVisible(gap < count);
        if (gap < count) {
            const auto [begin, end] = wide[wide.size() - count + gap];
            m_parts->hatches[i]->topLeft->setCoords(begin, 0);
            m_parts->hatches[i]->bottomRight->setCoords(end, 1);
        }
    }
}

void TimePlot::Parts::addHatch() {
    for (const Chart& chart : charts) {
        auto* item = new QCPItemRect(plot);
        item->setPen(Qt::NoPen);
        item->setBrush(QBrush(theme().warning, Qt::BDiagPattern));
        item->setClipAxisRect(chart.axes);
        for (QCPItemPosition* corner : {item->topLeft, item->bottomRight}) {
            corner->setAxisRect(chart.axes);
            corner->setAxes(time(chart), values(chart));
            corner->setTypeX(QCPItemPosition::ptPlotCoords);
            corner->setTypeY(QCPItemPosition::ptAxisRectRatio);
        }
        hatches.push_back(item);
    }
}

/// The values of all curves of a chart with room above and below.
void TimePlot::Parts::fitValues(std::size_t number) {
    QCPRange all;
    bool hasAny = false;
    for (const Curve& curve : curves) {
        bool isFound = false;
        const QCPRange range = curve.graph->getValueRange(isFound);
        if (isFound && curve.chart == number) {
            all =
                hasAny ? QCPRange(std::min(all.lower, range.lower), std::max(all.upper, range.upper)) : range;
            hasAny = true;
        }
    }
    const double spread = std::max(all.size(), charts[number].leastRange) * 1.15;
    values(charts[number])->setRange(all.center() - spread / 2, all.center() + spread / 2);
}

void TimePlot::Parts::fitLabels(const Chart& chart) {
    constexpr int kMost = 3;
    QCPAxis* axis = values(chart);
    const int line = QFontMetrics(axis->tickLabelFont()).height();
    axis->ticker()->setTickStepStrategy(QCPAxisTicker::tssMeetTickCount);
    axis->ticker()->setTickCount(std::clamp(chart.axes->height() / (2 * line), 1, kMost));
    axis->setTickLabels(chart.axes->height() >= 2 * line);
    // As many moments as stand beside each other.
    constexpr int kMostMoments = 5;
    const int wide = QFontMetrics(axis->tickLabelFont()).horizontalAdvance(QStringLiteral("-10.0"));
    time(chart)->ticker()->setTickCount(std::clamp(chart.axes->width() / (3 * wide), 1, kMostMoments));
}

void TimePlot::replot() {
    for (std::size_t i = 0; i < m_parts->charts.size(); ++i) {
        m_parts->fitValues(i);
        m_parts->fitLabels(m_parts->charts[i]);
    }
    const auto [lower, upper] = valueRange(0);
    QVector<QCPGraphData> marks;
    for (const double time : m_parts->shortGaps) {
        marks.append({time, lower + 0.04 * (upper - lower)});
    }
    m_parts->marks->data()->set(marks, true);
    paintSoon();
}

void TimePlot::paintSoon() {
    // Without a place on the screen there is nothing to paint on; being shown paints by itself.
    if (m_parts->plot->isVisible() && !m_parts->plot->size().isEmpty()) {
        m_parts->plot->setBufferDevicePixelRatio(devicePixelRatioF());
        m_parts->plot->replot(QCustomPlot::rpQueuedReplot);
    }
}

std::pair<double, double> TimePlot::valueRange(int chart) const {
    const QCPRange range = Parts::values(m_parts->charts[static_cast<std::size_t>(chart)])->range();
    return {range.lower, range.upper};
}

void TimePlot::applyColours() {
    const Theme& colours = theme();
    m_parts->plot->setBackground(colours.panel);
    constexpr double kPastAlpha = 0.4;
    for (const Parts::Curve& curve : m_parts->curves) {
        const QColor colour = colours.*curve.colour;
        curve.graph->setPen(QPen(m_parts->past.isEmpty() ? colour : withAlpha(colour, kPastAlpha), 1));
    }
    for (QCPItemStraightLine* line : m_parts->cursors) {
        line->setPen(QPen(colours.text, 1));
    }
    m_parts->marks->setScatterStyle(
        QCPScatterStyle(QCPScatterStyle::ssTriangle, colours.warning, colours.warning, 5));
    QFont small = font();
    small.setPointSizeF(small.pointSizeF() * 0.88);
    for (const Parts::Chart& chart : m_parts->charts) {
        const bool saysPast = !m_parts->past.isEmpty() && &chart == &m_parts->charts.front();
        chart.title->setTextColor(saysPast ? colours.error : colours.dim);
        chart.title->setFont(small);
        for (QCPAxis* axis : chart.axes->axes()) {
            axis->setBasePen(QPen(colours.line));
            axis->setTickPen(Qt::NoPen);
            axis->setSubTickPen(Qt::NoPen);
            axis->setTickLabelColor(colours.dim);
            axis->setTickLabelFont(small);
            axis->grid()->setPen(QPen(colours.line, 0));
            axis->grid()->setZeroLinePen(QPen(colours.line, 0));
        }
        Parts::time(chart)->grid()->setVisible(false);
    }
    for (QCPItemRect* item : m_parts->hatches) {
        item->setBrush(QBrush(colours.warning, Qt::BDiagPattern));
    }
    paintSoon();
}

void TimePlot::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    const bool isLook = event->type() == QEvent::StyleChange || event->type() == QEvent::PaletteChange ||
                        event->type() == QEvent::FontChange;
    if (isLook && !m_parts->charts.empty()) {
        applyColours();
    }
}

QString plottingName() {
    return QStringLiteral("QCustomPlot " QCUSTOMPLOT_VERSION_STR);
}

} // namespace posewire::gui
