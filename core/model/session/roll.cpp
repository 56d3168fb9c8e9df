// SPDX-License-Identifier: MIT
#include "core/model/session/roll.h"

namespace posewire::model {
namespace {

/// Strangers are retired so many at once.
constexpr std::size_t kStrangersAtOnce = 16;
/// Characters of one host and one ID among which a predecessor is looked for.
constexpr std::size_t kMostNamesakes = 16;
/// So many datagrams of each character of a sender make it unlikely that another one appears.
constexpr std::size_t kEstablishedEach = 32;
/// A performer goes on under another ID within this time, and by then metadata has come again.
constexpr log::Duration kTurn = std::chrono::seconds(2);
constexpr log::Duration kNamed = std::chrono::seconds(5);
/// From whom nothing has come for as long while another came may have ended.
constexpr log::Duration kEnded = std::chrono::milliseconds(200);

} // namespace

void Roll::setEdges(const TimeRange& range) {
    m_edges = range;
    m_streams.forEach([&range](Stream& stream) { stream.accounting.setEdges(range); });
    m_senders.forEach([&range](Sender& sender) { sender.history.setEdges(range); });
}

Sender* Roll::take(const log::Packet& packet) {
    m_observed = packet.stamp;
    if (Sender* known = m_senders.find(packet.sender)) {
        const Place& place = m_recencies.at(known->id);
        place.list->splice(place.list->end(), *place.list, place.at);
        return known;
    }
    auto held = m_known.find(packet.sender);
    if (held == nullptr) {
        return nullptr;
    }
    if (m_strangers.size() >= kMostStrangers) {
        retireOldest(m_strangers, kStrangersAtOnce);
    }
    Sender& sender = m_senders.add(packet.sender);
    sender.info = *held;
    sender.history.setMost(kBucketsOfSender);
    sender.history.setEdges(m_edges);
    sender.held = std::move(held);
    sender.overrides = m_usual;
    if (const auto host = sender.host()) {
        const auto [newest, isNew] = m_newestOfHost.try_emplace(*host, sender.id);
        const Sender* before = isNew ? nullptr : m_senders.find(std::exchange(newest->second, sender.id));
        sender.overrides = before != nullptr ? before->overrides : m_usual;
    }
    m_recencies[sender.id] = {&m_strangers, m_strangers.insert(m_strangers.end(), sender.id)};
    return &sender;
}

bool Roll::enter(Observed& seen) {
    const log::Packet& packet = seen.packet;
    const wire::Header& header = *seen.header;
    promote(*seen.sender);
    seen.character = characterOf(*seen.sender, seen);
    if (seen.character == nullptr) {
        return false;
    }
    if (seen.stream == nullptr) {
        seen.stream = streamOf({packet.sender, header.character, header.type()}, *seen.sender);
        if (seen.stream == nullptr) {
            return false;
        }
        seen.character->streams.push_back(seen.stream);
    }
    seen.character->isConfirmed =
        seen.character->isConfirmed || m_unconfirmed.take(seen.character->key, packet, header);
    seen.character->lastStamp = packet.stamp;
    seen.character->lastPacket = packet.number;
    return true;
}

Character* Roll::characterOf(Sender& sender, const Observed& seen) {
    const CharacterKey key{sender.id, seen.header->character};
    if (Character* known = m_characters.find(key)) {
        return known;
    }
    if (m_characters.size() >= kMostCharacters && !retireSilent()) {
        return nullptr;
    }
    // A corrupt header may have invented it where others have long been there.
    const std::size_t others = sender.characters.size();
    Character& added = m_characters.add(key);
    added.isConfirmed = others == 0 || sender.datagrams <= kEstablishedEach * others;
    Character* const before = predecessorOf(added);
    added.firstPacket = seen.packet.number;
    added.ordinal = m_characterCount++;
    if (before != nullptr) {
        takeOver(*before, added, m_observed);
    }
    sender.characters.push_back(&added);
    return &added;
}

void Roll::takeOver(Character& before, Character& after, log::Stamp since) {
    before.after = after.key;
    after.before = before.key;
    after.ordinal = before.ordinal;
    m_listener.tookOver(before.key, after.key, since);
}

void Roll::findRenumbered(const Observed& seen) {
    Character& one = *seen.character;
    const log::Stamp since = one.streams.front()->accounting.firstStamp();
    const log::Duration age = seen.packet.stamp - since;
    if (one.before || !one.isConfirmed || age < kEnded || age > kNamed) {
        return;
    }
    constexpr double kSamePlace = 0.2; // metres
    const ForeignText& name = one.metadata.value("name", seen.packet.number);
    const auto isSame = [&](const Character& other) {
        return other.metadata.value("name", seen.packet.number) == name &&
               (!name.isEmpty() || (other.content.newest() - one.content.began()).norm() < kSamePlace);
    };
    for (const Character* each : seen.sender->characters) {
        const bool hasEnded = each->lastPacket < one.firstPacket && since - each->lastStamp <= kTurn;
        if (hasEnded && !each->after && isSame(*each)) {
            takeOver(*m_characters.find(each->key), one, since);
            return;
        }
    }
}

Stream* Roll::streamOf(const log::StreamKey& key, const Sender& sender) {
    std::size_t ofSender = 0;
    for (const Character* character : sender.characters) {
        ofSender += character->streams.size();
    }
    if (ofSender >= kMostStreamsOfSender || (m_streams.size() >= kMostStreams && !retireSilent())) {
        return nullptr;
    }
    Stream& added = m_streams.add(key);
    m_listener.began(added, sender);
    return &added;
}

/// The one of the same host with the same ID that was heard last, among the newest; from now on the new one
/// is one of them.
Character* Roll::predecessorOf(const Character& character) {
    const auto host = m_senders.find(character.key.sender)->host();
    if (!host) {
        return nullptr;
    }
    std::deque<CharacterKey>& namesakes = m_namesakes[{*host, character.key.character}];
    Character* newest = nullptr;
    for (const CharacterKey& key : namesakes) {
        Character* other = m_characters.find(key);
        newest = newest == nullptr || other->lastPacket > newest->lastPacket ? other : newest;
    }
    namesakes.push_back(character.key);
    if (namesakes.size() > kMostNamesakes) {
        namesakes.pop_front();
    }
    return newest;
}

} // namespace posewire::model
