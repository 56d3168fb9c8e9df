// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/packets_panel.h"

#include "app/gui/models/display_filter.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/filter_bar.h"
#include "app/gui/panels/fitting_header.h"
#include "core/model/session/accounts.h"

#include <QPushButton>
#include <QScopedValueRollback>

#include <utility>

namespace posewire::gui {

namespace {

constexpr int kPollMs = 20;

} // namespace

PacketsPanel::PacketsPanel(model::SessionView& view, Commands& commands, QWidget* parent)
    : Panel(view, commands, parent),
      m_packets(view),
      m_filter(new FilterBar(this)),
      m_find(new FindBar(this)),
      m_list(new PacketView(tr("Packets"), this)),
      m_clear(new QPushButton(tr("Clear the filter"), m_list)),
      m_message(footMessage(this)) {
    auto* column = tightColumn(this);
    column->addWidget(m_filter);
    column->addWidget(m_find);
    column->addWidget(new Line(this));
    column->addWidget(m_list, 1);
    column->addWidget(m_message);
    m_list->setModel(&m_packets);
    m_clear->setObjectName(QStringLiteral("clearFilter"));
    m_clear->hide();
    m_message->setObjectName(QStringLiteral("message"));
    connectParts();
    showEmptyState();
}

PacketsPanel::~PacketsPanel() = default;

void PacketsPanel::connectParts() {
    connect(m_list->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            &PacketsPanel::selectRow);
    connect(m_list, &PacketView::newestRequested, this, &PacketsPanel::goToNewest);
    connect(m_list, &PacketView::copyRequested, this, [this] { copyRows(RowFormat::Text); });
    connect(m_list, &PacketView::menuRequested, this, &PacketsPanel::showMenu);
    connect(m_filter, &FilterBar::applied, this, [this](const QString& text) {
        m_commands.setDisplayFilter(text);
        refresh();
    });
    connect(m_filter, &FilterBar::cancelRequested, this, &PacketsPanel::cancelFilter);
    connect(m_filter, &FilterBar::backRequested, this, &PacketsPanel::goBack);
    connect(m_filter, &FilterBar::left, this, &PacketsPanel::focusList);
    connect(m_clear, &QPushButton::clicked, this, &PacketsPanel::clearFilter);
    connect(m_find, &FindBar::findRequested, this, &PacketsPanel::search);
    connect(m_find, &FindBar::closed, this, &PacketsPanel::focusList);
    m_poll.setInterval(kPollMs);
    connect(&m_poll, &QTimer::timeout, this, &PacketsPanel::takeFound);
}

void PacketsPanel::refresh() {
    const QScopedValueRollback guard(m_isFollowing, true);
    followFilter();
    m_list->setCatchingUp(m_run && m_filtered < m_backlog);
    if (m_run) {
        takeMatches();
    }
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

void PacketsPanel::takeMatches() {
    const PacketFilterRun::Found found = m_run->take(m_view);
    m_packets.addMatches(found.packets, found.problems);
    const auto [done, total, gone] = m_run->progress();
    m_filtered = done;
    const bool isBusy = !m_run->isCancelled() && done < m_backlog;
    m_filter->setProgress(isBusy ? std::optional(static_cast<double>(done) / static_cast<double>(m_backlog))
                                 : std::nullopt);
    if (m_unfiltered == 0 && gone != 0) {
        say(tr("Packets left memory before the filter looked at them; the title says how many."));
    }
    m_unfiltered = gone;
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

void PacketsPanel::followRange() {
    const auto chosen = m_view.choices().range.fixed;
    const auto packet = m_view.choices().selection.packet;
    if (std::exchange(m_chosenRange, chosen) != chosen) {
        m_range = chosen;
    } else if (m_range && packet && packet != m_selectedPacket) {
        const auto selected = m_view.packet(*packet);
        const bool isInside = selected && selected->stamp >= m_range->from && selected->stamp < m_range->to;
        m_range = isInside ? m_range : std::nullopt;
    }
    m_selectedPacket = packet;
}

/// The session's filter may have been set by another dock.
void PacketsPanel::followFilter() {
    const model::Jump* jump = m_view.choices().filterJump();
    m_filter->setJump(jump == nullptr ? std::nullopt
                                      : std::optional(QString::fromStdString(jump->filterBefore)));
    const QString text = QString::fromStdString(m_view.choices().displayFilter);
    // What a sender's positions come in turns out, or is declared, while it sends.
    const auto units = m_comparesLengths ? unusualPositionUnits(m_view) : PositionUnits();
    const log::Stamp first = m_view.firstStamp(); // from which times count: of the first packet, once there
    followRange();
    if (text == m_filterText && units == m_filterUnits && first == m_filterFirst &&
        m_range == m_filterRange) {
        return;
    }
    m_filterText = text;
    m_filterRange = m_range;
    m_filterFirst = first;
    m_filter->setApplied(text);
    const QString condition =
        m_range ? joinedFilter(text, rangeFilter(m_view, *m_range), FilterJoin::And) : text.trimmed();
    auto compiled = filter::Filter::compile(condition.toStdString());
    if (!compiled) {
        return; // the line says what is wrong; what is listed stays
    }
    m_run.reset();
    m_filter->setProgress(std::nullopt);
    m_comparesLengths = compiled->comparesLengths();
    m_filterUnits = m_comparesLengths ? unusualPositionUnits(m_view) : PositionUnits();
    if (compiled->matchesEverything()) {
        m_packets.endMatches();
    } else {
        m_packets.beginMatches();
        m_filtered = 0;
        m_unfiltered = 0;
        m_backlog = m_view.accounts().digests().end() - m_view.accounts().digests().begin();
        m_run = std::make_unique<PacketFilterRun>(m_view, *std::move(compiled), m_filterUnits);
    }
}

void PacketsPanel::cancelFilter() {
    if (m_run) {
        m_run->cancel();
        m_filter->setProgress(std::nullopt);
        say(tr("Filtering was cancelled: the list holds what was found until then."));
        refresh();
    }
}

void PacketsPanel::clearFilter() {
    m_commands.setDisplayFilter({});
    refresh();
    focusList();
}

/// A list that gets the focus takes a row, which nobody chose.
void PacketsPanel::focusList() {
    const QScopedValueRollback guard(m_isFollowing, true);
    m_list->setFocus();
}

void PacketsPanel::goBack() {
    if (!m_view.choices().canGoBack()) {
        say(tr("There is nothing to go back to: no jump led here."));
        return;
    }
    focusList();
    m_commands.goBack();
    refresh();
    m_list->setFollowing(!m_view.choices().selection.packet);
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
    const bool isCleared = m_filterText.trimmed().isEmpty();
    m_list->setEmptyText(
        !isFilteredOut ? tr("No packets yet. Every packet that arrives is listed here, readable or not.")
        : m_filter->isBusy() ? tr("Filtering …")
        : isCleared          ? tr("No packet is in the selected range")
                             : tr("No packet matches the filter\n\n"));
    m_clear->setVisible(isFilteredOut && !m_filter->isBusy() && !isCleared);
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
    if (m_filterRange) {
        count += tr(", of the selected range");
    }
    if (m_packets.isFiltered() && m_unfiltered != 0) {
        count += tr(" · %1 not looked at in time").arg(grouped(m_unfiltered));
    }
    return m_list->isFollowing() ? tr("following · %1").arg(count) : count;
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
    QJsonObject state = m_filter->state();
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
    m_filter->restoreState(state);
    m_list->header().restore(state);
    setTimeMode(state["time"].toString() == QLatin1String("day") ? PacketModel::TimeMode::TimeOfDay
                                                                 : PacketModel::TimeMode::SinceFirst);
    m_packets.setDeltaMode(state["delta"].toString() == QLatin1String("row")
                               ? PacketModel::DeltaMode::RowAbove
                               : PacketModel::DeltaMode::Stream);
}

} // namespace posewire::gui
