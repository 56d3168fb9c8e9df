// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/ip_packet.h"
#include "core/log/time.h"

#include <functional>
#include <list>
#include <map>
#include <vector>

namespace posewire::log {

/// An IP packet whose payload may have come in several frames.
struct WholePacket {
    IpPacket packet;                     ///< the first fragment's headers
    std::span<const std::byte> bytes;    ///< the payload; of an incomplete packet the beginning of it
    std::uint64_t fileOffset = 0;        ///< of the payload's first byte
    std::optional<Stamp> stamp; ///< of the frame that completed it
};

/// Puts IP fragments together (RFC 791, RFC 8200 section 4.5), in whatever order and however often they come.
class IpFragments {
public:
    using Visitor = std::function<void(const WholePacket&)>;

    /// So many packets may be incomplete at a time; the oldest is given up first.
    static constexpr std::size_t kMostPending = 32;

    /// `fileOffset`: of the fragment's payload. The visitor hears of a packet when it is complete, or given
    /// up: then of its beginning, if that was there.
    void add(const IpPacket& fragment, std::uint64_t fileOffset, std::optional<Stamp> stamp,
             const Visitor& visit);

    /// Gives up what is incomplete.
    void finish(const Visitor& visit);

private:
    struct Piece {
        std::vector<std::byte> bytes;
        std::uint64_t fileOffset = 0;
    };
    struct Pending {
        IpPacket packet;
        std::map<std::uint32_t, Piece> pieces; ///< by offset
        std::size_t kept = 0;                  ///< bytes of all pieces
        std::optional<std::uint32_t> size;     ///< known from the last fragment
        std::optional<Stamp> stamp;
    };

    Pending& pendingOf(const IpPacket& fragment, const Visitor& visit);
    static std::vector<std::byte> beginningOf(const Pending& pending);
    static bool isWhole(const Pending& pending);
    static void give(const Pending& pending, const Visitor& visit);

    std::list<Pending> m_pending; ///< oldest first
};

} // namespace posewire::log
