// SPDX-License-Identifier: MIT
#include "core/model/session/verdict.h"

#include "core/model/body/character_pose.h"
#include "core/model/body/pose_remark.h"
#include "core/model/session/accounts.h"
#include "core/model/session/ingest.h"
#include "core/model/session/messages.h"
#include "core/model/session/recent_losses.h"
#include "core/wire/messages.h"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <tuple>

namespace posewire::model {
namespace {

using State = ListedIncident::State;

/// Of errors that go on: whoever sends nothing or what is of no use, or is sent twice, is worse off than one
/// who loses some.
int gravityOf(const Incident& incident) {
    const bool isUnusable = incident.kind == IncidentKind::Conflict ||
                            incident.kind == IncidentKind::Content ||
                            incident.kind == IncidentKind::Fragments;
    return incident.kind == IncidentKind::Outage ? 2 : isUnusable ? 1 : 0;
}

bool isBad(const ListedIncident& listed) {
    return listed.state == State::Ongoing && listed.incident.severity() == IncidentSeverity::Error;
}

/// By how bad it is: what goes on before what is over; in a range, which is all over, what took most.
auto rankOf(const ListedIncident& listed, bool isInRange) {
    const Incident& incident = listed.incident;
    const auto size = std::bit_width(incident.samples); // so that two alike do not take turns
    const bool isKnown = incident.cause && incident.cause != LossCause::Unknown;
    return std::tuple(listed.state != State::Over || isInRange, listed.state == State::Ongoing && !isInRange,
                      incident.severity(), isInRange ? size : 0, isBad(listed) ? gravityOf(incident) : 0,
                      incident.group() != IncidentGroup::Limit, size, isKnown, incident.number);
}

/// Which character a verdict is on: itself and all that it took over from; none for all together.
using Line = std::vector<CharacterKey>;

bool concerns(const Incident& incident, const CharacterKey& character) {
    if (incident.parts.empty()) {
        return incident.sender == character.sender;
    }
    return std::ranges::any_of(incident.parts, [&](const Incident::Part& part) {
        return part.sender == character.sender && part.whose().value_or(character) == character;
    });
}

bool concerns(const Incident& incident, const Line& line) {
    return line.empty() ||
           std::ranges::any_of(line, [&](const CharacterKey& one) { return concerns(incident, one); });
}

/// `together`: the worst one, and those beside it that are reported with it.
TakeVerdict fromIncidents(const SessionView& session, const std::vector<ListedIncident>& together,
                          bool isNotGood, RecentLosses& losses) {
    using K = words::Kind;
    const ListedIncident& worst = together.front();
    const bool isPast = worst.state == State::Over;
    words::Fact reason = together.size() > 1 ? factOf(session, together) : factOf(session, worst);
    if (auto recent = losses.amountOf(worst)) {
        set(reason, "amount", *std::move(recent));
    }
    TakeVerdict verdict;
    verdict.state = isNotGood ? TakeVerdict::State::Bad : TakeVerdict::State::Warning;
    verdict.isOver = isPast && !isNotGood;
    verdict.said = {isNotGood ? K::NotGood : K::NotQuiteGood,
                    {{"reason", std::move(reason)}, {"when", whenOf(session, worst)}}};
    if (isPast ? !isNotGood : !(session.isRecording() || worst.rangeEnd)) {
        set(verdict.said, "lasts", words::Fact{verdict.isOver ? K::Over : K::GoingOn});
    }
    verdict.since = worst.incident.firstStamp;
    verdict.incident = worst.incident.number;
    if (const auto character = worst.incident.character(); character && together.size() == 1) {
        verdict.character = *character;
    }
    return verdict;
}

TakeVerdict lasting(TakeVerdict::State state, words::Fact said, log::Stamp since) {
    return {.state = state, .said = std::move(said), .since = since};
}

TakeVerdict notQuiteGood(words::Fact reason, log::Stamp since) {
    return lasting(TakeVerdict::State::Warning, {words::Kind::NotQuiteGood, {{"reason", std::move(reason)}}},
                   since);
}

/// A stream that ended while others of its character go on is not on the air.
std::vector<const Stream*> streamsOnAir(const Character& character) {
    std::vector<const Stream*> onAir = character.streams;
    std::erase_if(onAir, [](const Stream* stream) { return stream->hasEnded; });
    return onAir;
}

/// What speaks against the body that is drawn of a character; nothing if all of it was sent.
words::Fact doubtOf(const SessionView& session, const Character& character) {
    const std::vector<const Stream*> onAir = streamsOnAir(character);
    const bool isPosed =
        std::ranges::any_of(onAir, [](const Stream* one) { return hasPoses(one->key.type); });
    const std::optional<PoseRemark> remark =
        isPosed && session.messages().pose(character.key) != nullptr // else it is that of long ago
            ? std::optional(session.messages().poseRemark(character.key))
            : std::nullopt;
    if (remark) {
        return remark->isAssumed ? words::Fact{words::Kind::PoseDoubt,
                                               {{"doubt", remark->reason}, {"brief", remark->brief}}}
                                 : words::Fact();
    }
    std::vector<std::uint8_t> types;
    for (const Stream* stream : onAir) {
        types.push_back(stream->key.type);
    }
    std::ranges::sort(types);
    words::Fact doubt{words::Kind::NoPose};
    if (!types.empty()) {
        set(doubt, "types", words::typesFact(types));
    }
    return doubt;
}

/// The datagrams of its first sample may still be on their way.
bool isNew(const SessionView& session, const Character& character) {
    constexpr log::Duration kNew = std::chrono::milliseconds(250);
    return !session.isRecording() && std::ranges::all_of(character.streams, [&](const Stream* stream) {
        return session.now() - stream->accounting.firstStamp() < kNew;
    });
}

TakeVerdict onPoses(const SessionView& session, words::Fact doubt,
                    const std::vector<CharacterKey>& characters, log::Stamp since) {
    set(doubt, "who", whoOf(session, characters));
    TakeVerdict verdict = notQuiteGood(std::move(doubt), since);
    if (characters.size() == 1) {
        verdict.character = characters.front();
    }
    return verdict;
}

/// Nothing if this computer keeps up: else it is not known how it is now.
std::optional<TakeVerdict> ifBehind(const SessionView& session) {
    constexpr log::Duration kLong = std::chrono::seconds(1);
    const log::Duration behind = session.behind();
    if (behind < kLong) {
        return std::nullopt;
    }
    const auto seconds = static_cast<std::uint64_t>(behind / std::chrono::seconds(1));
    return notQuiteGood({words::Kind::Behind, {{"seconds", seconds}}}, session.now() - behind);
}

TakeVerdict withoutIncident(const SessionView& session, const VerdictSpan& span,
                            const std::optional<CharacterKey>& only, log::Stamp since) {
    std::vector<const Character*> characters;
    if (!only) {
        characters = session.roster().listed();
    } else if (const Character* one = session.roster().findListed(*only)) {
        characters.push_back(one);
    }
    if (span.isClosed()) {
        std::erase_if(characters, [&](const Character* one) {
            return session.accounts().countsOf(one->key, {span.from, span.to}).datagrams == 0;
        });
    }
    if (characters.empty()) {
        return {};
    }
    words::Fact first;
    std::vector<CharacterKey> doubtful;
    std::size_t starting = 0;
    for (const Character* one : characters) {
        words::Fact doubt = doubtOf(session, *one);
        if (doubt.kind == words::Kind::NoPose && isNew(session, *one)) {
            ++starting;
            continue;
        }
        first = first.isNothing() ? doubt : first;
        if (!doubt.isNothing() && doubt == first) {
            doubtful.push_back(one->key);
        }
    }
    if (!first.isNothing()) {
        return onPoses(session, std::move(first), doubtful, since);
    }
    if (auto late = ifBehind(session); late && !span.isClosed()) {
        return *std::move(late);
    }
    if (session.isBeingRead()) {
        return lasting(TakeVerdict::State::None, {words::Kind::NoFaultSoFar}, since);
    }
    if (starting == characters.size()) {
        return lasting(TakeVerdict::State::None, {words::Kind::NoPoseYet}, since);
    }
    words::Value who = only ? words::Value(session.roster().displayName(*only).shown())
                            : words::counted(words::Kind::Characters, characters.size() - starting);
    return lasting(TakeVerdict::State::Good, {words::Kind::Good, {{"who", std::move(who)}}}, since);
}

bool isPast(const ListedIncident& one, const VerdictSpan& span) {
    return isOnlyComing(one) || (one.state == State::Over && one.incident.lastStamp < span.from);
}

/// How bad it is in the span: loss that was above its limit, or of many at once, need not be any more.
void easeTo(const VerdictSpan& span, RecentLosses& losses, Incident& incident) {
    if (incident.kind != IncidentKind::Loss) {
        return;
    }
    losses.judge(incident);
    for (Incident::Part& part : incident.parts) {
        const bool isMeant = part.lastMany && *part.lastMany >= span.from && *part.lastMany <= span.to;
        part.lastMany = isMeant ? part.lastMany : std::nullopt;
    }
}

/// What of it is to one character: that may be over while others still have it. The last that lost something
/// does so for as long as anybody.
ListedIncident ofOne(const SessionView& session, const ListedIncident& one,
                     std::span<const CharacterKey> which) {
    ListedIncident own{one.incident.of(which), one.state, one.rangeEnd};
    const bool isOfTheLast =
        one.incident.kind == IncidentKind::Loss && own.incident.lastStamp == one.incident.lastStamp;
    if (one.state == State::Ongoing && !isOfTheLast && !one.rangeEnd) {
        own.state = stateOf(session, own.incident);
    }
    return own;
}

/// A loss that goes on is on those for whom it does: who had it too, and has it no more, is not named.
ListedIncident ofLasting(const SessionView& session, const ListedIncident& one) {
    if (one.incident.kind != IncidentKind::Loss || one.state != State::Ongoing) {
        return one;
    }
    std::vector<CharacterKey> lasting = one.incident.characters();
    std::erase_if(lasting, [&](const CharacterKey& character) {
        return ofOne(session, one, std::span(&character, 1)).state != State::Ongoing;
    });
    return lasting.empty() ? one : ListedIncident{one.incident.of(lasting), one.state, one.rangeEnd};
}

/// With what comes right now; nothing if it is of all there is.
std::optional<TimeRange> rangeOf(const SessionView& session, const VerdictSpan& span) {
    const bool isAll = span.from == log::Stamp::min() && !span.isClosed();
    return isAll ? std::nullopt
                 : std::optional(TimeRange{span.from, std::min(span.to, session.now() + log::Duration(1))});
}

/// Lists once what several verdicts are about.
class Judge {
public:
    Judge(const SessionView& session, const VerdictSpan& span)
        : m_session(session),
          m_span(span),
          m_losses(session, rangeOf(session, span)),
          m_listed(listedIncidents(session, span.from, span.to)) {
        if (span.isClosed()) {
            keepWithin({span.from, span.to});
        }
        std::erase_if(m_listed, [&](const ListedIncident& one) { return isPast(one, span); });
        for (const Incident& incident : session.verdicts().incidents().all()) {
            if (incident.firstStamp <= span.to && !isNote(incident)) {
                m_past.push_back(&incident);
            }
        }
        // So that the end of the last is found at once.
        std::ranges::stable_sort(m_past, std::ranges::greater(), &Incident::lastStamp);
    }

    [[nodiscard]] TakeVerdict of(const std::optional<CharacterKey>& character) const {
        Line line;
        if (character) {
            for (const Character* one : m_session.roster().lineage(*character)) {
                line.push_back(one->key);
            }
            line = line.empty() ? Line{*character} : line;
        }
        std::optional<ListedIncident> worst;
        bool isAnyBad = false;
        const bool isInRange = m_span.isClosed() || m_session.isRecording();
        for (const ListedIncident& one : m_listed) {
            if (!concerns(one.incident, line)) {
                continue;
            }
            ListedIncident mine = character ? ofOne(m_session, one, line) : ofLasting(m_session, one);
            easeTo(m_span, m_losses, mine.incident);
            if (character && isPast(mine, m_span)) {
                continue;
            }
            isAnyBad = isAnyBad || isBad(mine);
            if (!worst || rankOf(*worst, isInRange) < rankOf(mine, isInRange)) {
                worst = std::move(mine);
            }
        }
        if (worst) {
            worst->incident = m_losses.shownOf(character ? worst->incident : graveOf(*worst));
        }
        return worst ? fromIncidents(m_session, besides(*worst, character.has_value()), isAnyBad, m_losses)
                     : withoutIncident(m_session, m_span, character, endOfTheLast(line));
    }

private:
    void keepWithin(const TimeRange& range) {
        std::vector<ListedIncident> all;
        for (ListedIncident& listed : m_listed) {
            auto one = withinRange(m_session, std::move(listed), range);
            const bool isElsewhere = one && one->incident.kind == IncidentKind::Loss &&
                                     one->state != State::Provisional &&
                                     m_losses.shareOf(one->incident).lost == 0;
            if (one && !isElsewhere) {
                all.push_back(*std::move(one));
            }
        }
        m_listed = std::move(all);
    }

    /// What of a loss makes it grave: who loses little beside those, less than half as much as the worst or
    /// as the limit, is not named with them, nor does what they lose seem less.
    [[nodiscard]] Incident graveOf(const ListedIncident& listed) const {
        const Incident& all = listed.incident;
        if (all.kind != IncidentKind::Loss || listed.state != State::Ongoing ||
            all.severity() != IncidentSeverity::Error) {
            return all;
        }
        constexpr double kLittle = 0.5;
        constexpr double kChance = 2;
        const std::vector<CharacterKey> characters = all.characters();
        double worst = all.limit / 100;
        for (const CharacterKey& character : characters) {
            worst = std::max(worst, m_losses.shareOf(all.of(character)).ratio());
        }
        std::vector<CharacterKey> grave;
        for (const CharacterKey& character : characters) {
            Incident own = all.of(character);
            easeTo(m_span, m_losses, own);
            if (own.severity() == IncidentSeverity::Error ||
                m_losses.shareOf(own).ratio(kChance) > kLittle * worst) {
                grave.push_back(character);
            }
        }
        return grave.empty() ? all : all.of(grave);
    }

    /// With those of others beside an outage, a conflict or what is of no use, that go on as it does, or were
    /// at the same time: who is silent, or sent twice, is named whole, since the first was and until the
    /// last.
    [[nodiscard]] std::vector<ListedIncident> besides(const ListedIncident& worst, bool isOfOne) const {
        std::vector<ListedIncident> together{worst};
        const Incident& own = worst.incident;
        if (isOfOne || (own.kind != IncidentKind::Outage && own.kind != IncidentKind::Conflict &&
                        own.kind != IncidentKind::Content)) {
            return together;
        }
        for (const ListedIncident& one : m_listed) {
            const Incident& other = one.incident;
            const bool isBeside = worst.state == State::Ongoing ||
                                  (other.firstStamp <= own.lastStamp && other.lastStamp >= own.firstStamp);
            if (other.kind == own.kind && other.what == own.what && one.state == worst.state &&
                other.number != own.number && isBeside) {
                together.push_back(one);
                Incident& all = together.front().incident;
                all.firstStamp = std::min(all.firstStamp, other.firstStamp);
                all.lastStamp = std::max(all.lastStamp, other.lastStamp);
            }
        }
        return together;
    }

    /// When the last incident before the span was over; when the session began, where there was none.
    [[nodiscard]] log::Stamp endOfTheLast(const Line& line) const {
        const auto last =
            std::ranges::find_if(m_past, [&](const Incident* incident) { return concerns(*incident, line); });
        const log::Stamp first =
            std::max(m_session.firstStamp(), m_span.isClosed() ? m_span.from : log::Stamp());
        return last == m_past.end() ? first : std::max(first, (*last)->lastStamp);
    }

    const SessionView& m_session;
    VerdictSpan m_span;
    mutable RecentLosses m_losses;
    std::vector<ListedIncident> m_listed;
    std::vector<const Incident*> m_past; ///< that ended last first
};

} // namespace

bool sayTheSame(const TakeVerdict& one, const TakeVerdict& other) {
    const auto gist = [](const TakeVerdict& verdict) {
        return std::tie(verdict.state, verdict.isOver, verdict.incident, verdict.character);
    };
    return gist(one) == gist(other);
}

std::string_view nameOf(TakeVerdict::State state) {
    constexpr std::array<std::string_view, 4> kNames{"none", "good", "warning", "bad"};
    return kNames[static_cast<std::size_t>(state)];
}

VerdictSpan recentSpan(const SessionView& session) {
    return {std::max(session.choices().reset, session.now() - VerdictSpan::kRecent), log::Stamp::max()};
}

VerdictSpan spanOf(const SessionView& session, const std::optional<TimeRange>& range) {
    const log::Stamp end = session.knownUntil() + log::Duration(1);
    return range ? VerdictSpan{range->from, std::min(range->to, end)} : VerdictSpan{};
}

TakeVerdict verdictOf(const SessionView& session, const VerdictSpan& span,
                      std::optional<CharacterKey> character) {
    return Judge(session.atNow(), span).of(character);
}

TakeVerdicts verdictsOf(const SessionView& session, const VerdictSpan& span,
                        const std::vector<const Character*>& characters) {
    const Judge judge(session.atNow(), span);
    TakeVerdicts verdicts{judge.of({}), {}};
    for (const Character* character : characters) {
        verdicts.characters[character->key] = judge.of(character->key);
    }
    return verdicts;
}

/// One for the verdicts of a session at all moments.
struct Verdicts::Judged {
    struct Basis {
        std::uint64_t end = 0;
        log::Stamp now{};
        std::uint64_t incidents = 0;
        log::Stamp reset{};
        std::uint64_t retired = 0;
        bool isRecording = false;
        bool isBeingRead = false;
        friend bool operator==(const Basis&, const Basis&) = default;
    };
    std::optional<Basis> basis;
    TakeVerdicts verdicts;
    bool isKept = false; ///< whatever changes
};

Verdicts::Verdicts(const SessionView& session, const Moment& moment)
    : m_session(session), m_moment(moment), m_judged(std::make_shared<Judged>()) {}

Verdicts::Verdicts(const SessionView& session, const Moment& moment, const Verdicts& same)
    : m_session(session), m_moment(moment), m_judged(same.m_judged) {}

const Incidents& Verdicts::incidents() const {
    return m_moment.ingest().incidents().incidents();
}

const Thresholds& Verdicts::thresholds() const {
    return m_moment.ingest().incidents().thresholds();
}

std::vector<const Incident*> Verdicts::troublesOf(const CharacterKey& key) const {
    return m_moment.ingest().incidents().troublesOf(key, m_moment.pausedStamp());
}

std::uint64_t Verdicts::provisionalNumber(log::SenderId sender) const {
    return m_moment.ingest().incidents().reserve(sender);
}

VerdictSpan Verdicts::span() const {
    return m_session.isRecording() ? VerdictSpan{} : recentSpan(m_session);
}

void Verdicts::keep() const {
    m_judged->isKept = false;
    static_cast<void>(all());
    m_judged->isKept = true;
}

const TakeVerdicts& Verdicts::all() const {
    const Judged::Basis basis{
        m_session.end(),
        m_session.knownUntil(), // of a recording it is at rest
        incidents().version(),   m_moment.choices().reset, m_session.accounts().retired().senders,
        m_session.isRecording(), m_session.isBeingRead()};
    if (!m_judged->isKept && m_judged->basis != basis) {
        m_judged->verdicts = verdictsOf(m_session, span(), m_session.atNow().roster().listed());
        m_judged->basis = basis;
    }
    return m_judged->verdicts;
}

const TakeVerdict& Verdicts::of(const CharacterKey& key) const {
    static const TakeVerdict none;
    const auto& characters = all().characters;
    const auto found = characters.find(Roster(m_moment.now()).current(key));
    return found == characters.end() ? none : found->second;
}

} // namespace posewire::model
