// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/incident_words.h"
#include "app/gui/models/tree_model.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

namespace posewire::gui {

/// What one row of the list is about: an incident or a note, or what it was to one stream. Both may be partly
/// or altogether not here yet.
struct IncidentLine {
    using Incident = model::Incident;

    const Incident* settled = nullptr; ///< null if nothing of it is settled
    const Incident* pending = nullptr; ///< what late packets may still bring; null if there is none
    model::ListedIncident::State state{};
    bool isPart = false;
    const Incident::Part* settledPart = nullptr;
    const Incident::Part* pendingPart = nullptr;

    [[nodiscard]] const Incident& incident() const { return settled != nullptr ? *settled : *pending; }
    /// Null for the incident as a whole.
    [[nodiscard]] const Incident::Part* part() const {
        return settledPart != nullptr ? settledPart : pendingPart;
    }
};

/// The incidents of the session with its notes, or those that are asked for, in the order in which they
/// began; below each that touched several streams, these. What is not settled yet is a row of its own, which
/// keeps its place when it is, or is told in the row of what it seems to belong to.
class IncidentModel : public KeyedTreeModel<IncidentLine> {
public:
    enum Column : int {
        kSeverity,
        kTime,
        kWho,
        kText,
        kLost,
        kCause,
        kLasted,
        kCount,
        kKind,
        kGroup,
    };

    struct Filter {
        bool onlyCurrent = false;
        std::array<bool, 3> severities{true, true, true};   ///< by IncidentSeverity
        std::array<bool, 4> groups{true, true, true, true}; ///< by IncidentGroup
        QString text; ///< in whose, also of one among several, or text, whatever the case
        friend bool operator==(const Filter&, const Filter&) = default;
    };

    explicit IncidentModel(model::SessionView& view);

    /// Shows what has happened meanwhile: rows come and go where they belong, and one change is announced; a
    /// reset where too many do at once.
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
    /// Settled incidents, whatever the filter.
    [[nodiscard]] Counts counts() const;

    /// Nothing if it is gone. Valid until the next refresh.
    [[nodiscard]] std::optional<IncidentLine> line(const QModelIndex& index) const;
    /// The row of an incident as a whole; invalid where it is not listed.
    [[nodiscard]] QModelIndex indexOf(std::uint64_t number) const;
    /// Those that are settled.
    [[nodiscard]] std::vector<const model::Incident*> listed() const;

    /// False until markSeen() has been called since it began.
    [[nodiscard]] bool isSeen(const model::Incident& incident) const {
        return incident.number < m_seenEnd && incident.number != 0;
    }

    [[nodiscard]] QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
    [[nodiscard]] QModelIndex parent(const QModelIndex& index) const override;
    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;

private:
    /// The number of an incident; below 0 for a sum of those that are not listed any more.
    using Key = std::int64_t;
    using Keys = std::vector<Key>;
    /// Character and type, as far as a part is of one.
    using Stream = std::pair<std::optional<model::CharacterKey>, std::optional<std::uint8_t>>;
    using State = model::ListedIncident::State;

    [[nodiscard]] std::optional<IncidentLine> whole(Key key) const;
    [[nodiscard]] bool matches(const IncidentLine& line) const;
    /// Which incident something that is not here yet belongs to, as far as can be told; nothing if it may
    /// become one of its own.
    [[nodiscard]] std::optional<Key> hostOf(const model::Incident& pending) const;
    /// Reads what may change without the list: whether any did.
    bool readUnsettled();
    void show(const Keys& keys);
    [[nodiscard]] std::vector<Stream> streamsOf(Key key) const;
    /// Those below an incident.
    void showStreams(Key key);
    [[nodiscard]] int rowOf(Key key) const;

    model::SessionView& m_view;
    Filter m_filter;
    Keys m_keys;                                            ///< of the rows, growing
    std::unordered_map<Key, std::vector<Stream>> m_streams; ///< below rows that have several
    std::map<Key, model::ListedIncident> m_pending;         ///< by the row that tells it
    std::map<Key, State> m_current;                         ///< of those that last
    std::uint64_t m_version = 0;                            ///< of the incidents when last shown
    bool m_isFilterNew = false;
    std::uint64_t m_seenEnd = 0; ///< those before this number have been seen
};

} // namespace posewire::gui
