// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/session/session_view.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Whether it is good: in the window, the report and the JSON the same answer in the same words.
namespace posewire::model {

/// An incident as it is listed: with what is not settled yet.
struct ListedIncident {
    enum class State : std::uint8_t { Provisional, Ongoing, Over };
    Incident incident;
    State state = State::Ongoing;
};
/// "provisional", "ongoing", "over".
[[nodiscard]] std::string_view nameOf(ListedIncident::State state);

/// All incidents of a session that are no notes, by growing number; for each sender one more with what has
/// not come yet and may. Their samples sum up to what the streams lost, by cause.
[[nodiscard]] std::vector<ListedIncident> listedIncidents(const SessionView& session);

/// Those of them that the session's own list does not have, oldest first: what is not settled yet, without
/// what is only just coming, and sums of what is not listed any more, which have no number.
[[nodiscard]] std::vector<ListedIncident> unsettledIncidents(const SessionView& session);
/// Of an incident of the session's list; a note is over unless it lasts.
[[nodiscard]] ListedIncident::State stateOf(const SessionView& session, const Incident& incident);
/// Whether it is a note: something to know, and no fault.
[[nodiscard]] bool isNote(const Incident& incident);

/// The answer to: is it good, and if not, whose fault, and is it over?
struct TakeVerdict {
    enum class State : std::uint8_t { None, Good, Warning, Bad };
    State state = State::None;
    std::string text;   ///< one line, the worst first
    std::string brief;  ///< the same in a few words, without whose and since when: "37 lost, network"
    log::Stamp since{}; ///< when what it says began; of Good when the last incident was over; of None 0
    std::optional<std::uint64_t> incident{}; ///< that it rests on
    std::optional<CharacterKey> character{}; ///< that it is about, where it is one

    friend bool operator==(const TakeVerdict&, const TakeVerdict&) = default;
};
/// "none", "good", "warning", "bad".
[[nodiscard]] std::string_view nameOf(TakeVerdict::State state);

/// What counts: incidents that have ended before it are forgotten, those that began after it are not known.
struct VerdictSpan {
    /// Live, an incident that is over is mentioned for as long.
    static constexpr log::Duration kRecent = std::chrono::seconds(10);
    log::Stamp from = log::Stamp::min();
    log::Stamp to = log::Stamp::max();
};
/// The last moments of what is on the wire, but nothing before the reset.
[[nodiscard]] VerdictSpan recentSpan(const SessionView& session);

/// Of all together, and of each character.
struct TakeVerdicts {
    TakeVerdict all;
    std::map<CharacterKey, TakeVerdict> characters;
};
[[nodiscard]] TakeVerdicts verdictsOf(const SessionView& session, const VerdictSpan& span);

/// Of all, or of one character and its sender, through restarts of the sender.
[[nodiscard]] TakeVerdict verdictOf(const SessionView& session, const VerdictSpan& span,
                                    std::optional<CharacterKey> character = {});

/// "37 samples lost on Jonas, network": what an incident is in a few words, and whose.
[[nodiscard]] std::string headlineOf(const SessionView& session, const ListedIncident& listed);

} // namespace posewire::model
