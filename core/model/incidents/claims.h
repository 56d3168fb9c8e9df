// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/log/time.h"
#include "core/model/incidents/incidents.h"
#include "core/wire/header.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace posewire::model {

/// Finds characters that several senders send at once.
class Claims {
public:
    /// A sender with its address. True if it is new.
    bool meet(log::SenderId sender, const std::string& address);
    /// A sample of a character, from a sender that was met.
    void take(const log::Packet& packet, const wire::Header& header, Incidents& incidents);
    void retire(log::SenderId sender) { m_sources.erase(sender); }

private:
    /// Who sends a character, and when it last did.
    struct Claim {
        log::SenderId sender{};
        std::size_t host = 0;
        log::Stamp stamp{};
    };
    struct Source {
        std::string address;
        std::size_t host = 0; ///< one number for each
    };
    template <class Key>
    static std::span<const Claim> turnOf(std::vector<Claim>& claims, const Claim& claim, Key Claim::*key);
    void report(std::span<const Claim> claims, const log::Packet& packet, std::uint8_t character,
                Incidents& incidents) const;

    std::map<log::SenderId, Source> m_sources;
    /// By character and type, each sender once, the newest last.
    std::map<std::pair<std::uint8_t, std::uint8_t>, std::vector<Claim>> m_claims;
    std::map<std::uint8_t, std::vector<Claim>> m_claimsOfHosts; ///< by character, each host once
};

} // namespace posewire::model
