// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/commands.h"
#include "app/gui/models/column.h"
#include "core/model/session/session_view.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace posewire::gui {

/// The events of the session, or those that are asked for, in the order in which they began.
class EventModel : public ColumnModel<model::Incident> {
public:
    enum Column : int { kSeverity, kTime, kWho, kText, kCount, kKind, kGroup, kLasted };

    /// What is listed.
    struct Filter {
        bool onlyCurrent = false;
        std::array<bool, 3> severities{true, true, true};   ///< by IncidentSeverity
        std::array<bool, 4> groups{true, true, true, true}; ///< by IncidentGroup
        QString text;                                       ///< in whose or text, whatever the case
        friend bool operator==(const Filter&, const Filter&) = default;
    };

    explicit EventModel(model::SessionView& view, QObject* parent = nullptr);

    /// Shows what has happened meanwhile: at most one removal, one insertion and one change, or a reset where
    /// those would not do.
    void refresh();

    void setFilter(const Filter& filter);
    [[nodiscard]] const Filter& filter() const { return m_filter; }

    /// All there are now have been seen: they are dim from now on, and no longer counted as new.
    void markSeen();

    struct Counts {
        std::size_t current = 0;
        std::size_t all = 0;
        std::size_t unseen = 0;
        std::array<std::size_t, 3> severities{}; ///< by IncidentSeverity
    };
    /// Of all events, whatever the filter.
    [[nodiscard]] Counts counts() const;

    /// Null where the session has dropped it.
    [[nodiscard]] const model::Incident* event(const QModelIndex& index) const;
    /// -1 where it is not listed.
    [[nodiscard]] int rowOf(std::uint64_t number) const;
    [[nodiscard]] std::vector<const model::Incident*> listed() const;

    /// False until markSeen() has been called since it began.
    [[nodiscard]] bool isSeen(const model::Incident& event) const { return event.number < m_seenEnd; }

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;

private:
    [[nodiscard]] bool matches(const model::Incident& event) const;
    void show(std::vector<std::uint64_t> numbers);

    model::SessionView& m_view;
    Filter m_filter;
    std::vector<std::uint64_t> m_numbers; ///< of the events that are listed
    std::uint64_t m_version = 0;          ///< of the events when last shown
    std::uint64_t m_seenEnd = 0;          ///< events before this number have been seen
};

[[nodiscard]] Health healthOf(model::IncidentSeverity severity);
/// "error", "warning", "note".
[[nodiscard]] QString severityWord(model::IncidentSeverity severity);
[[nodiscard]] QString groupWord(model::IncidentGroup group);

/// Whose event it is: "Mira Lin · 02", "Factory", or the address where it is of no character.
[[nodiscard]] QString whoseWords(model::SessionView& view, const model::Incident& event);

/// A few words for a cell or a chip: "31 lost · network", "jitter 12.1 ms", "stale".
[[nodiscard]] QString briefWords(const model::Incident& event);

/// The packet where the newest of it is to be seen: its own, or the last one before where it has none.
/// Nothing where the log has dropped it.
[[nodiscard]] std::optional<std::uint64_t> eventPacket(model::SessionView& view,
                                                       const model::Incident& event);

/// Selects that packet and brings the dock of packets to the front, with its like. False where the log has
/// dropped it.
bool showPacketsOf(model::SessionView& view, Commands& commands, const model::Incident& event);

} // namespace posewire::gui
