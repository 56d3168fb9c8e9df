// SPDX-License-Identifier: MIT
#include "core/model/accounting/sender_clock.h"
#include "core/model/incidents/incident_follower.h"

#include <algorithm>
#include <cstdlib>

/// What is told of the time codes of samples.
namespace posewire::model {
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

} // namespace

/// A time code that moves differently from our clock while the counter runs on. What came out of order is
/// no evidence.
void IncidentFollower::noteTimeCode(const Stream& stream, const Verdict& verdict) {
    Character& character = m_characters[{stream.key.sender, stream.key.character}];
    TimeCodes& codes = character.timeCodes;
    const bool isFirst = codes.stamp == log::Stamp();
    const auto moved = static_cast<std::int32_t>(verdict.sample - codes.sample);
    const bool isBeginning = isFirst || verdict.isRestart || moved < -Probation::kMostBack;
    if (!verdict.isFirstOfSample || verdict.isReordered || verdict.isStray || (moved <= 0 && !isBeginning)) {
        return;
    }
    if (isBeginning) {
        codes = {};
    } else if (verdict.timeCode == codes.code) {
        noteStill(stream.key, verdict, codes);
    } else if (!noteChange(stream, verdict, character)) {
        return; // it is measured against what was before
    }
    codes.sample = verdict.sample;
    codes.code = verdict.timeCode;
    codes.stamp = verdict.stamp;
}

Occurrence IncidentFollower::timeCodeOccurrence(const log::StreamKey& stream, const Verdict& verdict) {
    Occurrence one = Occurrence::at(IncidentKind::TimeCode, stream.sender, verdict.stamp, verdict.packet);
    one.character = stream.character;
    return one;
}

void IncidentFollower::noteStill(const log::StreamKey& stream, const Verdict& verdict, TimeCodes& codes) {
    const log::Duration patience =
        codes.changes < kKnown ? kMostStill : std::clamp(3 * codes.longest, kStill, kMostStill);
    if (codes.moved == log::Stamp() || verdict.stamp - codes.moved < patience) {
        return;
    }
    Occurrence one = timeCodeOccurrence(stream, verdict);
    one.from = codes.moved;
    one.count = std::exchange(codes.isStill, true) ? 0 : 1;
    one.detail = {words::Kind::TimeCodeFrozen};
    m_incidents.report(one);
}

/// False while it may be a jump, or none.
bool IncidentFollower::noteChange(const Stream& stream, const Verdict& verdict, Character& character) {
    TimeCodes& codes = character.timeCodes;
    const log::Duration stood = verdict.stamp - codes.moved;
    const auto samples = static_cast<std::int32_t>(verdict.sample - codes.sample);
    const log::Duration passed = verdict.stamp - codes.stamp;
    const std::int64_t passedMs = millisecondsOf(passed);
    const std::int64_t jumpMs = timeCodeStep(codes.code, verdict.timeCode) - passedMs;
    // It may go on from where it stood, or have gone on unseen; some move once a second.
    const bool isExplained = jumpMs > -kJumpMs && jumpMs < millisecondsOf(stood - passed) + kJumpMs;
    const bool isJump = samples < Probation::kMostForward && std::abs(jumpMs) > kJumpMs &&
                        codes.moved != log::Stamp() && !isExplained;
    const Silence& silence = character.lastSilence;
    const bool endsSilence = silence.incident != 0 && silence.to == verdict.stamp &&
                             passed >= silence.to - silence.from &&
                             static_cast<std::uint32_t>(samples) <= stream.accounting.step();
    if (isJump) {
        Occurrence one = timeCodeOccurrence(stream.key, verdict);
        one.value = static_cast<double>(jumpMs);
        one.detail = {words::Kind::TimeCodeJumped, {{"value", words::Number{one.value}}}};
        if (!codes.jump) {
            codes.isPause = endsSilence && isAbout(-jumpMs, passedMs);
            codes.jump = one;
        }
        if (verdict.stamp - codes.jump->from < kJumped) {
            return false;
        }
        codes.isPause ? tellPause(silence.incident, stream.key.character)
                      : static_cast<void>(m_incidents.report(*codes.jump));
    } else if (endsSilence && isAbout(jumpMs, 0)) {
        tellPause(silence.incident, stream.key.character);
    }
    if (std::exchange(codes.isStill, false)) {
        Occurrence one = timeCodeOccurrence(stream.key, verdict);
        one.count = 0;
        one.detail = {words::Kind::TimeCodeWasFrozen, {{"lasted", words::Number{log::secondsOf(stood), 1}}}};
        m_incidents.report(one);
    } else if (codes.moved != log::Stamp() && !isJump && passed < kStill) {
        codes.longest = std::max(codes.longest, stood);
    }
    ++codes.changes;
    codes.jump.reset();
    codes.moved = verdict.stamp;
    return true;
}

/// The counter went on where it stopped, as did the time code or the clock: no sample was made meanwhile.
void IncidentFollower::tellPause(std::uint64_t outage, std::uint8_t character) {
    const Incident* incident = m_incidents.find(outage);
    if (incident == nullptr || incident->cause) {
        return;
    }
    Occurrence one =
        Occurrence::at(IncidentKind::Outage, incident->sender, incident->lastStamp, m_lastPacket);
    one.character = character;
    one.count = 0;
    one.isOver = true;
    one.detail = {words::Kind::SenderPaused};
    m_incidents.addTo(outage, one);
    m_incidents.setCause(outage, LossCause::Sender);
}

} // namespace posewire::model
