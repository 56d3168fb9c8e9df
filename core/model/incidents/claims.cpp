// SPDX-License-Identifier: MIT
#include "core/model/incidents/claims.h"

#include "core/log/ip_address.h"

#include <algorithm>
#include <functional>
#include <string_view>

namespace posewire::model {
namespace {

/// Senders that take turns within this time send at once.
constexpr log::Duration kTurns = std::chrono::seconds(1);
/// So many senders of one character are told apart.
constexpr std::size_t kMostClaims = 8;

} // namespace

bool Claims::meet(log::SenderId sender, const std::string& address) {
    const auto [place, isNew] = m_sources.try_emplace(sender);
    if (isNew) {
        place->second = {address, std::hash<std::string_view>{}(log::hostOf(address))};
    }
    return isNew;
}

void Claims::take(const log::Packet& packet, const wire::Header& header, Incidents& incidents) {
    const Claim claim{packet.sender, m_sources[packet.sender].host, packet.stamp};
    // One host may send types from several ports; two hosts are two performers.
    std::vector<Claim>& ofType = m_claims[{header.character, header.type()}];
    std::vector<Claim>& ofHosts = m_claimsOfHosts[header.character];
    const std::span<const Claim> turn = turnOf(ofType, claim, &Claim::sender);
    const std::span<const Claim> turnOfHost = turnOf(ofHosts, claim, &Claim::host);
    if (turn.size() > 1 || turnOfHost.size() > 1) {
        report(turn.size() > 1 ? turn : turnOfHost, packet, header.character, incidents);
    }
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
    std::rotate(own, own + 1, claims.end());
    claims.back() = claim;
    return isSoon ? std::span<const Claim>(own, claims.end()) : std::span<const Claim>();
}

/// Of each of them, naming all others.
void Claims::report(std::span<const Claim> claims, const log::Packet& packet, std::uint8_t character,
                    Incidents& incidents) const {
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
        incidents.report(one);
    }
}

} // namespace posewire::model
