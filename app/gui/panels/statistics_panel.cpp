// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/statistics_panel.h"

#include "app/gui/base/saving.h"
#include "app/gui/models/computer_facts.h"
#include "app/gui/models/shown_character.h"
#include "core/model/session/roster.h"

#include <QMenu>

namespace posewire::gui {

namespace {

constexpr int kFactsShown = 4;

} // namespace

StatisticsPanel::StatisticsPanel(model::SessionView& view, Commands& commands,
                                 const ReceivingState& receiving, const MonitorHealth& health,
                                 QWidget* parent)
    : Panel(view, commands, parent), m_computer(computerFacts(view, receiving, health)) {
    m_table->setObjectName(QStringLiteral("streams"));
    m_table->setModel(&m_streams);
    m_table->setRootIsDecorated(true);
    m_table->setEmptyText(
        tr("No stream received yet.\nRates, jitter and losses of every stream appear here."));
    m_table->expandNew();
    connect(m_table, &QAbstractItemView::clicked, this, &StatisticsPanel::select);
    connect(m_table, &QAbstractItemView::activated, this,
            [this](const QModelIndex& cell) { showPackets(cell); });
    connect(m_table, &TableView::menuRequested, this, &StatisticsPanel::addActions);
    m_facts->showFacts(m_computer);
    m_facts->setMinimumHeight(m_facts->heightForRows(1));
    m_facts->setMaximumHeight(m_facts->heightForRows(m_computer.rowCount()));
    auto* layout = tightColumn(this);
    layout->addWidget(m_range);
    layout->addWidget(new Line(this));
    layout->addWidget(m_parts, 1);
    layout->addWidget(m_message);
    m_parts->setHandleWidth(1);
    m_parts->addWidget(m_table);
    m_parts->addWidget(m_facts);
    m_parts->setStretchFactor(0, 1);
    m_parts->setStretchFactor(1, 0);
    m_parts->setCollapsible(0, false);
    const int shown = m_facts->heightForRows(kFactsShown);
    m_parts->setSizes({4 * shown, shown});
    m_range->setContextMenuPolicy(Qt::ActionsContextMenu);
    m_range->addAction(m_filterToRange);
    connect(m_filterToRange, &QAction::triggered, this, &StatisticsPanel::filterToRange);
}

void StatisticsPanel::refresh() {
    m_range->refresh();
    m_filterToRange->setEnabled(m_view.range().has_value());
    m_streams.refresh();
    for (int row = 0; row < m_streams.rowCount(); ++row) {
        const QModelIndex index = m_streams.index(row, 0);
        const auto sender = m_streams.sender(index);
        if (m_streams.isEnded(index) && m_folded.insert(*sender).second) {
            m_table->collapse(index); // once: who opens it again keeps it open
        }
    }
    m_computer.refresh();
}

QString StatisticsPanel::summary() const {
    const std::size_t count = m_view.roster().streams().size();
    if (count == 0) {
        return {};
    }
    return tr("%1 · %n streams", nullptr, static_cast<int>(count)).arg(spanText(m_view));
}

void StatisticsPanel::select(const QModelIndex& index) {
    const auto key = m_streams.character(index);
    model::Selection selection = key ? selectionOf(m_view, *key) : model::Selection{};
    selection.sender = m_streams.sender(index);
    m_commands.select(selection);
}

void StatisticsPanel::showPackets(const QModelIndex& index, PacketLook look) {
    const bool isOfStreams = index.isValid() && !m_streams.streamsOf(index).empty();
    if (isOfStreams && !gui::showPackets(m_view, m_commands, packetsBehind(m_view, m_streams, index), look)) {
        m_message->say(noPacketsText());
    }
}

void StatisticsPanel::filterToRange() {
    if (const auto range = m_view.range()) {
        if (!gui::showPackets(m_view, m_commands, {rangeFilter(m_view, *range)}, PacketLook::Alone)) {
            m_message->say(noPacketsText());
        }
    }
}

void StatisticsPanel::addActions(QMenu& menu, const QModelIndex& index) {
    if (index.isValid()) {
        const QPersistentModelIndex current(index);
        menu.addAction(tr("Show the packets"), this, [this, current] { showPackets(current); });
        QMenu* packets = menu.addMenu(tr("Show only these packets"));
        for (int column = 0; column < kStatisticsColumns; ++column) {
            if (const QString title = statisticsFilterTitle(column); !title.isEmpty()) {
                const QPersistentModelIndex cell = index.siblingAtColumn(column);
                packets->addAction(title, this, [this, cell] { showPackets(cell, PacketLook::Alone); });
            }
        }
        menu.addAction(m_filterToRange);
        menu.addSeparator();
    }
    menu.addAction(tr("Copy all as CSV"), this, [this] { copyText(m_streams.csv()); });
}

} // namespace posewire::gui
