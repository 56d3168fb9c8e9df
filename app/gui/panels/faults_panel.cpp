// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/faults_panel.h"

#include "app/gui/base/saving.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"

#include <QKeyEvent>
#include <QMenu>

namespace posewire::gui {

FaultsPanel::FaultsPanel(model::SessionView& view, Commands& commands, QWidget* parent)
    : Panel(view, commands, parent) {
    const int margin = CellDelegate::margin(fontMetrics());
    auto* head = spacedRow({margin, margin / 2, margin, margin / 2}, margin);
    head->addWidget(m_span, 1);
    head->addWidget(m_choice);
    auto* column = tightColumn(this);
    column->addLayout(head);
    column->addWidget(new Line(this));
    column->addWidget(m_table, 1);
    column->addWidget(m_message);
    m_span->setObjectName(QStringLiteral("span"));
    m_span->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    m_table->setModel(&m_faults);
    m_table->setRootIsDecorated(true);
    m_table->setSelectionBehavior(QAbstractItemView::SelectItems);
    m_table->setAllColumnsShowFocus(false);
    m_table->setEmptyText(tr("No stream received yet.\nWhat each character lost, and whose fault it was, is "
                             "counted here: this computer, the network, the sender, or not known."));
    connect(m_table, &QAbstractItemView::activated, this,
            [this](const QModelIndex& cell) { showPackets(cell, PacketLook::InContext); });
    connect(m_table, &QAbstractItemView::clicked, this, &FaultsPanel::select);
    connect(m_table, &TableView::menuRequested, this, &FaultsPanel::addActions);
    connect(&m_faults, &QAbstractItemModel::modelAboutToBeReset, this, &FaultsPanel::keepPlace);
    connect(&m_faults, &QAbstractItemModel::modelReset, this, &FaultsPanel::restorePlace);
    m_table->installEventFilter(this);
    refresh();
}

void FaultsPanel::refresh() {
    m_choice->refresh();
    m_faults.refresh();
    const QString span = spanText(m_view);
    m_span->setText(tr("Samples lost"), span.isEmpty() ? QString() : QStringLiteral(" · ") + span);
    m_span->setAccessibleName(m_span->text());
}

QString FaultsPanel::summary() const {
    const QModelIndex all = m_faults.index(0, FaultModel::kLost);
    if (!all.isValid()) {
        return {};
    }
    const std::uint64_t lost = m_faults.row(all).counts.total();
    return lost == 0 ? tr("none lost") : tr("%1 lost").arg(grouped(lost));
}

void FaultsPanel::showPackets(const QModelIndex& cell, PacketLook look) {
    if (!cell.isValid()) {
        return;
    }
    const bool isLoss = cell.column() >= FaultModel::kThisComputer && cell.column() <= FaultModel::kLost;
    if (isLoss && m_faults.lost(cell) == 0) {
        m_message->say(tr("Nothing is counted in this cell."));
    } else if (!gui::showPackets(m_view, m_commands, m_faults.packetsBehind(cell), look)) {
        m_message->say(noPacketsText());
    }
}

void FaultsPanel::select(const QModelIndex& index) {
    const FaultRow& row = m_faults.row(index);
    if (row.kind == FaultRow::Character || row.kind == FaultRow::Stream) {
        m_commands.select(selectionOf(m_view, row.current));
    }
}

void FaultsPanel::addActions(QMenu& menu, const QModelIndex& index) {
    if (index.isValid()) {
        const QPersistentModelIndex cell(index);
        menu.addAction(tr("Show the packets"), this,
                       [this, cell] { showPackets(cell, PacketLook::InContext); });
        menu.addAction(tr("Show only these packets"), this,
                       [this, cell] { showPackets(cell, PacketLook::Alone); });
        menu.addSeparator();
    }
    menu.addAction(tr("Copy all as CSV"), this, [this] { copyText(m_faults.csv()); });
}

void FaultsPanel::keepPlace() {
    m_opened.clear();
    for (int row = 0; row < m_faults.rowCount(); ++row) {
        if (const QModelIndex index = m_faults.index(row, 0); m_table->isExpanded(index)) {
            m_opened.push_back(m_faults.row(index));
        }
    }
    const QModelIndex current = m_table->currentIndex();
    m_current = current.isValid() ? std::optional(m_faults.row(current)) : std::nullopt;
    m_currentColumn = current.column();
}

void FaultsPanel::restorePlace() {
    for (const FaultRow& row : m_opened) {
        m_table->expand(m_faults.indexOf(row));
    }
    if (m_current) {
        m_table->setCurrentIndex(m_faults.indexOf(*m_current, m_currentColumn));
    }
}

/// Arrows go from cell to cell; at the first column they open and close a row, as in every tree.
bool FaultsPanel::eventFilter(QObject* watched, QEvent* event) {
    const auto* press = event->type() == QEvent::KeyPress ? static_cast<QKeyEvent*>(event) : nullptr;
    const bool isPlain = press != nullptr && (press->modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier;
    const int key = isPlain ? press->key() : 0;
    const QModelIndex current = m_table->currentIndex();
    const bool isClosed =
        current.column() == 0 && m_faults.rowCount(current) > 0 && !m_table->isExpanded(current);
    const bool isMove = (key == Qt::Key_Left && current.column() > 0) || (key == Qt::Key_Right && !isClosed);
    if (watched != m_table || !current.isValid() || !isMove) {
        return Panel::eventFilter(watched, event);
    }
    const int beside = m_table->columns().columnBeside(current.column(), key == Qt::Key_Left ? -1 : 1);
    m_table->setCurrentIndex(current.siblingAtColumn(beside));
    return true;
}

} // namespace posewire::gui
