// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/foreign_text.h"
#include "core/model/incidents/incident.h"
#include "core/model/session/session_view.h"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace posewire::log {
struct Displaced;
}

namespace posewire::model {

struct Stream;

/// An incident as it is listed: with what is not settled yet.
struct ListedIncident {
    enum class State : std::uint8_t { Provisional, Ongoing, Over };
    Incident incident;
    State state = State::Ongoing;
    std::optional<log::Stamp> rangeEnd{}; ///< of what was in a range: what came after it does not count
};
/// "provisional", "ongoing", "over".
[[nodiscard]] std::string_view nameOf(ListedIncident::State state);

/// All incidents of a session that are no notes, that began up to `to` and lasted into `from`, by growing
/// number; for each sender one more with what has not come yet and may. Of all time, their samples sum up to
/// what the streams lost, by cause.
[[nodiscard]] std::vector<ListedIncident> listedIncidents(const SessionView& session,
                                                          log::Stamp from = log::Stamp::min(),
                                                          log::Stamp to = log::Stamp::max());

/// The part of an incident that was in a range; nothing if none of it was.
[[nodiscard]] std::optional<ListedIncident> withinRange(const SessionView& session, ListedIncident one,
                                                        const TimeRange& range);

/// Those of them that the session's own list does not have, oldest first: what is not settled yet, without
/// what is only just coming, and sums of what is not listed any more, which have no number.
[[nodiscard]] std::vector<ListedIncident> unsettledIncidents(const SessionView& session);
/// Of an incident of the session's list; a note is over unless it lasts.
[[nodiscard]] ListedIncident::State stateOf(const SessionView& session, const Incident& incident);
/// Of a part of an incident; null if it is of no stream, or that is there no more.
[[nodiscard]] const Stream* streamOf(const SessionView& session, const Incident::Part& part);
[[nodiscard]] bool isNote(const Incident& incident);

[[nodiscard]] bool isOnlyComing(const ListedIncident& one);

/// "Jonas", "Jonas and Mira", "4 characters".
[[nodiscard]] words::Value whoOf(const SessionView& session, std::span<const CharacterKey> characters);

/// Of its senders, each once; "this computer" if it is of none.
[[nodiscard]] std::vector<ForeignText> addressesOf(const SessionView& session, const Incident& incident);

[[nodiscard]] words::Fact factOf(const SessionView& session, const ListedIncident& listed);
/// A recording that had to go on in another file.
[[nodiscard]] words::Fact factOf(const log::Displaced& file);
/// Of several outages that last at once, or several characters that are sent twice: all of them, with the
/// cause if it is one.
[[nodiscard]] words::Fact factOf(const SessionView& session, std::span<const ListedIncident> together);
/// "since 03:28:07", or "03:28:07 to 03:28:09" of what is over.
[[nodiscard]] words::Fact whenOf(const SessionView& session, const ListedIncident& listed);

} // namespace posewire::model
