// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/incidents/incident.h"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

namespace posewire::model {

/// The incidents of a session, notes among them. Bounded: the oldest that have ended go first, and details
/// are clipped.
class Incidents {
public:
    static constexpr std::size_t kMost = 10'000;
    /// Parts of all incidents together.
    static constexpr std::size_t kMostParts = 100'000;
    static constexpr std::size_t kMostDetailBytes = 1'024;
    /// What happens again within this time is of the same incident.
    static constexpr log::Duration kQuiet = std::chrono::seconds(5);

    /// Oldest first.
    [[nodiscard]] const std::deque<Incident>& all() const { return m_incidents; }
    /// Grows whenever an incident comes, changes or goes.
    [[nodiscard]] std::uint64_t version() const { return m_version; }

    /// Those that last, in the order in which they began.
    [[nodiscard]] std::vector<const Incident*> current() const;
    /// Those of one sender that last, in any order.
    [[nodiscard]] std::vector<const Incident*> currentOf(log::SenderId sender) const;
    /// Those that lasted at a time in the past, in the same order, with all that is known of them now.
    [[nodiscard]] std::vector<const Incident*> currentAt(log::Stamp stamp) const;
    [[nodiscard]] std::size_t memoryBytes() const;
    /// Null if there is none of that number, or none any more.
    [[nodiscard]] const Incident* find(std::uint64_t number) const;
    /// What an occurrence would be of, were it reported now; null if it would begin one.
    [[nodiscard]] const Incident* currentLike(const Occurrence& like) const;

    /// Something happened: a new incident, or more of one that lasts. Returns its number.
    std::uint64_t report(Occurrence one);
    /// More of an incident that may be over.
    void addTo(std::uint64_t number, const Occurrence& one);
    /// Samples of a stream were not lost after all; `gaps` fewer were. What comes to nothing is gone.
    void takeBack(std::uint64_t number, const Incident::Part& part, std::uint64_t samples,
                  std::uint64_t gaps);
    /// So much of what should have come is lost, from 0 to 1 by part: in the window of limits, and in the
    /// time of a verdict. What is above a limit, in percent, in the window makes a loss graver, for good; a
    /// part that is above it in both is, until it is below `hysteresis` of it in the longer one.
    void noteShares(std::uint64_t number, const std::vector<double>& inWindow,
                    const std::vector<double>& recent, double limit, double hysteresis);
    /// For one character it was none; what comes to nothing is gone.
    void takeBackPart(std::uint64_t number, const CharacterKey& character);
    /// It is over.
    void end(std::uint64_t number, log::Stamp stamp);
    /// For one stream or character; and altogether, where it was the last of them.
    void endPart(std::uint64_t number, const CharacterKey& character, std::optional<std::uint8_t> type,
                 log::Stamp stamp);
    /// The same for a character as a whole, which ended then, however long it was thought to last.
    void endPartExactly(std::uint64_t number, const CharacterKey& character, log::Stamp stamp);
    /// Hosts that were silent together had one outage: of those that are over, one number is left. Returns
    /// it.
    std::uint64_t joinOutages(std::uint64_t number);
    /// Whose fault it was is known now.
    void setCause(std::uint64_t number, LossCause cause);
    /// The number that the next loss of a sender will have where it begins an incident: so that what is not
    /// settled yet keeps its number when it is.
    std::uint64_t reserve(log::SenderId sender);
    /// Nothing of a sender lasts any longer.
    void retire(log::SenderId sender);
    /// Ends what has been quiet for long, by the time of the log.
    void advance(log::Stamp stamp);

private:
    /// Those of a sender are next to each other.
    struct Episode {
        log::SenderId sender{};
        IncidentKind kind{};
        std::optional<std::uint8_t> character{};
        std::optional<LossCause> cause{};
        ContentFault what{};

        friend auto operator<=>(const Episode&, const Episode&) = default;
    };
    [[nodiscard]] static Episode episodeOf(const Occurrence& one);
    [[nodiscard]] static Episode episodeOf(const Incident& incident);
    Incident& begin(const Occurrence& one);
    void add(Incident& incident, const Occurrence& one);
    Incident::Part* partOf(Incident& incident, const Incident::Part& one);
    [[nodiscard]] Incident* findOwn(std::uint64_t number) { return const_cast<Incident*>(find(number)); }
    [[nodiscard]] std::deque<Incident>::iterator placeOf(std::uint64_t number);
    void join(std::uint64_t to, std::uint64_t from);
    void changed(Incident& incident) { incident.version = ++m_version; }
    void erase(std::uint64_t number);
    void forget();

    std::deque<Incident> m_incidents; ///< by growing number
    std::map<Episode, std::uint64_t> m_current;
    std::map<std::uint64_t, std::uint64_t> m_joined; ///< the number of others now
    std::map<log::SenderId, std::uint64_t> m_reserved;
    std::size_t m_parts = 0;
    std::uint64_t m_next = 1;
    std::uint64_t m_version = 0;
};

} // namespace posewire::model
