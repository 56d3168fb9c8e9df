// SPDX-License-Identifier: MIT
#include "core/model/incidents/changes.h"

#include "core/log/ip_packet.h"
#include "core/model/accounting/sender_clock.h"

#include <algorithm>
#include <cstdlib>
#include <functional>

namespace posewire::model {
Occurrence occurrenceOf(IncidentKind kind, const log::StreamKey& stream, const Verdict& verdict) {
    Occurrence one = Occurrence::at(kind, stream.sender, verdict.stamp, verdict.packet);
    one.character = stream.character;
    return one;
}

namespace {

constexpr std::int64_t kJumpMs = 500;
/// A time code that is back where it belongs sooner did not jump: one datagram was corrupt, or some were held
/// up together on their way.
constexpr log::Duration kJumped = std::chrono::milliseconds(200);
/// A time code is frozen if it has not changed for three times as long as it ever took, at least and at most;
/// at most until it has changed this often.
constexpr log::Duration kStill = std::chrono::milliseconds(200);
constexpr log::Duration kMostStill = std::chrono::seconds(2);
constexpr std::uint32_t kKnown = 10;

std::int64_t millisecondsOf(log::Duration time) {
    return time / std::chrono::milliseconds(1);
}

/// Whether two times are about the same, as a pause is measured.
bool isAbout(std::int64_t ms, std::int64_t otherMs) {
    return std::abs(ms - otherMs) <= std::max<std::int64_t>(50, std::abs(otherMs) / 10);
}

Occurrence timeCodeOf(const log::StreamKey& stream, const Verdict& verdict) {
    return occurrenceOf(IncidentKind::TimeCode, stream, verdict);
}

/// The counter went on where it stopped, as did the time code or the clock: no sample was made meanwhile.
void reportPause(std::uint64_t outage, const log::StreamKey& stream, const Verdict& verdict,
                 Incidents& incidents) {
    const Incident* incident = incidents.find(outage);
    if (incident == nullptr || incident->cause) {
        return;
    }
    Occurrence one =
        Occurrence::at(IncidentKind::Outage, incident->sender, incident->lastStamp, verdict.packet);
    one.character = stream.character;
    one.count = 0;
    one.isOver = true;
    one.detail = {words::Kind::SenderPaused};
    incidents.addTo(outage, one);
    incidents.setCause(outage, LossCause::Sender);
}

/// Senders that take turns within this time send at once.
constexpr log::Duration kTurns = std::chrono::seconds(1);
/// Metadata comes once a second: who has no name by then has none.
constexpr log::Duration kNamed = std::chrono::milliseconds(1'500);
/// So many senders of one character are told apart.
constexpr std::size_t kMostClaims = 8;

} // namespace

void ClockSets::follow(const log::Timeline& timeline) {
    for (const std::size_t count = timeline.stepCount(); m_steps < count; ++m_steps) {
        const log::ClockStep step = timeline.step(m_steps);
        if (step.change != log::Duration::zero()) {
            m_pending.push_back(step);
        }
    }
}

void ClockSets::report(log::Stamp until, std::uint64_t packet, Incidents& incidents) {
    std::erase_if(m_pending, [&](const log::ClockStep& step) {
        if (step.from > until) {
            return false;
        }
        Occurrence one = Occurrence::at(IncidentKind::ClockSet, log::kNoSender, step.from, packet);
        one.value = log::secondsOf(step.change);
        incidents.end(incidents.report(one), step.from); // two are two, however soon
        return true;
    });
}

std::optional<Occurrence> stepChange(Stream& stream, const Verdict& verdict) {
    constexpr std::uint64_t kSettled = 128;
    const std::uint32_t step = stream.accounting.step();
    const std::uint64_t datagrams = stream.accounting.datagrams();
    const bool wasKnown = datagrams - stream.toldStepSince >= kSettled;
    Occurrence one = occurrenceOf(IncidentKind::Step, stream.key, verdict);
    one.type = stream.key.type;
    if (step == 0) {
        if (stream.toldStep == 0 || stream.isUneven) {
            return std::nullopt;
        }
        one.detail = {words::Kind::StepIrregular, {{"before", std::uint64_t{stream.toldStep}}}};
        stream.isUneven = wasKnown; // until it has another one
        stream.toldStep = wasKnown ? stream.toldStep : 0;
        return wasKnown ? std::optional(one) : std::nullopt;
    }
    if (std::exchange(stream.isUneven, false)) {
        stream.toldStepSince = datagrams;
    }
    if (step == stream.toldStep) {
        return std::nullopt;
    }
    const std::uint32_t before = std::exchange(stream.toldStep, step);
    stream.toldStepSince = datagrams;
    if (before == 0 || !wasKnown) {
        return std::nullopt;
    }
    one.detail = {words::Kind::StepChanged,
                  {{"step", std::uint64_t{step}}, {"before", std::uint64_t{before}}}};
    return one;
}

void TimeCodes::take(const Stream& stream, const Verdict& verdict, const Silence& silence,
                     Incidents& incidents) {
    const bool isFirst = m_stamp == log::Stamp();
    const auto moved = static_cast<std::int32_t>(verdict.sample - m_sample);
    const bool isBeginning = isFirst || verdict.isRestart || moved < -Probation::kMostBack;
    if (!verdict.isFirstOfSample || verdict.isReordered || verdict.isStray || (moved <= 0 && !isBeginning)) {
        return;
    }
    if (isBeginning) {
        *this = {};
    } else if (verdict.timeCode == m_code) {
        noteFrozen(stream.key, verdict, incidents);
    } else if (!noteChange(stream, verdict, silence, incidents)) {
        return; // it is measured against what was before
    }
    m_sample = verdict.sample;
    m_code = verdict.timeCode;
    m_stamp = verdict.stamp;
}

void TimeCodes::noteFrozen(const log::StreamKey& stream, const Verdict& verdict, Incidents& incidents) {
    const log::Duration patience =
        m_changes < kKnown ? kMostStill : std::clamp(3 * m_longest, kStill, kMostStill);
    if (m_moved == log::Stamp() || verdict.stamp - m_moved < patience) {
        return;
    }
    Occurrence one = timeCodeOf(stream, verdict);
    one.from = m_moved;
    one.count = std::exchange(m_isFrozen, true) ? 0 : 1;
    one.detail = {words::Kind::TimeCodeFrozen};
    incidents.report(one);
}

/// False while it may be a jump, or none.
bool TimeCodes::noteChange(const Stream& stream, const Verdict& verdict, const Silence& silence,
                           Incidents& incidents) {
    const log::Duration stood = verdict.stamp - m_moved;
    const auto samples = static_cast<std::int32_t>(verdict.sample - m_sample);
    const log::Duration passed = verdict.stamp - m_stamp;
    const std::int64_t passedMs = millisecondsOf(passed);
    const std::int64_t jumpMs = timeCodeStep(m_code, verdict.timeCode) - passedMs;
    // It may go on from where it stood, or have gone on unseen; some move once a second.
    const bool isExplained = jumpMs > -kJumpMs && jumpMs < millisecondsOf(stood - passed) + kJumpMs;
    const bool isJump = samples < Probation::kMostForward && std::abs(jumpMs) > kJumpMs &&
                        m_moved != log::Stamp() && !isExplained;
    const bool endsSilence = silence.incident != 0 && silence.to == verdict.stamp &&
                             passed >= silence.to - silence.from &&
                             static_cast<std::uint32_t>(samples) <= stream.accounting.step();
    if (isJump) {
        Occurrence one = timeCodeOf(stream.key, verdict);
        one.value = static_cast<double>(jumpMs);
        one.detail = {words::Kind::TimeCodeJumped, {{"value", words::Number{one.value}}}};
        if (!m_jump) {
            m_isPause = endsSilence && isAbout(-jumpMs, passedMs);
            m_jump = one;
        }
        if (verdict.stamp - m_jump->from < kJumped) {
            return false;
        }
        m_isPause ? reportPause(silence.incident, stream.key, verdict, incidents)
                  : static_cast<void>(incidents.report(*m_jump));
    } else if (endsSilence && isAbout(jumpMs, 0)) {
        reportPause(silence.incident, stream.key, verdict, incidents);
    }
    if (std::exchange(m_isFrozen, false)) {
        Occurrence one = timeCodeOf(stream.key, verdict);
        one.count = 0;
        one.detail = {words::Kind::TimeCodeWasFrozen, {{"lasted", words::Number{log::secondsOf(stood), 1}}}};
        incidents.report(one);
    } else if (m_moved != log::Stamp() && !isJump && passed < kStill) {
        m_longest = std::max(m_longest, stood);
    }
    ++m_changes;
    m_jump.reset();
    m_moved = verdict.stamp;
    return true;
}

bool Claims::meet(log::SenderId sender, const log::SenderInfo& info) {
    const auto [place, isNew] = m_sources.try_emplace(sender);
    if (isNew) {
        const std::hash<std::string> number;
        place->second = {info.place(), number(info.probe + '/' + std::string(log::hostOf(info.address))),
                         number(info.probe)};
    }
    return isNew;
}

void Claims::take(const log::Packet& packet, const wire::Header& header, std::string_view name,
                  Incidents& incidents) {
    constexpr std::size_t kTelling = StreamAccounting::kTelling;
    const Source& source = m_sources[packet.sender];
    const Claim claim{
        packet.sender,
        source.host,
        source.probe,
        packet.stamp,
        packet.stamp,
        name.empty() ? 0 : std::hash<std::string_view>{}(name),
        m_sources.size() < 2 ? 0 : wire::hashOf(packet.bytes.first(std::min(packet.bytes.size(), kTelling)))};
    // One host may send types from several ports.
    std::vector<Claim>& ofType = m_claims[{header.character, header.type()}];
    std::vector<Claim>& ofHosts = m_claimsOfHosts[header.character];
    const std::span<const Claim> turn = turnOf(ofType, claim, &Claim::sender);
    const std::span<const Claim> turnOfHost = turnOf(ofHosts, claim, &Claim::host);
    const std::span<const Claim> claims = turn.size() > 1 ? turn : turnOfHost;
    if (claims.size() > 1 &&
        std::ranges::none_of(claims, [&](const Claim& other) { return areOthers(claims.back(), other); })) {
        report(claims, packet, header.character, incidents);
    }
}

/// Whether two hosts have performers of their own, each numbered from the same ID: they name different
/// people, or may do so soon. Those that different probes hear need not say so.
bool Claims::areOthers(const Claim& one, const Claim& other) {
    const bool areNamed = one.name != 0 && other.name != 0;
    const log::Stamp known = std::max(one.since, other.since) + kNamed;
    return one.host != other.host &&
           (areNamed ? one.name != other.name : one.probe != other.probe || one.stamp < known);
}

/// Makes a claim the newest. Those that came since its sender or host sent before, if that was a moment ago,
/// itself the last.
template <class Key>
std::span<const Claims::Claim> Claims::turnOf(std::vector<Claim>& claims, const Claim& claim,
                                              Key Claim::*key) {
    const auto own = std::ranges::find(claims, claim.*key, key);
    if (own == claims.end()) {
        if (claims.size() == kMostClaims) {
            claims.erase(claims.begin());
        }
        claims.push_back(claim);
        return {};
    }
    const bool isSoon = claim.stamp - own->stamp < kTurns;
    const log::Stamp since = own->since;
    std::rotate(own, own + 1, claims.end());
    claims.back() = claim;
    claims.back().since = since;
    return isSoon ? std::span<const Claim>(own, claims.end()) : std::span<const Claim>();
}

void Claims::report(std::span<const Claim> claims, const log::Packet& packet, std::uint8_t character,
                    Incidents& incidents) {
    const Claim& newest = claims.back();
    for (const Claim& other : claims) {
        if (other.sender != newest.sender && other.beginning == newest.beginning) {
            m_sources[other.sender].isTwin = m_sources[newest.sender].isTwin = true;
        }
    }
    for (auto own = claims.rbegin(); own != claims.rend(); ++own) {
        std::vector<std::string> others;
        for (const Claim& other : claims) {
            if (other.sender != own->sender) {
                const auto found = m_sources.find(other.sender);
                others.push_back(found != m_sources.end() ? found->second.address : "a retired sender");
            }
        }
        std::ranges::sort(others); // so that the fact stays
        Occurrence one = Occurrence::at(IncidentKind::Conflict, own->sender, packet.stamp, packet.number);
        one.character = character;
        one.detail = {m_sources[own->sender].isTwin ? words::Kind::SentTwice : words::Kind::TwoSenders,
                      {{"id", std::uint64_t{character}}, {"others", std::move(others)}}};
        incidents.report(one);
    }
}

} // namespace posewire::model
