// SPDX-License-Identifier: MIT
#include "core/model/session/listed_incidents.h"

#include "core/log/clock.h"
#include "core/log/ip_packet.h"
#include "core/log/recording.h"
#include "core/model/accounting/attribution.h"
#include "core/model/accounting/count_history.h"
#include "core/model/session/accounts.h"
#include "core/model/session/losses.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <map>
#include <utility>

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

struct Untold {
    std::uint64_t unknown = 0;           ///< samples
    std::vector<Incident::Part> stalled; ///< streams that are missing while others of their character go on
};

std::map<log::SenderId, Untold> untoldOf(const SessionView& session) {
    std::map<log::SenderId, Untold> rest;
    for (const Stream& stream : session.roster().streams()) {
        Untold& own = rest[stream.key.sender];
        own.unknown += stream.lostByCause()[kUnknownCause];
        if (stream.isStalled) {
            own.stalled.push_back({stream.key.sender, stream.key.character, stream.key.type, 0, 0,
                                   stream.accounting.lastStamp(), session.knownUntil()});
        }
    }
    const auto less = [&rest](log::SenderId sender, std::uint64_t samples) {
        if (const auto own = rest.find(sender); own != rest.end()) {
            own->second.unknown -= std::min(own->second.unknown, samples);
        }
    };
    for (const Incident& incident : session.verdicts().incidents().all()) {
        if (incident.cause.value_or(LossCause::Unknown) == LossCause::Unknown) {
            incident.forEachShare(
                [&](log::SenderId sender, std::uint64_t samples) { less(sender, samples); });
        }
    }
    session.accounts().attribution().forEachPending([&](const PendingLoss& loss) {
        if (loss.isUnderWay) {
            less(loss.stream.sender, loss.samples);
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
    incident.samples = untold.unknown;
    incident.firstStamp = log::Stamp::max();
    incident.version = session.verdicts().incidents().version();
    session.accounts().attribution().forEachPending([&](const PendingLoss& loss) {
        if (loss.stream.sender == sender && !loss.isUnderWay) {
            incident.firstStamp = std::min(incident.firstStamp, loss.from);
            incident.lastStamp = std::max(incident.lastStamp, loss.to);
            incident.parts.push_back({loss.stream.sender, loss.stream.character, loss.stream.type, 1,
                                      loss.samples, loss.from, loss.to});
            ++incident.count;
        }
    });
    for (const Incident::Part& part : untold.stalled) {
        incident.firstStamp = std::min(incident.firstStamp, part.from);
        incident.lastStamp = std::max(incident.lastStamp, part.to);
        incident.parts.push_back(part);
    }
    if (incident.parts.empty()) {
        const Sender* from = session.roster().find(sender);
        incident.firstStamp = incident.lastStamp = from != nullptr ? from->lastStamp : session.now();
    }
    incident.number = session.verdicts().provisionalNumber(sender);
    return listed;
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
    const auto isMissingStill = [&](const Incident::Part& part) {
        const Stream* stream = streamOf(session, part);
        return stream != nullptr && stream->hasEnded;
    };
    if (incident.kind == IncidentKind::Step && std::ranges::any_of(incident.parts, isMissingStill)) {
        return false;
    }
    const bool isLoss = incident.kind == IncidentKind::Loss || incident.kind == IncidentKind::Local;
    const log::Stamp known =
        session.knownUntil() - (isLoss ? session.accounts().attribution().patience() : log::Duration::zero());
    return !incident.lasts() &&
           known - incident.lastStamp >= std::clamp(kPatience * between, kLeast, Incidents::kQuiet);
}

/// Whether another sender has one of the same ID: its name does not say which of them is meant.
bool hasNamesake(const SessionView& session, const Incident& incident) {
    if (session.roster().senders().size() < 2 || session.roster().find(incident.sender) == nullptr) {
        return false;
    }
    const std::vector<CharacterKey> own = incident.characters();
    return std::ranges::any_of(session.roster().characters(), [&](const Character& one) {
        const CharacterKey namesake{incident.sender, one.key.character};
        return one.key.sender != incident.sender && std::ranges::find(own, namesake) != own.end() &&
               session.atNow().roster().findListed(one.key) != nullptr &&
               !session.roster().isSame(one.key, namesake);
    });
}

/// Its characters, or the sender; with it if others send the same characters.
words::Value whom(const SessionView& session, const Incident& incident) {
    const std::string address = session.roster().addressOf(incident.sender).shown();
    const std::vector<CharacterKey> keys = incident.characters();
    if (keys.empty()) {
        return address;
    }
    words::Value who = whoOf(session, keys);
    const bool isAmbiguous = incident.kind != IncidentKind::Conflict && hasNamesake(session, incident);
    return isAmbiguous ? words::Fact{words::Kind::OfSender, {{"who", std::move(who)}, {"address", address}}}
                       : who;
}

words::Fact amountOf(const SessionView& session, const Incident& incident) {
    StreamCounts sum;
    for (const Incident::Part& part : incident.parts) {
        const Stream* stream = streamOf(session, part);
        if (stream != nullptr && part.isSampled()) {
            sum += stream->accounting.countsBetween(incident.firstStamp,
                                                    incident.lastStamp + CountHistory::kFirstWidth);
        }
    }
    const bool isShort = incident.lastStamp - incident.firstStamp < kLeastOfShare;
    return lostFact(incident, incident.lost(), isShort ? 0 : sum.expected());
}

/// Who else sends it: "port 40002" of the same host.
words::Value otherSender(const std::string& own, const words::Value& others) {
    const auto& addresses = std::get<std::vector<std::string>>(others);
    const std::string_view host = log::hostOf(own);
    const bool isSameHost =
        addresses.size() == 1 && host.size() < own.size() && log::hostOf(addresses.front()) == host;
    return isSameHost ? words::Value(words::Fact{words::Kind::Port,
                                                 {{"port", addresses.front().substr(host.size() + 1)}}})
                      : others;
}

/// An incident may last until a recording or a range ends.
bool isAtEnd(const SessionView& session, const ListedIncident& listed) {
    return listed.state != State::Over && (session.isRecording() || listed.rangeEnd);
}

/// The end of an incident; of one that goes on, the time until which that is known.
log::Stamp endOf(const SessionView& session, const ListedIncident& listed) {
    const log::Stamp last = listed.incident.lastStamp;
    return listed.state == State::Over || listed.rangeEnd ? last : std::max(session.knownUntil(), last);
}

/// How long an outage has lasted: until the end of a recording, wherever the cursor is, or until now.
void addSilence(const SessionView& session, const ListedIncident& listed, words::Fact& fact) {
    const double seconds = log::secondsOf(endOf(session, listed) - listed.incident.firstStamp);
    set(fact, isAtEnd(session, listed) ? "left" : "silence", words::Number{seconds, seconds < 10 ? 1 : 0});
}

words::Fact provisionalFact(const SessionView& session, const Incident& incident) {
    words::Fact fact =
        incident.samples != 0
            ? words::Fact{words::Kind::NotYetHere,
                          {{"count", words::counted(words::Kind::Samples, incident.samples)}}}
            : words::Fact{words::Kind::TypesMissing, {{"missing", words::typesFact(incident.types())}}};
    set(fact, "who", whom(session, incident));
    return fact;
}

words::Value namesOrCount(std::vector<std::string> names) {
    constexpr std::size_t kMostNamed = 2;
    return names.size() > kMostNamed ? words::Value(words::counted(words::Kind::Characters, names.size()))
                                     : words::Value(std::move(names));
}

std::vector<ListedIncident> unlistedOf(const SessionView& session) {
    std::vector<ListedIncident> all;
    for (const auto& [sender, untold] : untoldOf(session)) {
        if (untold.unknown != 0 || !untold.stalled.empty()) {
            all.push_back(provisionalOf(session, sender, untold));
        }
    }
    return all;
}

} // namespace

words::Value whoOf(const SessionView& session, std::span<const CharacterKey> characters) {
    std::vector<std::string> names;
    for (const CharacterKey& key : characters) {
        names.push_back(session.roster().displayName(key).shown());
    }
    return namesOrCount(std::move(names));
}

const Stream* streamOf(const SessionView& session, const Incident::Part& part) {
    return part.character && part.type
               ? session.roster().find(log::StreamKey{part.sender, *part.character, *part.type})
               : nullptr;
}

std::string_view nameOf(ListedIncident::State state) {
    constexpr std::array<std::string_view, 3> kNames{"provisional", "ongoing", "over"};
    return kNames[static_cast<std::size_t>(state)];
}

bool isNote(const Incident& incident) {
    return factsOf(incident.kind).word.empty();
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
    for (const Incident& incident : session.verdicts().incidents().all()) {
        const bool isMeant = (incident.isCurrent || incident.lastStamp >= from) &&
                             incident.firstStamp <= to && !isNote(incident);
        if (isMeant) {
            all.push_back({incident, stateOf(session, incident)});
        }
    }
    std::ranges::stable_sort(all, {}, [](const ListedIncident& one) { return one.incident.number; });
    return all;
}

namespace {

/// Counts what a stream lost in a range as part of an incident, and keeps the evidence of the newest gap.
void takeLosses(const SessionView& session, const log::StreamKey& stream, const TimeRange& range,
                Incident& incident, Incident::Part& part) {
    const auto& gaps = session.accounts().attribution().gaps();
    if (gaps.size() >= Attribution::kMostGaps && gaps.front().toStamp >= range.from) {
        return; // some gaps of the range are forgotten
    }
    const LossCause cause = incident.cause.value_or(LossCause::Unknown);
    const auto take = [&](log::Stamp stamp, std::uint64_t samples) {
        const bool isMeant = stamp >= range.from && stamp < range.to;
        part.count += isMeant ? 1 : 0;
        part.samples += isMeant ? samples : 0;
        return isMeant;
    };
    part.count = part.samples = 0;
    for (const Gap& gap : gaps) {
        const Gap::Share& share = gap.of(cause);
        const Incident* its = gap.stream == stream && share.lost != 0
                                  ? session.verdicts().incidents().find(share.incident)
                                  : nullptr;
        if (its != nullptr && its->number == incident.number && take(gap.toStamp, share.lost)) {
            incident.detail = gap.evidenceFact(cause);
        }
    }
    session.accounts().attribution().forEachPartialLoss(
        [&](const log::StreamKey& key, log::Stamp stamp, LossCause whose, std::uint64_t /*packet*/) {
            if (key == stream && whose == cause && incident.kind == IncidentKind::Loss) {
                take(stamp, 1);
            }
        });
}

/// Counts how much of a part was in a range that it reaches beyond. A part that cannot be split stays whole.
void takeWithin(const SessionView& session, Incident& incident, Incident::Part& part,
                const TimeRange& range) {
    constexpr std::array<std::pair<IncidentKind, Figure>, 3> kCounted{
        {{IncidentKind::Reordered, Figure::Reordered},
         {IncidentKind::Duplicates, Figure::Duplicates},
         {IncidentKind::Malformed, Figure::Malformed}}};
    const auto counted = std::ranges::find(kCounted, incident.kind, &std::pair<IncidentKind, Figure>::first);
    const Stream* stream = streamOf(session, part);
    const log::Duration width =
        stream != nullptr ? stream->accounting.resolution(part.from) : log::Duration(1);
    const TimeRange its{std::max(range.from, roundedDown(part.from, width)),
                        std::min(range.to, part.to + log::Duration(1))};
    if (stream != nullptr && counted != kCounted.end()) {
        part.count = model::figuresOf(*stream, its).count(counted->second);
    } else if (stream != nullptr && part.samples != 0) {
        takeLosses(session, stream->key, its, incident, part);
    } else if (incident.kind == IncidentKind::Foreign || incident.kind == IncidentKind::Malformed) {
        const SenderTotals all = session.accounts().eachSender(its)[part.sender];
        part.count = incident.kind == IncidentKind::Foreign ? all.foreign : all.malformed;
        for (const Stream& own : session.roster().streams()) { // those of streams have parts of their own
            const bool isOfIt = own.key.sender == part.sender && incident.kind == IncidentKind::Malformed;
            part.count -= isOfIt ? std::min(part.count, own.accounting.malformed(its)) : 0;
        }
    }
}

} // namespace

std::optional<ListedIncident> withinRange(const SessionView& session, ListedIncident one,
                                          const TimeRange& range) {
    constexpr log::Duration kPause = std::chrono::seconds(1); // between two losses of one that goes on
    Incident& incident = one.incident;
    const bool isOngoing = one.state == State::Ongoing;
    const log::Stamp end = incident.lasts() ? endOf(session, one) : incident.lastStamp;
    std::erase_if(incident.parts, [&](const Incident::Part& part) {
        return part.from >= range.to || (part.to < range.from && !(isOngoing && incident.lasts()));
    });
    const bool isBeyond = incident.firstStamp < range.from || incident.lastStamp >= range.to;
    if (isBeyond && one.state != State::Provisional) {
        const bool isLoss = incident.samples != 0; // verdicts look at the samples lost in the range
        incident.count = incident.samples = 0;
        for (Incident::Part& part : incident.parts) {
            if (part.from < range.from || part.to >= range.to) {
                takeWithin(session, incident, part, range);
            }
            part.from = std::max(part.from, range.from);
            part.to = std::min(part.to, range.to);
            incident.count += part.count;
            incident.samples += part.samples;
        }
        if (incident.count == 0 && !isLoss) {
            return std::nullopt;
        }
    }
    const bool isSilence = incident.kind == IncidentKind::Outage;
    const log::Duration least = isSilence ? IncidentFollower::kSilent : log::Duration::zero();
    if (incident.firstStamp + least >= range.to || end < range.from + least) {
        return std::nullopt;
    }
    const bool goesOn = end >= range.to || (isOngoing && end + kPause >= range.to);
    one.state = one.state == State::Provisional ? one.state : goesOn ? State::Ongoing : State::Over;
    one.rangeEnd = range.to;
    incident.firstStamp = std::max(incident.firstStamp, range.from);
    incident.lastStamp = std::min(end, range.to);
    if (isSilence) {
        incident.value = std::min(incident.value, log::secondsOf(incident.lastStamp - incident.firstStamp));
    }
    return one;
}

std::vector<ForeignText> addressesOf(const SessionView& session, const Incident& incident) {
    std::vector<ForeignText> addresses;
    for (const CharacterKey& character : incident.characters()) {
        const ForeignText address = session.roster().addressOf(character.sender);
        if (addresses.empty() || addresses.back() != address) {
            addresses.push_back(address);
        }
    }
    return addresses.empty() ? std::vector{session.roster().addressOf(incident.sender)} : addresses;
}

words::Fact factOf(const log::Displaced& file) {
    words::Fact fact{words::Kind::RecordingMoved, {{"problem", file.problem}, {"file", file.path}}};
    if (file.lost > 0) {
        fact.values.push_back({"packets", counted(words::Kind::Packets, file.lost)});
    }
    return fact;
}

words::Fact factOf(const SessionView& session, const ListedIncident& listed) {
    const Incident& incident = listed.incident;
    if (listed.state == State::Provisional) {
        return provisionalFact(session, incident);
    }
    words::Fact fact = incident.fact();
    const std::string address = addressesOf(session, incident).front().shown();
    set(fact, "who", whom(session, incident));
    set(fact, "address", address);
    const Sender* sender = session.roster().find(incident.sender);
    if (incident.cause == LossCause::ThisComputer && sender != nullptr && !sender->info.probe.empty()) {
        set(fact, "cause", words::Fact{words::Kind::CauseProbe, {{"probe", sender->info.probe}}});
    }
    if (incident.kind == IncidentKind::Foreign && sender != nullptr) {
        set(fact, "looks", sender->foreignFormat());
    }
    if (incident.kind == IncidentKind::Outage) {
        addSilence(session, listed, fact);
    } else if (incident.samples != 0) {
        set(fact, "amount", amountOf(session, incident));
    }
    if (const words::Value* others = find(incident.detail, "others")) {
        set(fact, "other", otherSender(address, *others));
    }
    return fact;
}

words::Fact factOf(const SessionView& session, std::span<const ListedIncident> together) {
    std::vector<ListedIncident> inOrder(together.begin(), together.end());
    std::ranges::sort(inOrder, {}, [](const ListedIncident& one) { return one.incident.number; });
    const ListedIncident& first = inOrder.front();
    std::vector<std::string> names;
    bool isOneCause = true;
    for (const ListedIncident& one : inOrder) {
        isOneCause = isOneCause && one.incident.cause == first.incident.cause;
        for (const CharacterKey& character : one.incident.characters()) {
            const std::string name = session.roster().displayName(character).shown();
            if (std::ranges::find(names, name) == names.end()) {
                names.push_back(name);
            }
        }
        if (one.incident.characters().empty()) {
            names.push_back(session.roster().addressOf(one.incident.sender).shown());
        }
    }
    words::Fact fact = factOf(session, first);
    set(fact, "who", namesOrCount(std::move(names)));
    if (!isOneCause) {
        set(fact, "cause", words::Fact{});
    }
    return fact;
}

words::Fact whenOf(const SessionView& session, const ListedIncident& listed) {
    using K = words::Kind;
    const std::string from = clockText(session.wallOf(listed.incident.firstStamp));
    if (listed.state != State::Over) {
        return {isAtEnd(session, listed) ? K::ToTheEnd : K::Since, {{"from", from}}};
    }
    const std::string to = clockText(session.wallOf(listed.incident.lastStamp));
    return from == to ? words::Fact{K::At, {{"from", from}}}
                      : words::Fact{K::FromTo, {{"from", from}, {"to", to}}};
}

} // namespace posewire::model
