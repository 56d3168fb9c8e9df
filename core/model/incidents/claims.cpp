// SPDX-License-Identifier: MIT
#include "core/model/incidents/incident_follower.h"

#include <utility>

/// Who sends a character: one sender after the other, or two at once.
namespace posewire::model {
namespace {

/// Senders that take turns within this time send at once.
constexpr log::Duration kTurns = std::chrono::seconds(1);

} // namespace

void IncidentFollower::supersede(const CharacterKey& key, const CharacterKey& by, log::Stamp stamp) {
    const auto found = m_characters.find(key);
    if (found == m_characters.end()) {
        return;
    }
    if (found->second.outage != 0) {
        resume(key, found->second, stamp);
    }
    found->second.lastSampled = {};
    for (Stream* stream : found->second.streams) { // nothing is expected of them
        stream->excusedUntil = log::Stamp::max();
    }
    for (const Incident* lasting : m_incidents.currentOf(key.sender)) {
        if (lasting->group() == IncidentGroup::Limit) {
            for (const std::uint8_t type : lasting->types()) {
                m_incidents.endPart(lasting->number, key.character, type, stamp);
            }
        }
    }
    m_characters[by].tookOver = TakeOver{key, stamp};
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
    one.detail = "Its sender sends from another port now.";
    m_incidents.report(one);
}

void IncidentFollower::noteClaim(const log::Packet& packet, const wire::Header& header, std::size_t host) {
    const Claim claim{packet.sender, host, packet.stamp};
    Claims& ofType = m_claims[{header.character, header.type()}];
    bool isTold = false;
    if (ofType.newest.stamp != log::Stamp() && ofType.newest.sender != packet.sender) {
        isTold = ofType.before.sender == packet.sender && isTurn(ofType, packet.stamp);
        if (isTold) {
            tellConflict(packet, ofType.newest.sender, header.character);
        }
        ofType.before = ofType.newest;
    }
    ofType.newest = claim;
    // One host may send types from several ports; two hosts are two performers.
    Claims& ofHost = m_claimsOfHosts[header.character];
    if (ofHost.newest.stamp != log::Stamp() && ofHost.newest.host != claim.host) {
        if (!isTold && ofHost.before.host == claim.host && isTurn(ofHost, packet.stamp)) {
            tellConflict(packet, ofHost.newest.sender, header.character);
        }
        ofHost.before = ofHost.newest;
    }
    ofHost.newest = claim;
}

bool IncidentFollower::isTurn(const Claims& claims, log::Stamp stamp) {
    return claims.before.stamp != log::Stamp() && stamp - claims.before.stamp < kTurns;
}

/// Of both.
void IncidentFollower::tellConflict(const log::Packet& packet, log::SenderId other, std::uint8_t character) {
    for (const auto& [of, with] : {std::pair(packet.sender, other), std::pair(other, packet.sender)}) {
        Occurrence one = Occurrence::at(IncidentKind::Conflict, of, packet.stamp, packet.number);
        one.character = character;
        const auto found = m_sources.find(with);
        one.detail = found != m_sources.end() ? found->second.address : "a retired sender";
        m_incidents.report(one);
    }
}

} // namespace posewire::model
