// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/trackers_panel.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/panels/line.h"

#include <QItemSelectionModel>
#include <QVBoxLayout>

namespace posewire::gui {

TrackersPanel::TrackersPanel(model::SessionView& view, Commands& commands, QWidget* parent)
    : Panel(parent),
      m_view(view),
      m_commands(commands),
      m_trackers(view),
      m_facts(trackerFacts(m_trackers)),
      m_splitter(new QSplitter(Qt::Vertical, this)),
      m_table(new TableView(tr("Trackers"), this)),
      m_detail(new QWidget(this)),
      m_factTable(new TableView(tr("Selected tracker"), this)),
      m_plots(makeTrackerPlot(this)) {
    layOut();
    m_table->setModel(&m_trackers);
    const QString number = QStringLiteral("99.99");
    m_table->setColumnSamples({QStringLiteral("Right Upper Arm"), number, number, number, number, QString()},
                              QStringLiteral("▲ magnetic"));
    m_table->setOptionalColumns(TrackerModel::kFree);
    m_table->setEmptyText(tr("No tracker data on the air.\nIn MVN: Network Streamer > enable Motion Tracker "
                             "Kinematics (type 23)."));
    m_factTable->setModel(&m_facts);
    m_factTable->setHeaderHidden(true);
    m_factTable->setColumnSamples({QStringLiteral("Free acceleration m/s²"), QString()});
    m_factTable->setFixedHeight(m_factTable->heightForRows(m_facts.rowCount()));
    m_factTable->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    connect(m_table->selectionModel(), &QItemSelectionModel::currentRowChanged, this, &TrackersPanel::select);
    for (TableView* table : {m_table, m_factTable}) {
        connect(table, &TableView::copyRequested, this,
                [this](const QString& text) { m_commands.copyText(text); });
    }
}

void TrackersPanel::layOut() {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins({});
    layout->addWidget(m_splitter);
    auto* detail = new QVBoxLayout(m_detail);
    detail->setContentsMargins({});
    detail->setSpacing(0);
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
}

void TrackersPanel::refresh() {
    m_isFollowing = true;
    m_trackers.refresh();
    m_facts.refresh();
    const bool hasTracker = m_trackers.shown() != nullptr;
    if (hasTracker && !m_isDivided) {
        m_isDivided = true;
        m_detail->show();
        // Shares: below the table plots need the room; beside them the table shows its columns.
        const bool isBeside = m_splitter->orientation() == Qt::Horizontal;
        m_splitter->setSizes(isBeside ? QList<int>{1, 1} : QList<int>{1, 3});
    }
    m_detail->setVisible(hasTracker);
    if (m_detail->isVisible()) {
        plotHistory(*m_plots, m_trackers.history());
    }
    followSelection();
    m_isFollowing = false;
}

void TrackersPanel::followSelection() {
    const int row = m_trackers.shownRow();
    if (row != m_table->currentIndex().row()) {
        m_table->setCurrentIndex(m_trackers.index(row, 0));
    }
}

void TrackersPanel::select(const QModelIndex& index) {
    const auto key = m_trackers.character();
    if (m_isFollowing || !index.isValid() || !key) {
        return;
    }
    model::Selection selection = selectionOf(m_view, *key);
    selection.segment = static_cast<int>(m_trackers.tracker(index.row()).id) - 1;
    m_commands.select(selection);
}

QString TrackersPanel::summary() const {
    const wire::Tracker* tracker = m_trackers.shown();
    return tracker == nullptr ? QString()
                              : QStringLiteral("%1 · %2").arg(trackerName(tracker->id)).arg(tracker->id);
}

QJsonObject TrackersPanel::state() const {
    const QJsonArray columns = m_table->chosenColumns();
    return columns.isEmpty() ? QJsonObject() : QJsonObject{{"columns", columns}};
}

void TrackersPanel::restoreState(const QJsonObject& state) {
    m_table->setChosenColumns(state["columns"].toArray());
}

void TrackersPanel::resizeEvent(QResizeEvent* event) {
    Panel::resizeEvent(event);
    const Qt::Orientation orientation = width() > height() * 3 / 2 ? Qt::Horizontal : Qt::Vertical;
    if (orientation != m_splitter->orientation()) {
        m_splitter->setOrientation(orientation);
        m_isDivided = false;
    }
}

} // namespace posewire::gui
