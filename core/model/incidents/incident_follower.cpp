// SPDX-License-Identifier: MIT
#include "core/model/incidents/incident_follower.h"

#include <algorithm>
#include <tuple>

namespace posewire::model {
namespace {

constexpr log::Duration kCheck = std::chrono::milliseconds(20);
constexpr log::Duration kWatch = std::chrono::milliseconds(500);
constexpr log::Duration kLong = std::chrono::seconds(1);
/// Of a stream while others of its character go on: before it is too old.
constexpr log::Duration kEnded = std::chrono::milliseconds(500);
/// Chance does not drop this many samples of one stream in a row while other streams of its character arrive.
constexpr double kSamplesOfEnd = 10;
constexpr log::Duration kNone = log::Duration::zero();
/// What happened is not seen in any window of a limit any more.
constexpr double kWindowAndMore = 1.5;

Occurrence occurrenceOf(IncidentKind kind, const log::Packet& packet) {
    return Occurrence::at(kind, packet.sender, packet.stamp, packet.number);
}

Occurrence ofStream(IncidentKind kind, const log::StreamKey& stream, const Verdict& verdict) {
    Occurrence one = occurrenceOf(kind, stream, verdict);
    one.type = stream.type;
    return one;
}

/// Before the second sample of a character: its rate may be 1 Hz, and that sample late.
constexpr log::Duration kFirst = std::chrono::milliseconds(2'500);

/// How long a character may be silent: at least three samples of its fastest stream.
log::Duration patienceWith(std::span<Stream* const> streams, log::Duration least, double samples) {
    double fastestHz = 0;
    for (const Stream* stream : streams) {
        fastestHz = std::max(fastestHz, stream->statistics.rateHz());
    }
    return fastestHz > 0 ? std::max(least, log::durationOf(samples / fastestHz)) : kFirst;
}

/// Streams of a character that are missing while others go on: they may be late, lost or ended. `newest`:
/// when the newest sample of all came.
void checkStalled(std::span<Stream* const> streams, log::Stamp newest, log::Stamp stamp) {
    const bool goesOn = newest != log::Stamp() && stamp - newest < IncidentFollower::kSilent;
    for (Stream* stream : streams) {
        const log::Duration silent = newest - stream->accounting.lastStamp();
        stream->isStalled = goesOn && !stream->hasEnded && stream->isEstablished() &&
                            silent > IncidentFollower::kSilent &&
                            silent > patienceWith(std::span(&stream, 1), IncidentFollower::kSilent, 3);
    }
}

/// This computer dropped so many datagrams.
Occurrence dropsAt(std::uint64_t count, Occurrence where) {
    where.cause = LossCause::ThisComputer;
    where.count = 0;
    where.value = static_cast<double>(count);
    return where;
}

/// Of the outage that a loss is of, by the last silence of its character; 0 for none.
std::uint64_t outageOf(const Loss& loss, const Silence& silence) {
    const log::Duration common = std::min(silence.to, loss.to) - std::max(silence.from, loss.from);
    return common > kNone && 2 * common >= loss.to - loss.from ? silence.incident : 0;
}

/// Of a datagram that cannot be decoded, also where its header has no readable type: as it stands there.
std::optional<std::uint8_t> characterOf(const log::Packet& packet,
                                        const std::optional<wire::Header>& header) {
    constexpr std::size_t kAt = 16; // of revision K, 2.4.1
    if (header) {
        return header->character;
    }
    return packet.bytes.size() < wire::kHeaderSize
               ? std::nullopt
               : std::optional(std::to_integer<std::uint8_t>(packet.bytes[kAt]));
}

/// Those that ended: one now, and those of the incident before it.
words::Fact endedFact(const Incident* known, std::uint8_t type) {
    std::vector<std::uint8_t> types = known != nullptr ? known->types() : std::vector<std::uint8_t>();
    if (const auto place = std::ranges::lower_bound(types, type); place == types.end() || *place != type) {
        types.insert(place, type);
    }
    words::Fact fact = words::typesFact(types);
    fact.kind = words::Kind::TypesEnded;
    return fact;
}

} // namespace

void IncidentFollower::takePacket(const log::Packet& packet, const PacketDigest& digest,
                                  const std::optional<wire::Header>& header) {
    m_lastPacket = packet.number;
    m_clockSets.report(packet.stamp, m_lastPacket, m_incidents);
    if (packet.stamp >= m_nextCheck) {
        check(packet.stamp);
        m_nextCheck = packet.stamp + kCheck;
    }
    if (packet.stamp >= m_nextWatch) {
        checkEnded(packet.stamp);
        m_watch.check(packet.stamp, m_incidents);
        m_nextWatch = packet.stamp + kWatch;
    }
    if (packet.droppedBefore() != 0) {
        m_incidents.report(dropsAt(packet.droppedBefore(), occurrenceOf(IncidentKind::Local, packet)));
    }
    if (digest.kind == PacketKind::Malformed) {
        Occurrence one = occurrenceOf(IncidentKind::Malformed, packet);
        const std::optional<std::uint8_t> character = characterOf(packet, header);
        if (character && m_characters.contains({packet.sender, *character})) {
            one.character = character;
            one.type = header ? std::optional(header->type()) : std::nullopt;
        }
        m_incidents.report(one);
    } else if (digest.kind == PacketKind::Foreign) {
        m_incidents.report(occurrenceOf(IncidentKind::Foreign, packet));
    }
}

void IncidentFollower::takeDropsUnseen(std::uint64_t count, const log::Packet& next) {
    m_incidents.report(
        dropsAt(count, Occurrence::at(IncidentKind::Local, log::kNoSender, next.stamp, next.number)));
}

void IncidentFollower::takeOvertaken(std::uint64_t packet, std::uint64_t count, log::Stamp stamp) {
    Occurrence one = Occurrence::at(IncidentKind::Overtaken, log::kNoSender, stamp, packet);
    one.value = static_cast<double>(count);
    m_incidents.report(one);
}

void IncidentFollower::retire(log::SenderId sender) {
    m_watch.retire(sender);
    m_incidents.retire(sender);
    m_claims.retire(sender);
    m_outages.erase(sender);
    std::erase_if(m_expected, [sender](const auto* entry) { return entry->first.sender == sender; });
    std::erase_if(m_characters, [sender](const auto& entry) { return entry.first.sender == sender; });
}

/// From now on: it sent a sample then.
void IncidentFollower::expect(const CharacterKey& key, Character& character, log::Stamp sampled) {
    if (!std::exchange(character.isExpected, true)) {
        m_expected.push_back(&*m_characters.find(key));
    }
    character.lastSampled = std::max(character.lastSampled, sampled);
}

void IncidentFollower::takeDatagram(const log::Packet& packet, const wire::Header& header, Stream& stream,
                                    const Whose& whose, bool isLate) {
    m_watch.wake(stream);
    if (m_claims.meet(packet.sender, whose.sender)) {
        m_incidents.report(occurrenceOf(IncidentKind::SourceUp, packet));
    }
    if (countsSamples(header.type()) && !isLate) {
        noteSampled(packet, header, stream);
        m_claims.take(packet, header, whose.name, m_incidents);
    }
}

void IncidentFollower::noteSampled(const log::Packet& packet, const wire::Header& header, Stream& stream) {
    const CharacterKey key{packet.sender, header.character};
    Character& character = m_characters[key];
    if (!std::exchange(stream.isFollowed, true)) {
        character.streams.push_back(&stream);
    }
    stream.isStalled = false;
    if (std::exchange(stream.hasEnded, false)) {
        stream.excusedUntil = {};
        excuse(stream.key, packet.stamp);
    }
    if (character.outage == 0) { // whether or not anybody looked meanwhile
        checkSilence(key, character, packet.stamp);
    }
    if (character.outage != 0) {
        resume(key, character, packet.stamp);
    } else if (character.lastSampled == log::Stamp()) { // its first sample, or nobody took over after all
        for (Stream* each : character.streams) {
            each->excusedUntil = {};
        }
    }
    expect(key, character, packet.stamp);
    character.lastPacket = packet.number;
}

void IncidentFollower::fallSilent(const CharacterKey& key, Character& character, log::Stamp stamp) {
    Occurrence one =
        Occurrence::at(IncidentKind::Outage, key.sender, character.lastSampled, character.lastPacket);
    one.character = key.character;
    one.to = stamp;
    one.value = log::secondsOf(stamp - character.lastSampled);
    for (Stream* stream : character.streams) {
        stream->excusedUntil = log::Stamp::max();
    }
    // Whatever its cause turns out to be.
    std::uint64_t& outage = m_outages[key.sender];
    const Incident* known = m_incidents.find(outage);
    if (known != nullptr && known->isCurrent) {
        m_incidents.addTo(outage, one);
    } else {
        outage = m_incidents.report(one);
    }
    character.outage = outage;
    character.isLong = false;
}

/// Something came of a character that was silent, or nothing is expected of it any more. What comes late to
/// us may show that it was not.
void IncidentFollower::resume(const CharacterKey& key, Character& character, log::Stamp stamp) {
    const std::uint64_t number = std::exchange(character.outage, 0);
    const bool wasSilent = character.silenceAt(stamp) > character.patience;
    character.lastSilence = wasSilent ? Silence{character.lastSampled, stamp, number} : Silence();
    for (Stream* stream : character.streams) {
        stream->excusedUntil = stamp + log::durationOf(kWindowAndMore * thresholds().windowS);
    }
    if (!wasSilent) {
        m_incidents.takeBackPart(number, key);
        return;
    }
    Occurrence one = Occurrence::at(IncidentKind::Outage, key.sender, character.lastSampled, m_lastPacket);
    one.character = key.character;
    one.to = stamp;
    one.count = 0;
    one.value = log::secondsOf(stamp - character.lastSampled);
    m_incidents.addTo(number, one);
    m_incidents.endPartExactly(number, key, stamp);
}

void IncidentFollower::takeVerdict(Stream& stream, const Verdict& verdict) {
    if (verdict.isDuplicate) {
        m_incidents.report(ofStream(IncidentKind::Duplicates, stream.key, verdict));
    } else if (verdict.isReordered && !verdict.isStray) {
        m_incidents.report(ofStream(IncidentKind::Reordered, stream.key, verdict));
    }
    if (verdict.gap != 0) {
        excuse(stream.key, verdict.stamp);
    }
    if (countsSamples(stream.key.type)) {
        Character& character = m_characters[{stream.key.sender, stream.key.character}];
        character.timeCodes.take(stream, verdict, character.lastSilence, m_incidents);
        if (const std::optional<Occurrence> change = stepChange(stream, verdict)) {
            m_incidents.report(*change);
            if (change->detail.kind == words::Kind::StepChanged) {
                excuse(stream.key, verdict.stamp);
                stream.usualHz = 0;
            }
        }
    }
    if (!verdict.isRestart) {
        return;
    }
    // All streams of a character restart together, each with a verdict of its own.
    Character& character = m_characters[{stream.key.sender, stream.key.character}];
    const bool isReported = character.restart != log::Stamp() &&
                            std::chrono::abs(verdict.stamp - character.restart) < std::chrono::seconds(1);
    excuse(stream.key, verdict.stamp);
    stream.usualHz = 0;
    if (!isReported) {
        character.restart = verdict.stamp;
        m_incidents.report(occurrenceOf(IncidentKind::Restart, stream.key, verdict));
    }
}

std::uint64_t IncidentFollower::takeLoss(const Loss& loss) {
    const bool isLocal = loss.cause == LossCause::ThisComputer;
    Occurrence one;
    one.kind = isLocal ? IncidentKind::Local : IncidentKind::Loss;
    one.sender = loss.stream.sender;
    one.character = loss.stream.character;
    one.type = loss.stream.type;
    one.from = loss.from;
    one.to = loss.to;
    one.fromPacket = loss.fromPacket;
    one.toPacket = loss.toPacket;
    one.samples = loss.samples;
    one.cause = loss.cause;
    one.detail = loss.evidence;
    excuse(loss.stream, loss.to);
    const auto found = m_characters.find({loss.stream.sender, loss.stream.character});
    const std::uint64_t number =
        found != m_characters.end() ? outageOf(loss, found->second.lastSilence) : std::uint64_t{0};
    if (number != 0) {
        const Incident* outage = m_incidents.find(number);
        if (outage != nullptr && outage->cause.value_or(loss.cause) == loss.cause) {
            one.kind = IncidentKind::Outage;
            one.count = 0;
            one.isOver = true;
            m_incidents.addTo(number, one);
            m_incidents.setCause(number, loss.cause);
            return m_incidents.joinOutages(number);
        }
    }
    m_watch.takeLoss(loss.stream, loss.cause, loss.samples, loss.to);
    return m_incidents.report(one);
}

void IncidentFollower::takeBack(std::uint64_t incident, const log::StreamKey& stream, std::uint64_t samples,
                                bool isAll) {
    Incident::Part part;
    part.sender = stream.sender;
    part.character = stream.character;
    part.type = stream.type;
    m_incidents.takeBack(incident, part, samples, isAll ? 1 : 0);
}

/// An incident says why the stream is not as it should be: limits need not.
void IncidentFollower::excuse(const log::StreamKey& key, log::Stamp from) {
    const auto found = m_characters.find({key.sender, key.character});
    if (found == m_characters.end()) {
        return;
    }
    for (Stream* stream : found->second.streams) {
        if (stream->key == key) {
            stream->excusedUntil =
                std::max(stream->excusedUntil, from + log::durationOf(kWindowAndMore * thresholds().windowS));
        }
    }
}

void IncidentFollower::takeChange(IncidentKind kind, const CharacterKey& key, const log::Packet& packet,
                                  words::Fact detail) {
    Occurrence one = occurrenceOf(kind, packet);
    one.character = key.character;
    one.detail = std::move(detail);
    m_incidents.report(one);
}

void IncidentFollower::takeCondition(Occurrence one) {
    one.fromPacket = one.toPacket = m_lastPacket;
    words::clip(one.detail, Incidents::kMostDetailBytes);
    const Incident* known = m_incidents.currentLike(one);
    if (!one.detail.isNothing() && (known == nullptr || known->detail != one.detail)) {
        m_incidents.report(one);
    } else if (one.detail.isNothing() && known != nullptr) {
        m_incidents.end(known->number, one.to);
    }
}

void IncidentFollower::supersede(const CharacterKey& key, const CharacterKey& by, log::Stamp since) {
    const auto found = m_characters.find(key);
    if (found == m_characters.end()) {
        return;
    }
    if (found->second.outage != 0) {
        resume(key, found->second, since);
    }
    found->second.lastSampled = {};
    for (Stream* stream : found->second.streams) { // nothing is expected of them
        stream->excusedUntil = log::Stamp::max();
        stream->isStalled = false;
    }
    for (const Incident* lasting : m_incidents.currentOf(key.sender)) {
        if (lasting->group() == IncidentGroup::Limit) {
            for (const std::uint8_t type : lasting->types()) {
                m_incidents.endPart(lasting->number, key, type, since);
            }
        }
    }
    m_characters[by].tookOver = TakeOver{key, since};
}

void IncidentFollower::expect(const CharacterKey& key) {
    const auto found = m_characters.find(key);
    if (found == m_characters.end()) {
        return;
    }
    for (const Stream* stream : found->second.streams) {
        expect(key, found->second, stream->accounting.lastStamp());
    }
}

/// One that took over is a restart of its sender, once the one before has really fallen silent.
void IncidentFollower::checkTakenOver(const CharacterKey& key, Character& character, log::Stamp stamp) {
    if (!character.tookOver || character.lastSampled == log::Stamp() ||
        stamp - character.tookOver->stamp < kSilent) {
        return;
    }
    const TakeOver tookOver = *std::exchange(character.tookOver, std::nullopt);
    const auto before = m_characters.find(tookOver.before);
    if (before != m_characters.end() && before->second.lastSampled != log::Stamp()) {
        return; // it goes on
    }
    Occurrence one = Occurrence::at(IncidentKind::Restart, key.sender, tookOver.stamp, m_lastPacket);
    one.character = key.character;
    one.detail = key.sender == tookOver.before.sender
                     ? words::Fact{words::Kind::OtherId, {{"id", std::uint64_t{key.character}}}}
                     : words::Fact{words::Kind::OtherPort};
    m_incidents.report(one);
}

void IncidentFollower::advance(log::Stamp stamp) {
    m_clockSets.report(stamp - kLong, m_lastPacket, m_incidents);
    if (stamp >= m_nextCheck) {
        check(stamp);
    }
}

void IncidentFollower::endFile() {
    for (auto& [key, character] : m_characters) {
        character.lastSampled = {};
    }
}

/// Whether more time has passed without a sample than its streams ever leave.
void IncidentFollower::checkSilence(const CharacterKey& key, Character& character, log::Stamp stamp) {
    const log::Duration silent = character.silenceAt(stamp);
    if (silent <= kSilent) {
        return; // as with nearly every packet
    }
    const log::Duration patience = patienceWith(character.streams, kSilent, 3);
    if (silent > patience) {
        character.patience = patience;
        fallSilent(key, character, stamp);
    }
}

void IncidentFollower::check(log::Stamp stamp) {
    m_incidents.advance(stamp);
    std::erase_if(m_expected, [](auto* entry) {
        entry->second.isExpected = entry->second.lastSampled != log::Stamp();
        return !entry->second.isExpected;
    });
    for (auto* entry : m_expected) {
        auto& [key, character] = *entry;
        const log::Duration silent = character.silenceAt(stamp);
        checkStalled(character.streams, character.lastSampled, stamp);
        checkTakenOver(key, character, stamp);
        if (character.outage == 0) {
            checkSilence(key, character, stamp);
        } else if (silent > kLong && !std::exchange(character.isLong, true)) {
            Occurrence one =
                Occurrence::at(IncidentKind::Outage, key.sender, character.lastSampled, character.lastPacket);
            one.character = key.character;
            one.to = stamp;
            one.count = 0;
            one.value = log::secondsOf(silent);
            m_incidents.addTo(character.outage, one);
        }
    }
}

/// Streams that ended while others of their characters go on: that is no loss.
void IncidentFollower::checkEnded(log::Stamp stamp) {
    for (auto* entry : m_expected) {
        auto& [key, character] = *entry;
        if (character.outage != 0 || character.streams.size() < 2) {
            continue;
        }
        for (Stream* stream : character.streams) {
            // A silence of all of them is no end of one.
            const log::Duration silent =
                character.lastSampled - std::max(stream->accounting.lastStamp(), character.lastSilence.to);
            const bool isOver = stream->isEstablished() && stamp - character.lastSampled < kSilent &&
                                silent > patienceWith(std::span(&stream, 1), kEnded, kSamplesOfEnd);
            if (isOver && !std::exchange(stream->hasEnded, true)) {
                Occurrence one = Occurrence::at(IncidentKind::Step, key.sender,
                                                stream->accounting.lastStamp(), m_lastPacket);
                one.to = stamp;
                one.character = key.character;
                one.type = stream->key.type;
                one.cause = LossCause::Unknown;
                one.detail = endedFact(m_incidents.currentLike(one), stream->key.type);
                m_incidents.report(one);
                stream->isStalled = false;
                stream->excusedUntil = log::Stamp::max();
            }
        }
    }
}

std::vector<const Incident*> IncidentFollower::troublesOf(const CharacterKey& key,
                                                          std::optional<log::Stamp> stamp) const {
    std::vector<const Incident*> troubles =
        stamp ? m_incidents.currentAt(*stamp) : m_incidents.currentOf(key.sender);
    std::erase_if(troubles, [&key](const Incident* incident) {
        return incident->sender != key.sender || !incident->concerns(key) ||
               incident->severity() == IncidentSeverity::Info;
    });
    // What happened is more specific than the limit that it broke.
    const auto rank = [](const Incident* incident) {
        return std::tuple(incident->severity(), incident->group() != IncidentGroup::Limit, incident->number);
    };
    std::ranges::sort(troubles, [&](const Incident* a, const Incident* b) { return rank(a) > rank(b); });
    return troubles;
}

} // namespace posewire::model
