// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/tracker_plots.h"

#include "app/gui/theme/theme.h"

#include <QVBoxLayout>
#include <qcustomplot.h>

#include <algorithm>
#include <array>
#include <limits>

namespace posewire::gui {

namespace {

constexpr double kSecondsShown = static_cast<double>(TrackerHistory::kPlotNs) * 1e-9;
/// Hatches in the accelerations; as many again in the norms. Further gaps still break the curves.
constexpr std::size_t kMostHatches = 32;
/// Shorter gaps (s) are hardly a pixel wide: they are marked at the bottom instead, where dense loss shows as
/// a line and does not hide the curves.
constexpr double kLeastHatch = 0.06;
constexpr double kLeastAcceleration = 1.0; ///< m/s², half the least range shown
constexpr double kLeastNormRange = 0.1;

/// The range of a graph with room above and below, at least `least` wide.
void fitRange(QCPAxis* axis, QCPRange range, double least) {
    const double spread = std::max(range.size(), least) * 1.15;
    axis->setRange(range.center() - spread / 2, range.center() + spread / 2);
}

QCPRange valuesOf(std::span<QCPGraph* const> graphs) {
    QCPRange all;
    bool hasAny = false;
    for (const QCPGraph* graph : graphs) {
        bool isFound = false;
        const QCPRange range = graph->getValueRange(isFound);
        if (isFound) {
            all =
                hasAny ? QCPRange(std::min(all.lower, range.lower), std::max(all.upper, range.upper)) : range;
            hasAny = true;
        }
    }
    return all;
}

} // namespace

TrackerPlots::TrackerPlots(QWidget* parent) : QWidget(parent), m_plot(new QCustomPlot(this)) {
    setAccessibleName(tr("Plots of the tracker"));
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins({});
    layout->addWidget(m_plot);
    m_plot->setMinimumSize(fontMetrics().height() * 4, fontMetrics().height() * 4);
    m_plot->plotLayout()->clear();
    m_plot->plotLayout()->setRowSpacing(0);
    addTitle(0, tr("Free acceleration m/s²"));
    QCPAxisRect* accelerations = addAxes(1);
    addTitle(2, tr("Magnetic field, norm"));
    QCPAxisRect* norms = addAxes(3);
    // Fast for thin lines; and a plot must not make the whole window paint at once, out of turn.
    m_plot->setPlottingHint(QCP::phFastPolylines);
    m_plot->setPlottingHint(QCP::phImmediateRefresh, false);
    m_plot->plotLayout()->setRowStretchFactor(1, 3);
    m_plot->plotLayout()->setRowStretchFactor(3, 2);
    accelerations->axis(QCPAxis::atBottom)->setTickLabels(false);
    for (int i = 0; i < 4; ++i) {
        QCPAxisRect* axes = i < 3 ? accelerations : norms;
        m_graphs.push_back(m_plot->addGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft)));
    }
    m_marks = m_plot->addGraph(accelerations->axis(QCPAxis::atBottom), accelerations->axis(QCPAxis::atLeft));
    m_marks->setLineStyle(QCPGraph::lsNone);
    auto* margins = new QCPMarginGroup(m_plot);
    accelerations->setMarginGroup(QCP::msLeft | QCP::msRight, margins);
    norms->setMarginGroup(QCP::msLeft | QCP::msRight, margins);
    applyColours();
}

void TrackerPlots::addTitle(int row, const QString& text) {
    auto* title = new QCPTextElement(m_plot, text);
    title->setTextFlags(Qt::AlignLeft | Qt::AlignVCenter);
    title->setMargins({fontMetrics().height() / 2, fontMetrics().height() / 3, 0, 0});
    m_plot->plotLayout()->addElement(row, 0, title);
    m_titles.push_back(title);
}

QCPAxisRect* TrackerPlots::addAxes(int row) {
    auto* axes = new QCPAxisRect(m_plot);
    axes->setMinimumSize(0, fontMetrics().height() * 2);
    const int space = fontMetrics().height() / 2;
    axes->setMinimumMargins({space, space / 3, space, space / 3});
    axes->axis(QCPAxis::atBottom)->setRange(-kSecondsShown, 0);
    axes->axis(QCPAxis::atLeft)->ticker()->setTickCount(3);
    axes->axis(QCPAxis::atBottom)->ticker()->setTickCount(5);
    m_plot->plotLayout()->addElement(row, 0, axes);
    m_axes.push_back(axes);
    return axes;
}

void TrackerPlots::applyColours() {
    const Theme& colours = theme();
    m_plot->setBackground(colours.panel);
    const std::array<QColor, 4> curves{colours.axisX, colours.axisY, colours.axisZ, colours.plotFourth};
    for (std::size_t i = 0; i < m_graphs.size(); ++i) {
        m_graphs[i]->setPen(QPen(curves[i], 1));
    }
    m_marks->setScatterStyle(
        QCPScatterStyle(QCPScatterStyle::ssTriangle, colours.warning, colours.warning, 5));
    QFont small = font();
    small.setPointSizeF(small.pointSizeF() * 0.88);
    for (QCPTextElement* title : m_titles) {
        title->setTextColor(colours.dim);
        title->setFont(small);
    }
    for (QCPAxisRect* axes : m_axes) {
        for (QCPAxis* axis : axes->axes()) {
            axis->setBasePen(QPen(colours.line));
            axis->setTickPen(Qt::NoPen);
            axis->setSubTickPen(Qt::NoPen);
            axis->setTickLabelColor(colours.dim);
            axis->setTickLabelFont(small);
            axis->grid()->setPen(QPen(colours.line, 0));
            axis->grid()->setZeroLinePen(QPen(colours.line, 0));
        }
        axes->axis(QCPAxis::atBottom)->grid()->setVisible(false);
    }
    for (QCPItemRect* item : m_hatches) {
        item->setBrush(QBrush(colours.warning, Qt::BDiagPattern));
    }
    replot();
}

void TrackerPlots::replot() {
    // Without a place on the screen there is nothing to paint on; being shown paints by itself.
    if (m_plot->isVisible() && !m_plot->size().isEmpty()) {
        m_plot->setBufferDevicePixelRatio(devicePixelRatioF());
        m_plot->replot(QCustomPlot::rpQueuedReplot);
    }
}

void TrackerPlots::show(const TrackerHistory& history) {
    std::array<QVector<QCPGraphData>, 4> curves;
    std::vector<Gap> gaps;
    double before = 0;
    for (const TrackerHistory::Point& point : history.points()) {
        const double time = static_cast<double>(point.stampNs - history.lastStampNs()) * 1e-9;
        if (point.followsGap) {
            gaps.emplace_back(before, time);
            for (auto& curve : curves) {
                curve.append({(before + time) / 2, std::numeric_limits<double>::quiet_NaN()});
            }
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            curves[axis].append({time, static_cast<double>(point.freeAcceleration[axis])});
        }
        curves[3].append({time, static_cast<double>(point.magneticNorm)});
        before = time;
    }
    for (std::size_t i = 0; i < curves.size(); ++i) {
        m_graphs[i]->data()->set(curves[i], true);
    }
    const std::span graphs(m_graphs);
    fitRange(m_axes[0]->axis(QCPAxis::atLeft), valuesOf(graphs.first(3)), 2 * kLeastAcceleration);
    fitRange(m_axes[1]->axis(QCPAxis::atLeft), valuesOf(graphs.last(1)), kLeastNormRange);
    mark(gaps);
    replot();
}

void TrackerPlots::mark(const std::vector<Gap>& gaps) {
    std::vector<Gap> wide;
    QVector<QCPGraphData> marks;
    const QCPRange range = m_axes[0]->axis(QCPAxis::atLeft)->range();
    for (const Gap& gap : gaps) {
        if (gap.second - gap.first >= kLeastHatch) {
            wide.push_back(gap);
        } else {
            marks.append({(gap.first + gap.second) / 2, range.lower + 0.04 * range.size()});
        }
    }
    m_marks->data()->set(marks, true);
    hatch(wide);
}

void TrackerPlots::hatch(const std::vector<Gap>& gaps) {
    const std::size_t count = std::min(gaps.size(), kMostHatches);
    while (m_hatches.size() < 2 * count) {
        QCPAxisRect* axes = m_axes[m_hatches.size() % 2];
        auto* item = new QCPItemRect(m_plot);
        item->setPen(Qt::NoPen);
        item->setBrush(QBrush(theme().warning, Qt::BDiagPattern));
        item->setClipAxisRect(axes);
        for (QCPItemPosition* corner : {item->topLeft, item->bottomRight}) {
            corner->setAxisRect(axes);
            corner->setAxes(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
            corner->setTypeX(QCPItemPosition::ptPlotCoords);
            corner->setTypeY(QCPItemPosition::ptAxisRectRatio);
        }
        m_hatches.push_back(item);
    }
    for (std::size_t i = 0; i < m_hatches.size(); ++i) {
        const std::size_t gap = i / 2;
        m_hatches[i]->setVisible(gap < count);
        if (gap < count) {
            const auto [begin, end] = gaps[gaps.size() - count + gap];
            m_hatches[i]->topLeft->setCoords(begin, 0);
            m_hatches[i]->bottomRight->setCoords(end, 1);
        }
    }
}

QSize TrackerPlots::minimumSizeHint() const {
    const int unit = fontMetrics().height();
    return {unit * 8, unit * 9};
}

QSize TrackerPlots::sizeHint() const {
    const int unit = fontMetrics().height();
    return {unit * 20, unit * 12};
}

void TrackerPlots::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    const bool isLook = event->type() == QEvent::StyleChange || event->type() == QEvent::PaletteChange ||
                        event->type() == QEvent::FontChange;
    if (isLook && !m_graphs.empty()) {
        applyColours();
    }
}

} // namespace posewire::gui
