// SPDX-License-Identifier: MIT
#include "core/model/incidents/incident_follower.h"

#include <algorithm>
#include <string>
#include <utility>

/// Who sends a character: one sender after the other, or two at once.
namespace posewire::model {
namespace {

/// Senders that take turns within this time send at once.
constexpr log::Duration kTurns = std::chrono::seconds(1);
/// So many senders of one character are told apart.
constexpr std::size_t kMostClaims = 8;

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
        stream->isStalled = false;
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
    one.detail = {words::Kind::OtherPort};
    m_incidents.report(one);
}

void IncidentFollower::noteClaim(const log::Packet& packet, const wire::Header& header, std::size_t host) {
    const Claim claim{packet.sender, host, packet.stamp};
    // One host may send types from several ports; two hosts are two performers.
    std::vector<Claim>& ofType = m_claims[{header.character, header.type()}];
    std::vector<Claim>& ofHosts = m_claimsOfHosts[header.character];
    const std::span<const Claim> turn = turnOf(ofType, claim, &Claim::sender);
    const std::span<const Claim> turnOfHost = turnOf(ofHosts, claim, &Claim::host);
    if (turn.size() > 1 || turnOfHost.size() > 1) {
        tellConflict(turn.size() > 1 ? turn : turnOfHost, packet, header.character);
    }
}

/// Makes a claim the newest. Those that came since its sender or host sent before, if that was a moment ago,
/// itself the last.
template <class Key>
std::span<const IncidentFollower::Claim> IncidentFollower::turnOf(std::vector<Claim>& claims,
                                                                  const Claim& claim, Key Claim::*key) {
    const auto own = std::ranges::find(claims, claim.*key, key);
    if (own == claims.end()) {
        if (claims.size() == kMostClaims) {
            claims.erase(claims.begin());
        }
        claims.push_back(claim);
        return {};
    }
    const bool isSoon = claim.stamp - own->stamp < kTurns;
    std::rotate(own, own + 1, claims.end());
    claims.back() = claim;
    return isSoon ? std::span<const Claim>(own, claims.end()) : std::span<const Claim>();
}

/// Of each of them, naming all others.
void IncidentFollower::tellConflict(std::span<const Claim> claims, const log::Packet& packet,
                                    std::uint8_t character) {
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
        one.detail = {words::Kind::TwoSenders,
                      {{"id", std::uint64_t{character}}, {"others", std::move(others)}}};
        m_incidents.report(one);
    }
}

} // namespace posewire::model
