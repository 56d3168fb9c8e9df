// SPDX-License-Identifier: MIT
#include "core/model/accounting/event_follower.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>
#include <utility>

namespace posewire::model {
namespace {

constexpr log::Duration kSilent = std::chrono::seconds(1);
constexpr log::Duration kCheck = std::chrono::milliseconds(100);
constexpr log::Duration kWatch = std::chrono::milliseconds(500);
constexpr std::int64_t kJumpMs = 500;
/// This many samples lost in a row are a burst.
constexpr std::uint32_t kBurstSamples = 10;

Event eventOf(EventKind kind, const log::Packet& packet) {
    return Event::of(kind, packet.sender, packet.stamp, packet.number);
}

Event eventOf(EventKind kind, const log::StreamKey& stream, const Verdict& verdict) {
    Event event = Event::of(kind, stream.sender, verdict.stamp, verdict.packet);
    event.character = stream.character;
    return event;
}

} // namespace

void EventFollower::followClock(const log::Timeline& timeline) {
    for (const std::size_t count = timeline.stepCount(); m_clockSteps < count; ++m_clockSteps) {
        const log::ClockStep step = timeline.step(m_clockSteps);
        if (step.change != log::Duration::zero()) {
            m_untoldSteps.push_back(step);
        }
    }
}

void EventFollower::tellClockSets(log::Stamp until) {
    std::erase_if(m_untoldSteps, [&](const log::ClockStep& step) {
        if (step.from > until) {
            return false;
        }
        Event event = Event::of(EventKind::ClockSet, log::kNoSender, step.from, m_lastPacket);
        event.value = log::secondsOf(step.change);
        m_events.report(event);
        m_events.end(event, step.from); // two are two, however soon
        return true;
    });
}

void EventFollower::takePacket(const log::Packet& packet, const PacketDigest& digest) {
    m_lastPacket = packet.number;
    tellClockSets(packet.stamp);
    if (packet.stamp >= m_nextCheck) {
        check(packet.stamp);
        m_nextCheck = packet.stamp + kCheck;
    }
    if (packet.stamp >= m_nextWatch) {
        m_watch.check(packet.stamp, m_events);
        m_nextWatch = packet.stamp + kWatch;
    }
    if (packet.kernelDropsBefore != 0) {
        Event event = eventOf(EventKind::Dropped, packet);
        event.samples = packet.kernelDropsBefore;
        m_events.report(event);
    }
    if (digest.kind == PacketKind::Malformed) {
        m_events.report(eventOf(EventKind::Malformed, packet));
    } else if (digest.kind == PacketKind::Foreign) {
        m_events.report(eventOf(EventKind::Foreign, packet));
    }
}

void EventFollower::takeOvertaken(std::uint64_t packet, std::uint64_t count, log::Stamp stamp) {
    Event event = Event::of(EventKind::Overtaken, log::kNoSender, stamp, packet);
    event.samples = count;
    m_events.report(event);
}

void EventFollower::retire(log::SenderId sender) {
    m_watch.retire(sender);
    m_events.retire(sender);
    m_senders.erase(sender);
    std::erase_if(m_characters, [sender](const auto& entry) { return entry.first.sender == sender; });
}

void EventFollower::takeDatagram(const log::Packet& packet, const wire::Header& header, Stream& stream) {
    m_watch.wake(stream);
    auto sender = m_senders.find(packet.sender);
    if (sender == m_senders.end()) {
        sender = m_senders.try_emplace(packet.sender).first;
        m_events.report(eventOf(EventKind::SenderUp, packet));
    }
    if (countsSamples(header.type())) {
        sender->second.lastSampled = packet.stamp;
        if (std::exchange(sender->second.isDown, false)) {
            m_events.end(eventOf(EventKind::SenderDown, packet), packet.stamp);
        }
        noteSampled(packet, header);
    }
}

void EventFollower::noteSampled(const log::Packet& packet, const wire::Header& header) {
    const CharacterKey key{packet.sender, header.character};
    Character& character = m_characters[key];
    if (std::exchange(character.isStale, false)) {
        Event event = eventOf(EventKind::Stale, packet);
        event.character = header.character;
        m_events.end(event, packet.stamp);
    }
    character.lastSampled = packet.stamp;
    character.lastPacket = packet.number;
    noteClaim(packet, header);
}

/// Two senders that take turns with one character in one type.
void EventFollower::noteClaim(const log::Packet& packet, const wire::Header& header) {
    auto& [newest, before] = m_claims[{header.character, header.type()}];
    if (newest.stamp != log::Stamp() && newest.sender != packet.sender) {
        const bool isBack = before.stamp != log::Stamp() && before.sender == packet.sender &&
                            packet.stamp - before.stamp < std::chrono::seconds(1);
        if (isBack) {
            Event event = eventOf(EventKind::CharacterConflict, packet);
            event.sender = std::min(packet.sender, newest.sender);
            event.character = header.character;
            m_events.report(event);
        }
        before = newest;
    }
    newest = {packet.sender, packet.stamp};
}

void EventFollower::takeVerdict(const log::StreamKey& stream, const Verdict& verdict) {
    if (countsSamples(stream.type)) {
        noteTimeCode(stream, verdict);
    }
    if (!verdict.isRestart) {
        return;
    }
    // All streams of a character restart together, each with a verdict of its own.
    log::Stamp& restart = m_characters[{stream.sender, stream.character}].restart;
    const bool isReported =
        restart != log::Stamp() && std::chrono::abs(verdict.stamp - restart) < std::chrono::seconds(1);
    if (!isReported) {
        restart = verdict.stamp;
        m_events.report(eventOf(EventKind::Restart, stream, verdict));
    }
}

/// A time code that moves differently from our clock while the counter runs on. What came out of order is
/// no evidence.
void EventFollower::noteTimeCode(const log::StreamKey& stream, const Verdict& verdict) {
    Character& character = m_characters[{stream.sender, stream.character}];
    const bool isFirst = character.stamp == log::Stamp();
    const auto moved = static_cast<std::int32_t>(verdict.sample - character.sample);
    const bool isBeginning = isFirst || verdict.isRestart || moved < -Probation::kMostBack;
    if (!verdict.isFirstOfSample || verdict.isReordered || verdict.isStray || (moved <= 0 && !isBeginning)) {
        return;
    }
    const std::int64_t passedMs = (verdict.stamp - character.stamp) / std::chrono::milliseconds(1);
    const std::int64_t jumpMs = static_cast<std::int32_t>(verdict.timeCode - character.timeCode) - passedMs;
    if (!isBeginning && moved < Probation::kMostForward && verdict.timeCode != character.timeCode &&
        std::abs(jumpMs) > kJumpMs) {
        Event event = eventOf(EventKind::TimeCodeJump, stream, verdict);
        event.value = static_cast<double>(jumpMs);
        m_events.report(event);
    }
    character.sample = verdict.sample;
    character.timeCode = verdict.timeCode;
    character.stamp = verdict.stamp;
}

void EventFollower::takeGap(const Gap& gap) {
    if (gap.lost == 0) {
        return;
    }
    const EventKind kind = gap.lost >= kBurstSamples ? EventKind::Burst : EventKind::Gap;
    Event event = Event::of(kind, gap.stream.sender, gap.fromStamp, gap.fromPacket);
    event.character = gap.stream.character;
    event.type = gap.stream.type;
    event.lastStamp = gap.toStamp;
    event.lastPacket = gap.toPacket;
    event.samples = gap.lost;
    event.cause = gap.cause;
    event.detail = gap.evidenceText();
    m_events.report(event);
}

void EventFollower::takeChange(EventKind kind, const CharacterKey& key, const log::Packet& packet,
                               std::string detail) {
    Event event = eventOf(kind, packet);
    event.character = key.character;
    event.detail = std::move(detail);
    m_events.report(event);
}

void EventFollower::advance(log::Stamp stamp) {
    tellClockSets(stamp - kSilent);
    if (stamp >= m_nextCheck) {
        check(stamp);
    }
}

void EventFollower::endFile() {
    for (auto& [id, sender] : m_senders) {
        sender.lastSampled = {};
    }
    for (auto& [key, character] : m_characters) {
        character.lastSampled = {};
    }
}

void EventFollower::check(log::Stamp stamp) {
    m_events.advance(stamp);
    for (auto& [id, sender] : m_senders) {
        const bool isSilent = sender.lastSampled != log::Stamp() && stamp - sender.lastSampled > kSilent;
        if (isSilent && !sender.isDown) {
            sender.isDown = true;
            m_events.report(Event::of(EventKind::SenderDown, id, sender.lastSampled + kSilent));
        }
    }
    for (auto& [key, character] : m_characters) {
        const auto sender = m_senders.find(key.sender);
        const bool isSilent =
            character.lastSampled != log::Stamp() && stamp - character.lastSampled > kSilent;
        if (isSilent && !character.isStale && sender != m_senders.end() && !sender->second.isDown) {
            character.isStale = true;
            Event event = Event::of(EventKind::Stale, key.sender, character.lastSampled + kSilent,
                                    character.lastPacket);
            event.character = key.character;
            m_events.report(event);
        }
    }
}

std::vector<const Event*> EventFollower::troublesOf(const CharacterKey& key,
                                                    std::optional<log::Stamp> stamp) const {
    std::vector<const Event*> troubles = stamp ? m_events.currentAt(*stamp) : m_events.currentOf(key.sender);
    std::erase_if(troubles, [&key](const Event* event) {
        return event->sender != key.sender || event->character.value_or(key.character) != key.character ||
               event->severity() == EventSeverity::Info;
    });
    // What happened is more specific than the limit that it broke.
    const auto rank = [](const Event* event) {
        return std::tuple(event->severity(), event->group() != EventGroup::Limit, event->number);
    };
    std::ranges::sort(troubles, [&](const Event* a, const Event* b) { return rank(a) > rank(b); });
    return troubles;
}

Condition EventFollower::conditionOf(const CharacterKey& key, std::optional<log::Stamp> stamp) const {
    const auto troubles = troublesOf(key, stamp);
    if (troubles.empty()) {
        return {};
    }
    const Event& worst = *troubles.front();
    const bool isError = worst.severity() == EventSeverity::Error;
    return {isError ? Condition::Level::Error : Condition::Level::Warning, worst.text(), worst.number};
}

} // namespace posewire::model
