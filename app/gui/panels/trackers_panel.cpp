// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/trackers_panel.h"

#include "app/gui/models/curve_text.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/widgets.h"

#include <QItemSelectionModel>
#include <QMenu>

#include <array>
#include <limits>

namespace posewire::gui {

namespace {

constexpr int kTableCharacters = 36; ///< names and flags

/// The vector whose norm a column shows, by its field.
const char* fieldOf(int column) {
    return column == TrackerModel::kAcceleration ? "acceleration"
           : column == TrackerModel::kGyro       ? "angularVelocity"
           : column == TrackerModel::kMagnetic   ? "magneticField"
                                                 : "freeAcceleration";
}

/// Free acceleration x y z above, norm of the magnetic field below.
TimePlot* makeTrackerPlot(QWidget* parent) {
    constexpr double kSecondsShown = log::secondsOf(TrackerHistory::kPlot);
    constexpr double kLeastAcceleration = 2.0; // m/s²
    constexpr double kLeastNorm = 0.1;
    auto* plot = new TimePlot(TrackersPanel::tr("Plots of the tracker"), kSecondsShown, parent);
    const int accelerations =
        plot->addChart(TrackersPanel::tr("Free acceleration m/s²"), 3, kLeastAcceleration);
    const int norms = plot->addChart(TrackersPanel::tr("Magnetic field, norm"), 2, kLeastNorm);
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

} // namespace

TrackersPanel::TrackersPanel(model::SessionView& view, Commands& commands, QWidget* parent)
    : Panel(view, commands, parent), m_facts(trackerFacts(m_trackers)), m_plots(makeTrackerPlot(this)) {
    tightColumn(this)->addWidget(m_splitter);
    auto* detail = tightColumn(m_detail);
    detail->addWidget(m_plots, 1);
    detail->addWidget(new Line(m_detail));
    detail->addWidget(m_factTable);
    m_splitter->addWidget(m_table);
    m_splitter->addWidget(m_detail);
    m_splitter->setStretchFactor(0, 1);
    m_splitter->setStretchFactor(1, 1);
    m_splitter->setHandleWidth(1);
    m_splitter->setChildrenCollapsible(true);
    m_detail->hide();
    m_table->setModel(&m_trackers);
    m_table->setMinimumWidth(fontMetrics().averageCharWidth() * kTableCharacters);
    m_table->setEmptyText(tr("No tracker data on the air.\nIn MVN: Network Streamer > enable Motion Tracker "
                             "Kinematics (type 23)."));
    m_table->setDragged([this](const QModelIndex& cell) { return asDragged(curvesOf(cell)); });
    connect(m_table, &TableView::menuRequested, this, &TrackersPanel::addPlots);
    m_facts.dimWhile([this] { return m_trackers.isStale(); });
    m_factTable->showFacts(m_facts);
    m_factTable->fixHeight();
    connect(m_table->selectionModel(), &QItemSelectionModel::currentRowChanged, this, &TrackersPanel::select);
    new EventWatch(this, QEvent::Resize, [this] {
        constexpr int kBothCharacters = 75; // as wide as the table and the facts are
        const bool isBeside =
            width() > height() * 3 / 2 && width() >= kBothCharacters * fontMetrics().averageCharWidth();
        const Qt::Orientation orientation = isBeside ? Qt::Horizontal : Qt::Vertical;
        m_isDivided = m_isDivided && orientation == m_splitter->orientation();
        m_splitter->setOrientation(orientation);
    });
}

void TrackersPanel::refresh() {
    m_isFollowing = true;
    m_trackers.refresh();
    m_facts.refresh();
    const bool hasTracker = m_trackers.shown() != nullptr;
    if (hasTracker && !m_isDivided) {
        m_isDivided = true;
        m_detail->show();
        // Below the table plots need the room; beside it facts do, which have many digits.
        const bool isBeside = m_splitter->orientation() == Qt::Horizontal;
        const int least = m_table->minimumWidth();
        m_splitter->setSizes(isBeside ? QList<int>{least, width() - least} : QList<int>{1, 3});
    }
    m_detail->setVisible(hasTracker);
    if (m_detail->isVisible()) {
        m_plots->setPast(m_trackers.staleText());
        plotHistory(*m_plots, m_trackers.history());
    }
    const int row = m_trackers.shownRow();
    if (row != m_table->currentIndex().row()) {
        m_table->setCurrentIndex(m_trackers.index(row, 0));
    }
    m_isFollowing = false;
}

void TrackersPanel::select(const QModelIndex& index) {
    const auto key = m_trackers.character();
    if (m_isFollowing || !index.isValid() || !key) {
        return;
    }
    const int segment = static_cast<int>(m_trackers.tracker(index.row()).id) - 1;
    m_commands.select(selectionOf(m_view, *key, segment));
}

QStringList TrackersPanel::curvesOf(const QModelIndex& cell) const {
    return curvesOfTracker(fieldOf(cell.column()), m_trackers.tracker(cell.row()).id);
}

void TrackersPanel::addPlots(QMenu& menu, const QModelIndex& index) {
    if (!index.isValid()) {
        return;
    }
    QMenu* plots = menu.addMenu(tr("Plot"));
    for (const auto& [column, title] : {std::pair{TrackerModel::kFree, tr("Free acceleration")},
                                        {TrackerModel::kAcceleration, tr("Acceleration")},
                                        {TrackerModel::kGyro, tr("Angular velocity")},
                                        {TrackerModel::kMagnetic, tr("Magnetic field")}}) {
        const QStringList curves = curvesOf(index.siblingAtColumn(column));
        plots->addAction(title, this, [this, curves] { m_commands.plot(curves); });
    }
    menu.addSeparator();
}

QString TrackersPanel::summary() const {
    const wire::Tracker* tracker = m_trackers.shown();
    if (tracker == nullptr) {
        return {};
    }
    const QString stale = m_trackers.isStale() ? QStringLiteral(" · ") + m_trackers.staleText() : QString();
    return QStringLiteral("%1 · %2").arg(trackerName(tracker->id)).arg(tracker->id) + stale;
}

} // namespace posewire::gui
