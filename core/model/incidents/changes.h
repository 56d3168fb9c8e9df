// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/log/time.h"
#include "core/log/timeline.h"
#include "core/model/accounting/probation.h"
#include "core/model/accounting/stream.h"
#include "core/model/incidents/incidents.h"
#include "core/wire/header.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// What changes: our own clock, and in the samples of a character the spacing of their counters and their
/// time codes.
namespace posewire::model {

/// At a verdict, of the character whose stream it is about.
[[nodiscard]] Occurrence occurrenceOf(IncidentKind kind, const log::StreamKey& stream,
                                      const Verdict& verdict);

/// Nothing of a character came from one stamp to the other.
struct Silence {
    log::Stamp from{};
    log::Stamp to{};
    std::uint64_t incident = 0; ///< 0: none yet
};

/// The wall clock of this computer, as it was set.
class ClockSets {
public:
    void follow(const log::Timeline& timeline);
    /// Reports the sets up to a moment, which came before a packet.
    void report(log::Stamp until, std::uint64_t packet, Incidents& incidents);

private:
    std::size_t m_steps = 0;               ///< of the time line that were seen
    std::vector<log::ClockStep> m_pending; ///< no packet has come since
};

/// The sender sends another share of its samples, or an irregular one.
[[nodiscard]] std::optional<Occurrence> stepChange(Stream& stream, const Verdict& verdict);

/// Follows the time codes of a character: whether they move with our clock while the counter runs on.
class TimeCodes {
public:
    /// A sample, and the silence before it. One out of order is no evidence.
    void take(const Stream& stream, const Verdict& verdict, const Silence& silence, Incidents& incidents);

private:
    void noteFrozen(const log::StreamKey& stream, const Verdict& verdict, Incidents& incidents);
    bool noteChange(const Stream& stream, const Verdict& verdict, const Silence& silence,
                    Incidents& incidents);

    std::uint32_t m_sample = 0;
    std::uint32_t m_code = 0;
    log::Stamp m_stamp{};
    log::Stamp m_moved{};             ///< when it last changed; 0 before it ever did
    log::Duration m_longest{};        ///< between two changes, while samples came
    std::uint32_t m_changes = 0;      ///< how often it has changed
    bool m_isFrozen = false;          ///< that is reported
    std::optional<Occurrence> m_jump; ///< while it may be none
    bool m_isPause = false;           ///< the jump: the sender paused
};

/// Finds characters that several senders send at once.
class Claims {
public:
    /// True if it is new.
    bool meet(log::SenderId sender, const log::SenderInfo& info);
    /// A sample of a character, from a sender that was met. `name`: of the character; empty before it has
    /// one.
    void take(const log::Packet& packet, const wire::Header& header, std::string_view name,
              Incidents& incidents);
    void retire(log::SenderId sender) { m_sources.erase(sender); }

private:
    struct Claim {
        log::SenderId sender{};
        std::size_t host = 0;
        std::size_t probe = 0;
        log::Stamp stamp{};
        log::Stamp since{};        ///< its first sample
        std::size_t name = 0;      ///< one number for each; 0 for none
        std::size_t beginning = 0; ///< of its newest datagram
    };
    struct Source {
        std::string address;
        std::size_t host = 0;  ///< one number for each
        std::size_t probe = 0; ///< likewise
        bool isTwin = false;   ///< sends what another sends, byte by byte
    };
    template <class Key>
    static std::span<const Claim> turnOf(std::vector<Claim>& claims, const Claim& claim, Key Claim::*key);
    [[nodiscard]] static bool areOthers(const Claim& one, const Claim& other);
    void report(std::span<const Claim> claims, const log::Packet& packet, std::uint8_t character,
                Incidents& incidents);

    std::map<log::SenderId, Source> m_sources;
    /// By character and type, each sender once, the newest last.
    std::map<std::pair<std::uint8_t, std::uint8_t>, std::vector<Claim>> m_claims;
    std::map<std::uint8_t, std::vector<Claim>> m_claimsOfHosts; ///< by character, each host once
};

} // namespace posewire::model
