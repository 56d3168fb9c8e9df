// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/packets_panel.h"

#include "app/gui/models/text.h"
#include "app/gui/panels/fitting_header.h"

#include <QScopedValueRollback>
#include <QShortcut>

#include <utility>

namespace posewire::gui {

PacketsPanel::PacketsPanel(model::SessionView& view, Commands& commands, QWidget* parent)
    : Panel(view, commands, parent), m_filter(view, m_packets) {
    auto* column = tightColumn(this);
    column->addWidget(m_filterBar);
    column->addWidget(m_find);
    column->addWidget(new Line(this));
    column->addWidget(m_list, 1);
    column->addWidget(m_message);
    m_list->setModel(&m_packets);
    m_clear->setObjectName(QStringLiteral("clearFilter"));
    m_clear->hide();
    m_message->setObjectName(QStringLiteral("message"));
    connect(m_list->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            &PacketsPanel::selectRow);
    connect(m_list, &PacketView::newestRequested, this, &PacketsPanel::goToNewest);
    new QShortcut(
        QKeySequence::Copy, m_list, this, [this] { copy(Copied::Rows); }, Qt::WidgetShortcut);
    connect(m_list, &PacketView::menuRequested, this, &PacketsPanel::showMenu);
    connect(&m_filterBar->line(), &FilterLine::applied, this, [this](const QString& text) {
        m_commands.setDisplayFilter(text);
        refresh();
    });
    connect(m_filterBar, &FilterBar::cancelRequested, this, [this] {
        m_filter.cancel();
        say(tr("Filtering was cancelled: the list holds what was found until then."));
        refresh();
    });
    connect(m_filterBar, &FilterBar::backRequested, this, [this] {
        focusList();
        m_commands.goBack();
    });
    connect(&m_commands, &Commands::wentBack, this, [this] {
        refresh();
        m_list->setFollowing(!m_view.choices().selection.packet);
    });
    connect(&m_filterBar->line(), &FilterLine::left, this, &PacketsPanel::focusList);
    connect(m_clear, &QPushButton::clicked, this, [this] {
        m_commands.setDisplayFilter({});
        refresh();
        focusList();
    });
    connect(m_find, &FindBar::findRequested, this, &PacketsPanel::find);
    connect(m_find, &FindBar::found, this, [this](const model::FoundBytes& bytes) {
        showPacket(bytes.packet);
        model::Selection selection = m_view.choices().selection;
        selection.found = bytes;
        m_commands.select(selection);
    });
    connect(m_find, &FindBar::closed, this, &PacketsPanel::focusList);
    showEmptyState();
}

void PacketsPanel::refresh() {
    const QScopedValueRollback guard(m_isFollowing, true);
    const model::Jump* jump = m_view.choices().filterJump();
    m_filterBar->setJump(jump == nullptr ? std::nullopt
                                         : std::optional(QString::fromStdString(jump->filterBefore)));
    const bool wasLate = m_filter.missed() != 0;
    if (m_filter.follow()) {
        m_filterBar->line().setApplied(m_filter.text());
        m_filterBar->setProgress(std::nullopt);
    }
    m_filterBar->setProgress(m_filter.progress());
    if (!wasLate && m_filter.missed() != 0) {
        say(tr("Packets left memory before the filter looked at them; the title says how many."));
    }
    m_list->setCatchingUp(m_filter.isCatchingUp());
    m_packets.refresh();
    followSelection();
    followCursor();
    const bool isHeld =
        m_view.choices().selection.packet || m_view.choices().cursor.mode == model::Cursor::Mode::Paused;
    if (std::exchange(m_isHeld, isHeld) && !isHeld) {
        m_list->setFollowing(true); // all is live again
    }
    showEmptyState();
}

/// Where the operator stops in the past, the list shows what was received by then.
void PacketsPanel::followCursor() {
    const model::Cursor& cursor = m_view.choices().cursor;
    const bool isPaused = cursor.mode == model::Cursor::Mode::Paused;
    const std::optional<std::uint64_t> stop = isPaused ? std::optional(cursor.packet) : std::nullopt;
    if (stop == m_stoppedAt) {
        return;
    }
    m_stoppedAt = stop;
    const int row = stop ? m_packets.rowFrom(*stop + 1) - 1 : -1;
    const QModelIndex index = m_packets.index(row, 0);
    if (index.isValid() && !m_list->isShown(index)) {
        m_list->setFollowing(false);
        m_list->scrollTo(index, QAbstractItemView::PositionAtCenter);
    }
}

/// A list that gets the focus takes a row, which nobody chose.
void PacketsPanel::focusList() {
    const QScopedValueRollback guard(m_isFollowing, true);
    m_list->setFocus();
}

void PacketsPanel::followSelection() {
    const auto packet = m_view.choices().selection.packet;
    const int row = packet ? m_packets.rowOf(*packet) : -1;
    if (row == m_list->currentIndex().row()) {
        return;
    }
    if (row < 0) {
        m_list->selectionModel()->clear();
        m_list->viewport()->update();
        return;
    }
    m_list->showRow(row);
}

void PacketsPanel::selectRow(const QModelIndex& index) {
    if (m_isFollowing || !index.isValid()) {
        return;
    }
    m_list->setFollowing(false);
    m_commands.selectPacket(m_packets.packetAt(index.row()));
}

void PacketsPanel::showEmptyState() {
    const bool isEmpty = m_packets.rowCount() == 0;
    const bool isFilteredOut = isEmpty && m_packets.isFiltered() && m_view.end() != m_view.begin();
    const bool isCleared = m_filter.text().trimmed().isEmpty();
    m_list->setEmptyText(
        !isFilteredOut ? tr("No packets yet. Every packet that arrives is listed here, readable or not.")
        : m_filter.progress() ? tr("Filtering …")
        : isCleared           ? tr("No packet is in the selected range")
                              : tr("No packet matches the filter\n\n"));
    m_clear->setVisible(isFilteredOut && !m_filter.progress() && !isCleared);
    if (m_clear->isVisible()) {
        m_clear->resize(m_clear->sizeHint());
        const QRect area = m_list->viewport()->geometry();
        m_clear->move(area.center().x() - m_clear->width() / 2,
                      area.center().y() + fontMetrics().height() / 4);
    }
}

QString PacketsPanel::summary() const {
    const std::uint64_t all = m_view.end() - m_view.begin();
    if (all == 0) {
        return {};
    }
    const auto rows = static_cast<std::uint64_t>(m_packets.rowCount());
    QString count =
        m_packets.isFiltered() ? tr("%1 of %2 shown").arg(grouped(rows), grouped(all)) : grouped(rows);
    if (m_filter.hasRange()) {
        count += tr(", of the selected range");
    }
    if (m_filter.missed() != 0) {
        count += tr(" · %1 not looked at in time").arg(grouped(m_filter.missed()));
    }
    if (!m_list->isFollowing() || m_view.isRecording()) {
        return count;
    }
    const bool isPaused = m_view.choices().cursor.mode == model::Cursor::Mode::Paused;
    return (isPaused ? tr("now · %1") : tr("following · %1")).arg(count);
}

void PacketsPanel::say(const QString& text) {
    const bool isSelectionSeen = m_list->isShown(m_list->currentIndex());
    m_message->say(text);
    if (isSelectionSeen) {
        layout()->activate(); // the list is lower from here on
        m_list->scrollTo(m_list->currentIndex());
    }
}

QJsonObject PacketsPanel::state() const {
    QJsonObject state = m_filterBar->state();
    if (m_packets.timeMode() == PacketModel::TimeMode::TimeOfDay) {
        state["time"] = QStringLiteral("day");
    }
    if (m_packets.deltaMode() == PacketModel::DeltaMode::RowAbove) {
        state["delta"] = QStringLiteral("row");
    }
    state.insert("columns", m_list->header().state().value("columns"));
    return state;
}

void PacketsPanel::restoreState(const QJsonObject& state) {
    m_filterBar->restoreState(state);
    m_list->header().restore(state);
    m_packets.setTimeMode(state["time"].toString() == QLatin1String("day")
                              ? PacketModel::TimeMode::TimeOfDay
                              : PacketModel::TimeMode::SinceFirst);
    m_packets.setDeltaMode(state["delta"].toString() == QLatin1String("row")
                               ? PacketModel::DeltaMode::RowAbove
                               : PacketModel::DeltaMode::Stream);
}

} // namespace posewire::gui
