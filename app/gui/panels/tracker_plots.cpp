// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/tracker_plots.h"

#include <QCoreApplication>

#include <array>
#include <limits>

namespace posewire::gui {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("TrackerPlots", text);
}

} // namespace

TimePlot* makeTrackerPlot(QWidget* parent) {
    constexpr double kSecondsShown = log::secondsOf(TrackerHistory::kPlot);
    constexpr double kLeastAcceleration = 2.0; // m/s²
    constexpr double kLeastNorm = 0.1;
    auto* plot = new TimePlot(tr("Plots of the tracker"), kSecondsShown, parent);
    const int accelerations = plot->addChart(tr("Free acceleration m/s²"), 3, kLeastAcceleration);
    const int norms = plot->addChart(tr("Magnetic field, norm"), 2, kLeastNorm);
    for (QColor Theme::*colour : {&Theme::axisX, &Theme::axisY, &Theme::axisZ}) {
        plot->addCurve(accelerations, colour);
    }
    plot->addCurve(norms, &Theme::plotFourth);
    return plot;
}

void plotHistory(TimePlot& plot, const TrackerHistory& history) {
    std::array<std::vector<TimePlot::Point>, 4> curves;
    std::vector<TimePlot::Gap> gaps;
    double before = 0;
    for (const TrackerHistory::Point& point : history.points()) {
        const double time = log::secondsOf(point.stamp - history.lastStamp());
        if (point.followsGap) {
            gaps.emplace_back(before, time);
            for (auto& curve : curves) {
                curve.push_back({(before + time) / 2, std::numeric_limits<double>::quiet_NaN()});
            }
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            curves[axis].push_back({time, static_cast<double>(point.freeAcceleration[axis])});
        }
        curves[3].push_back({time, static_cast<double>(point.magneticNorm)});
        before = time;
    }
    for (std::size_t i = 0; i < curves.size(); ++i) {
        plot.setCurve(static_cast<int>(i), curves[i]);
    }
    plot.setGaps(gaps);
    plot.replot();
}

} // namespace posewire::gui
