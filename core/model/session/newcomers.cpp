// SPDX-License-Identifier: MIT
#include "core/model/session/ingest.h"

#include "core/model/incidents/incident_follower.h"

#include <utility>

/// Senders, characters and streams that a packet is the first of: what they begin with, and where there is no
/// room for them.
namespace posewire::model {
namespace {

/// Strangers are retired so many at once.
constexpr std::size_t kStrangersAtOnce = 16;
/// Characters of one host and one ID among which a predecessor is looked for.
constexpr std::size_t kMostNamesakes = 16;
/// So many datagrams of each character of a sender make it unlikely that another one appears.
constexpr std::size_t kEstablishedEach = 32;

} // namespace

Sender* Ingest::senderOf(const log::Packet& packet) {
    if (Sender* known = m_senders.find(packet.sender)) {
        return known;
    }
    auto held = m_log.senders().find(packet.sender);
    if (held == nullptr) {
        return nullptr;
    }
    if (m_strangers.size() >= kMostStrangers) {
        retireOldest(m_strangers, kStrangersAtOnce);
    }
    Sender& sender = m_senders.add(packet.sender);
    sender.info = *held;
    sender.history.setMost(kBucketsOfSender);
    sender.held = std::move(held);
    if (const auto host = sender.host()) {
        const auto [newest, isNew] = m_newestOfHost.try_emplace(*host, sender.id);
        const Sender* before = isNew ? nullptr : find(std::exchange(newest->second, sender.id));
        sender.overrides = before != nullptr ? before->overrides : SenderOverride{};
    }
    m_recencies[sender.id] = {&m_strangers, m_strangers.insert(m_strangers.end(), sender.id)};
    return &sender;
}

Character* Ingest::characterOf(Sender& sender, std::uint8_t character, std::uint64_t packetNumber) {
    const CharacterKey key{sender.id, character};
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
    added.firstPacket = packetNumber;
    added.ordinal = m_characterCount++;
    if (before != nullptr) {
        before->after = key;
        added.before = before->key;
        m_incidents->supersede(before->key, key, m_observed);
        added.ordinal = before->ordinal;
    }
    sender.characters.push_back(&added);
    return &added;
}

Stream* Ingest::streamOf(const log::StreamKey& key, const Sender& sender) {
    std::size_t ofSender = 0;
    for (const Character* character : sender.characters) {
        ofSender += character->streams.size();
    }
    if (ofSender >= kMostStreamsOfSender || (m_streams.size() >= kMostStreams && !retireSilent())) {
        return nullptr;
    }
    Stream& added = m_streams.add(key);
    added.accounting.setDepth(m_depth);
    fitDepth();
    m_attribution->addStream(added, sender.info);
    return &added;
}

/// The one of the same host with the same ID that was heard last, among the newest; from now on the new one
/// is one of them.
Character* Ingest::predecessorOf(const Character& character) {
    const auto host = find(character.key.sender)->host();
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
