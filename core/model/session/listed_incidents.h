// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/session/session_view.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What happened, with what is not settled yet, in the words that all views use.
namespace posewire::model {

/// An incident as it is listed: with what is not settled yet.
struct ListedIncident {
    enum class State : std::uint8_t { Provisional, Ongoing, Over };
    Incident incident;
    State state = State::Ongoing;
};
/// "provisional", "ongoing", "over".
[[nodiscard]] std::string_view nameOf(ListedIncident::State state);

/// All incidents of a session that are no notes, that began up to `to` and lasted into `from`, by growing
/// number; for each sender one more with what has not come yet and may. Of all time, their samples sum up to
/// what the streams lost, by cause.
[[nodiscard]] std::vector<ListedIncident> listedIncidents(const SessionView& session,
                                                          log::Stamp from = log::Stamp::min(),
                                                          log::Stamp to = log::Stamp::max());

/// Those of them that the session's own list does not have, oldest first: what is not settled yet, without
/// what is only just coming, and sums of what is not listed any more, which have no number.
[[nodiscard]] std::vector<ListedIncident> unsettledIncidents(const SessionView& session);
/// Of an incident of the session's list; a note is over unless it lasts.
[[nodiscard]] ListedIncident::State stateOf(const SessionView& session, const Incident& incident);
/// Of a part of an incident; null where it is of no stream, or that is there no more.
[[nodiscard]] const Stream* streamOf(const SessionView& session, log::SenderId sender,
                                     const Incident::Part& part);
/// Whether it is a note: something to know, and no fault.
[[nodiscard]] bool isNote(const Incident& incident);

/// Whether it is of a sample of which the rest is just coming.
[[nodiscard]] bool isOnlyComing(const ListedIncident& one);

/// "37 samples lost on Jonas, network": what an incident is in a few words, and whose. `lost` is said instead
/// of how much it lost in all.
[[nodiscard]] std::string headlineOf(const SessionView& session, const ListedIncident& listed,
                                     const std::string& lost = {});

/// "Jonas", "Jonas and Mira", "4 characters".
[[nodiscard]] std::string namesOrCount(const SessionView& session, std::span<const CharacterKey> characters);

/// Of several outages that go on at once, or several characters that are sent twice: all of them, and the
/// cause where it is one.
[[nodiscard]] std::string headlineOf(const SessionView& session, std::span<const ListedIncident> together);

/// What happened, without to whom and whose it was: "37 lost".
[[nodiscard]] std::string briefOf(const SessionView& session, const ListedIncident& listed);
/// What it rests on, in a sentence.
[[nodiscard]] std::string evidenceOf(const ListedIncident& listed);
/// Whose loss it was, to be added to that: ", network", ", cause unknown"; empty for what is no loss.
[[nodiscard]] std::string causeOf(const ListedIncident& listed);
/// ", since 03:28:07", or ", 03:28:07 to 03:28:09" of what is over.
[[nodiscard]] std::string whenOf(const SessionView& session, const ListedIncident& listed);

} // namespace posewire::model
