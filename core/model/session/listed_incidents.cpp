// SPDX-License-Identifier: MIT
#include "core/model/session/listed_incidents.h"

#include "core/log/clock.h"
#include "core/log/ip_address.h"
#include "core/model/accounting/count_history.h"
#include "core/model/accounting/gap.h"
#include "core/model/incidents/incident_kinds.h"
#include "core/model/session/loss_amount.h"
#include "core/model/session/losses.h"
#include "core/model/text.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <map>

namespace posewire::model {
namespace {

using State = ListedIncident::State;

/// Of less time a share says little: a burst of a few datagrams is most of what came meanwhile.
constexpr log::Duration kLeastOfShare = std::chrono::seconds(1);

constexpr std::size_t kUnknownCause = static_cast<std::size_t>(LossCause::Unknown);

/// "03:28:07", as the receiving computer's clock shows it.
std::string clockText(log::WallTime time) {
    const std::time_t seconds =
        std::chrono::floor<std::chrono::seconds>(time).time_since_epoch() / std::chrono::seconds(1);
    const std::tm local = log::localTime(seconds);
    std::array<char, 16> text{};
    std::strftime(text.data(), text.size(), "%H:%M:%S", &local);
    return text.data();
}

/// What no incident of the list tells of a sender.
struct Untold {
    LossesByCause lost{};
    std::vector<Incident::Part> stalled; ///< streams that are missing while others of their character go on
};

std::map<log::SenderId, Untold> untoldOf(const SessionView& session) {
    std::map<log::SenderId, Untold> rest;
    for (const Stream& stream : session.streams()) {
        Untold& own = rest[stream.key.sender];
        addLosses(own.lost, stream.lostByCause());
        if (stream.isStalled) {
            own.stalled.push_back({stream.key.character, stream.key.type, 0, 0, stream.accounting.lastStamp(),
                                   session.knownUntil()});
        }
    }
    for (const Incident& incident : session.incidents().all()) {
        if (const auto own = rest.find(incident.sender); own != rest.end() && incident.samples != 0) {
            std::uint64_t& sum =
                own->second.lost[static_cast<std::size_t>(incident.cause.value_or(LossCause::Unknown))];
            sum -= std::min(sum, incident.samples);
        }
    }
    session.forEachPending([&](const PendingLoss& loss) {
        if (const auto own = rest.find(loss.stream.sender); own != rest.end() && loss.isUnderWay) {
            std::uint64_t& sum = own->second.lost[kUnknownCause];
            sum -= std::min(sum, loss.samples);
        }
    });
    return rest;
}

/// What is not there yet: gaps that late arrivals may still fill, samples of which a part is under way, and
/// streams that are missing.
ListedIncident provisionalOf(const SessionView& session, log::SenderId sender, const Untold& untold) {
    ListedIncident listed;
    listed.state = State::Provisional;
    Incident& incident = listed.incident;
    incident.kind = IncidentKind::Loss;
    incident.sender = sender;
    incident.cause = LossCause::Unknown;
    incident.samples = untold.lost[kUnknownCause];
    incident.firstStamp = log::Stamp::max();
    incident.version = session.incidents().version();
    session.forEachPending([&](const PendingLoss& loss) {
        if (loss.stream.sender == sender && !loss.isUnderWay) {
            incident.firstStamp = std::min(incident.firstStamp, loss.from);
            incident.lastStamp = std::max(incident.lastStamp, loss.to);
            incident.parts.push_back(
                {loss.stream.character, loss.stream.type, 1, loss.samples, loss.from, loss.to});
            ++incident.count;
        }
    });
    for (const Incident::Part& part : untold.stalled) {
        incident.firstStamp = std::min(incident.firstStamp, part.from);
        incident.lastStamp = std::max(incident.lastStamp, part.to);
        incident.parts.push_back(part);
    }
    if (incident.parts.empty()) {
        const Sender* from = session.find(sender);
        incident.firstStamp = incident.lastStamp = from != nullptr ? from->lastStamp : session.now();
    }
    incident.number = session.provisionalNumber(sender);
    return listed;
}

/// A type of it that ended has not come back.
bool isMissingStill(const SessionView& session, const Incident& incident) {
    return std::ranges::any_of(incident.parts, [&](const Incident::Part& part) {
        const Stream* stream = streamOf(session, incident.sender, part);
        return stream != nullptr && stream->hasEnded;
    });
}

/// What did not happen again for much longer than it took between the times it did, or for a second: more of
/// it would be of the same incident, but it does not go on. What comes at random pauses for so long once in
/// 150 times.
bool hasCeased(const SessionView& session, const Incident& incident) {
    constexpr log::Duration kLeast = std::chrono::seconds(1);
    constexpr int kPatience = 5;
    const auto repeats = static_cast<std::int64_t>(incident.times - 1);
    const log::Duration between =
        repeats == 0 ? log::Duration() : (incident.lastStamp - incident.firstStamp) / repeats;
    if (incident.kind == IncidentKind::Step && isMissingStill(session, incident)) {
        return false;
    }
    const bool isLoss = incident.kind == IncidentKind::Loss || incident.kind == IncidentKind::Local;
    const log::Stamp known = isLoss ? session.judgedUntil() : session.knownUntil();
    return !factsOf(incident.kind).lasts &&
           known - incident.lastStamp >= std::clamp(kPatience * between, kLeast, Incidents::kQuiet);
}

/// Incidents that are not listed any more.
ListedIncident forgottenOf(log::SenderId sender, LossCause cause, std::uint64_t samples) {
    ListedIncident listed;
    listed.state = State::Over;
    listed.incident.kind = cause == LossCause::ThisComputer ? IncidentKind::Local : IncidentKind::Loss;
    listed.incident.sender = sender;
    listed.incident.cause = cause;
    listed.incident.samples = samples;
    listed.incident.detail = "Of incidents that are not listed any more.";
    listed.incident.isCurrent = false;
    return listed;
}

/// Whether another sender has one of the same ID: its name does not say which of them is meant.
bool hasNamesake(const SessionView& session, const Incident& incident) {
    if (session.senders().size() < 2 || session.find(incident.sender) == nullptr) {
        return false;
    }
    const std::vector<std::uint8_t> own = incident.characters();
    return std::ranges::any_of(session.atNow().currentCharacters(), [&](const Character* one) {
        return one->key.sender != incident.sender &&
               std::ranges::find(own, one->key.character) != own.end() &&
               !session.isSame(one->key, {incident.sender, one->key.character});
    });
}

/// "Jonas", "Jonas and Mira", "4 characters", or the sender; with it where others send the same.
std::string whom(const SessionView& session, const Incident& incident) {
    const auto characters = incident.characters();
    if (characters.empty()) {
        return session.addressOf(incident.sender).shown();
    }
    std::vector<CharacterKey> keys;
    for (const std::uint8_t character : characters) {
        keys.push_back({incident.sender, character});
    }
    const bool isAmbiguous = incident.kind != IncidentKind::Conflict && hasNamesake(session, incident);
    return namesOrCount(session, keys) +
           (isAmbiguous ? " of " + session.addressOf(incident.sender).shown() : std::string());
}

/// A sentence as it goes on after a colon: "The null pose changed" as "the null pose changed".
std::string continued(std::string text) {
    const bool isWord = text.size() > 1 && text[1] >= 'a' && text[1] <= 'z';
    if (isWord && text[0] >= 'A' && text[0] <= 'Z') {
        text[0] = static_cast<char>(text[0] - 'A' + 'a');
    }
    return text;
}

/// Of all of it.
std::string amountOf(const SessionView& session, const Incident& incident, std::string_view noun) {
    StreamCounts sum;
    for (const Incident::Part& part : incident.parts) {
        const Stream* stream = streamOf(session, incident.sender, part);
        if (stream != nullptr) {
            sum += stream->accounting.countsBetween(incident.firstStamp,
                                                    incident.lastStamp + CountHistory::kFirstWidth);
        }
    }
    const bool isShort = incident.lastStamp - incident.firstStamp < kLeastOfShare;
    return lossAmount(incident.samples, isShort || incident.isOfMessages() ? 0 : sum.expected(), noun);
}

std::string causeOf(const Incident& incident) {
    return incident.cause && *incident.cause != LossCause::Unknown
               ? ", " + std::string(nameOf(*incident.cause))
               : ", cause unknown";
}

std::string lossHeadline(const SessionView& session, const Incident& incident, const std::string& lost) {
    return (lost.empty() ? amountOf(session, incident, incident.noun()) : lost) + ' ' +
           std::string(incident.fate()) + " on " + whom(session, incident) + causeOf(incident);
}

std::string conflictHeadline(const SessionView& session, const Incident& incident, const std::string& who,
                             bool isOfMany) {
    return who + (isOfMany ? " come" : " comes") + " from several senders at once, " +
           session.addressOf(incident.sender).shown() + " and also " + incident.detail;
}

/// Who else sends it: "port 40002" where that is on the same host.
std::string otherSender(const SessionView& session, const Incident& incident) {
    const std::string own = session.addressOf(incident.sender).shown();
    const std::string_view host = log::hostOf(own);
    const bool isSameHost = host.size() < own.size() && log::hostOf(incident.detail) == host;
    return isSameHost ? "port " + incident.detail.substr(host.size() + 1) : incident.detail;
}

/// Of an outage: "no data for 1.2 s"; of one at the end of a recording, wherever the cursor is in it,
/// "no data, last 1.2 s".
std::string silenceOf(const SessionView& session, const ListedIncident& listed) {
    const log::Stamp end = listed.state == State::Over
                               ? listed.incident.lastStamp
                               : std::max(session.knownUntil(), listed.incident.lastStamp);
    const double seconds = log::secondsOf(end - listed.incident.firstStamp);
    const bool isAtEnd = session.isRecording() && listed.state != State::Over;
    return (isAtEnd ? "no data, last " : "no data for ") + fixedText(seconds, seconds < 10 ? 1 : 0) + " s";
}

/// What no incident of the list tells.
std::vector<ListedIncident> unlistedOf(const SessionView& session) {
    std::vector<ListedIncident> all;
    for (const auto& [sender, untold] : untoldOf(session)) {
        for (std::size_t cause = 0; cause < kUnknownCause; ++cause) {
            if (untold.lost[cause] != 0) {
                all.push_back(forgottenOf(sender, static_cast<LossCause>(cause), untold.lost[cause]));
            }
        }
        if (untold.lost[kUnknownCause] != 0 || !untold.stalled.empty()) {
            all.push_back(provisionalOf(session, sender, untold));
        }
    }
    return all;
}

} // namespace

std::string namesOrCount(const SessionView& session, std::span<const CharacterKey> characters) {
    if (characters.size() > 2) {
        return counted(characters.size(), "character");
    }
    std::vector<std::string> names;
    for (const CharacterKey& key : characters) {
        names.push_back(session.displayName(key).shown());
    }
    return listed(names);
}

const Stream* streamOf(const SessionView& session, log::SenderId sender, const Incident::Part& part) {
    return part.character && part.type ? session.find(log::StreamKey{sender, *part.character, *part.type})
                                       : nullptr;
}

std::string_view nameOf(ListedIncident::State state) {
    constexpr std::array<std::string_view, 3> kNames{"provisional", "ongoing", "over"};
    return kNames[static_cast<std::size_t>(state)];
}

bool isNote(const Incident& incident) {
    return wordOf(incident.kind).empty();
}

ListedIncident::State stateOf(const SessionView& session, const Incident& incident) {
    return incident.isCurrent && !hasCeased(session, incident) ? State::Ongoing : State::Over;
}

std::vector<ListedIncident> unsettledIncidents(const SessionView& session) {
    std::vector<ListedIncident> all = unlistedOf(session);
    std::erase_if(all, isOnlyComing);
    return all;
}

/// Of a sample that is just coming the rest is under way.
bool isOnlyComing(const ListedIncident& one) {
    return one.state == State::Provisional && one.incident.parts.empty();
}

std::vector<ListedIncident> listedIncidents(const SessionView& session, log::Stamp from, log::Stamp to) {
    std::vector<ListedIncident> all = unlistedOf(session);
    for (const Incident& incident : session.incidents().all()) {
        const bool isMeant = (incident.isCurrent || incident.lastStamp >= from) &&
                             incident.firstStamp <= to && !isNote(incident);
        if (isMeant) {
            all.push_back({incident, stateOf(session, incident)});
        }
    }
    std::ranges::stable_sort(all, {}, [](const ListedIncident& one) { return one.incident.number; });
    return all;
}

std::string headlineOf(const SessionView& session, const ListedIncident& listed, const std::string& lost) {
    const Incident& incident = listed.incident;
    const std::string who = whom(session, incident);
    if (listed.state == State::Provisional) {
        return incident.samples != 0 ? counted(incident.samples, "sample") + " of " + who + " not yet here"
                                     : "no data of " + typesText(incident.types()) + " from " + who;
    }
    switch (incident.kind) {
    case IncidentKind::Loss:
        return lossHeadline(session, incident, lost);
    case IncidentKind::Local:
        return incident.samples != 0 ? lossHeadline(session, incident, lost)
                                     : "this computer dropped " +
                                           counted(static_cast<std::uint64_t>(incident.value), "datagram");
    case IncidentKind::Outage:
        return "no data from " + who + (incident.cause ? causeOf(incident) : std::string());
    case IncidentKind::Reordered:
        return counted(incident.count, "datagram") + " of " + who + " reordered";
    case IncidentKind::Duplicates:
        return counted(incident.count, "datagram") + " of " + who + " duplicated";
    case IncidentKind::Malformed:
        return counted(incident.count, "datagram") + " of " + who + " malformed";
    case IncidentKind::Foreign:
        return counted(incident.count, "datagram") + " from " + who + " not MXTP";
    case IncidentKind::Restart:
        return who + " restarted";
    case IncidentKind::Conflict:
        return conflictHeadline(session, incident, who, false);
    case IncidentKind::Overtaken:
    case IncidentKind::RelayLoop:
    case IncidentKind::RecordingEnded:
    case IncidentKind::ClockSet: {
        std::string text = incident.text();
        text.erase(text.find_last_not_of('.') + 1);
        return text;
    }
    default: {
        std::string text = incident.text();
        text.erase(text.find_last_not_of('.') + 1);
        return who + ": " + continued(std::move(text));
    }
    }
}

std::string headlineOf(const SessionView& session, std::span<const ListedIncident> together) {
    std::vector<ListedIncident> inOrder(together.begin(), together.end());
    std::ranges::sort(inOrder, {}, [](const ListedIncident& one) { return one.incident.number; });
    const Incident& first = inOrder.front().incident;
    std::vector<std::string> names;
    bool isOneCause = true;
    for (const ListedIncident& one : inOrder) {
        isOneCause = isOneCause && one.incident.cause == first.cause;
        for (const std::uint8_t character : one.incident.characters()) {
            const std::string name = session.displayName({one.incident.sender, character}).shown();
            if (std::ranges::find(names, name) == names.end()) {
                names.push_back(name);
            }
        }
        if (one.incident.characters().empty()) {
            names.push_back(session.addressOf(one.incident.sender).shown());
        }
    }
    const std::string who = names.size() > 2 ? counted(names.size(), "character") : listed(names);
    return first.kind == IncidentKind::Conflict
               ? conflictHeadline(session, first, who, names.size() > 1)
               : "no data from " + who + (isOneCause && first.cause ? causeOf(first) : std::string());
}

std::string causeOf(const ListedIncident& listed) {
    const Incident& incident = listed.incident;
    const bool isLoss = (incident.kind == IncidentKind::Loss || incident.kind == IncidentKind::Local) &&
                        incident.samples != 0;
    const bool isSilence = incident.kind == IncidentKind::Outage && incident.cause;
    return listed.state != State::Provisional && (isLoss || isSilence) ? causeOf(incident) : std::string();
}

std::string briefOf(const SessionView& session, const ListedIncident& listed) {
    const Incident& incident = listed.incident;
    const std::string count = grouped(incident.count);
    if (listed.state == State::Provisional) {
        return incident.samples != 0 ? grouped(incident.samples) + " not yet here"
                                     : "no data of " + typesText(incident.types());
    }
    switch (incident.kind) {
    case IncidentKind::Loss:
    case IncidentKind::Local:
        return incident.samples != 0 ? amountOf(session, incident, {}) + ' ' + std::string(incident.fate())
                                     : grouped(static_cast<std::uint64_t>(incident.value)) + " dropped here";
    case IncidentKind::Outage:
        return silenceOf(session, listed);
    case IncidentKind::Reordered:
        return count + " reordered";
    case IncidentKind::Duplicates:
        return count + " duplicated";
    case IncidentKind::Malformed:
        return count + " malformed";
    case IncidentKind::Foreign:
        return count + " not MXTP";
    case IncidentKind::Restart:
        return "restarted";
    case IncidentKind::Conflict:
        return "also from " + otherSender(session, incident);
    case IncidentKind::Step: // with a cause, that is not known, where it ended
        return incident.cause ? typesText(incident.types()) + " not sent"
                              : std::string(nameOf(incident.kind));
    default:
        return std::string(nameOf(incident.kind));
    }
}

std::string evidenceOf(const ListedIncident& listed) {
    if (listed.state != State::Provisional) {
        return listed.incident.text();
    }
    return listed.incident.samples != 0 ? "What is missing may still come."
                                        : "Other types of the same character go on.";
}

std::string whenOf(const SessionView& session, const ListedIncident& listed) {
    const std::string from = clockText(session.wallOf(listed.incident.firstStamp));
    if (listed.state != State::Over) {
        return session.isRecording() ? ", " + from + " to the end" : ", since " + from;
    }
    const std::string to = clockText(session.wallOf(listed.incident.lastStamp));
    return from == to ? ", at " + from : ", " + from + " to " + to;
}

} // namespace posewire::model
