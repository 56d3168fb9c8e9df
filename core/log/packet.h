// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace posewire::log {

/// Number of a SenderInfo in the SenderTable of the log.
enum class SenderId : std::uint32_t {};
/// For events of this computer, not of a sender.
inline constexpr SenderId kNoSender{UINT32_MAX};

enum class Transport : std::uint8_t { Udp, Tcp, File, Performer };

/// Their names in files and filters, in this order.
inline constexpr std::array<std::string_view, 4> kTransportNames{"udp", "tcp", "file", "performer"};
[[nodiscard]] constexpr std::string_view nameOf(Transport transport) {
    return kTransportNames[static_cast<std::size_t>(transport)];
}

/// A port of one computer, which counts the datagrams that it drops.
struct ReceivingPort {
    std::string probe; ///< that has it; empty for this computer
    std::uint16_t number = 0;

    friend bool operator==(const ReceivingPort&, const ReceivingPort&) = default;
};

/// The source of packets. Two packets have the same SenderId exactly if all members are equal.
struct SenderInfo {
    std::string address; ///< "127.0.0.1:40001", "[::1]:40001", a file name, the name of a performer
    Transport transport = Transport::Udp;
    std::uint16_t localPort = 0; ///< the port it arrived at; 0 if there is none
    /// The probe that received it; empty if this computer did. The same address at two probes is two senders,
    /// and drops of one computer explain no loss at another.
    std::string probe{};

    [[nodiscard]] ReceivingPort port() const { return {probe, localPort}; }
    /// The address, with the probe that hears it if there is one: "10.0.0.7:40001 at STAGE-A".
    [[nodiscard]] std::string place() const { return probe.empty() ? address : address + " at " + probe; }

    friend bool operator==(const SenderInfo&, const SenderInfo&) = default;
};

/// In two bytes: the log keeps them of every packet.
struct PacketFlags {
    bool truncated : 1 = false; ///< the datagram was longer than what could be received
    /// The stamp is the kernel's, else it was taken when the packet was read.
    bool stampedByKernel : 1 = false;
    bool skipped : 1 = false; ///< bytes of a byte stream that belong to no datagram
    /// Not a packet: it only records `kernelDropsBefore` where no packet followed that could carry it. It has
    /// no bytes and is `skipped`, so that readers that ignore what is no datagram ignore it too. Its sender
    /// is the last one that was received.
    bool isDropRecord : 1 = false;
    /// The first packet of a port that was not listened to for a while, for its input had been removed: what
    /// was sent meanwhile is missing for that.
    bool afterClosed : 1 = false;
    /// How many datagrams came in one packet, this one of them, each of which the log keeps as a packet of
    /// its own; at most kMostShared are counted. 0 if it came alone.
    std::uint8_t shared : 3 = 0;

    /// It came before its recording began, at whose front it is for what it says of a character: that it
    /// came, and when, is no part of the recording.
    bool isFromBefore : 1 = false;

    /// `kernelDropsBefore` were dropped by no computer: a probe had received them, and they did not come
    /// here.
    bool isLostOnWay : 1 = false;

    /// The computer that received it does not count what it drops on the socket: `kernelDropsBefore` says
    /// nothing.
    bool dropsUncounted : 1 = false;

    static constexpr std::uint8_t kMostShared = 7;

    friend bool operator==(const PacketFlags&, const PacketFlags&) = default;
};

/// All that is known about a packet when it arrives, besides its bytes.
struct Arrival {
    Stamp stamp{};
    SenderId sender{};
    /// Datagrams that this computer lost for want of room (SO_RXQ_OVFL) on the socket of this packet since
    /// the packet before it from that socket. Kept in the log so that a replay shows the same drops.
    std::uint32_t kernelDropsBefore = 0;
    PacketFlags flags{};
};

struct DropSums {
    std::uint64_t datagrams = 0; ///< the sum of kernelDropsBefore
    std::uint64_t records = 0;   ///< packets that are none, and only tell of that: PacketFlags::isDropRecord

    void add(std::uint32_t drops, PacketFlags flags) {
        datagrams += flags.isLostOnWay ? 0 : drops;
        records += flags.isDropRecord ? 1 : 0;
    }
    /// Datagrams that are missing with that many packets of the log, of which these are told: records are
    /// none.
    [[nodiscard]] std::uint64_t missingWith(std::uint64_t packets) const {
        return packets - std::min(packets, records) + datagrams;
    }
    friend bool operator==(const DropSums&, const DropSums&) = default;
};

/// A view of one packet of the log. How long `bytes` stays valid, the LogReader that gave it says.
struct Packet {
    std::uint64_t number = 0; ///< position in the log: always grows, without gaps, in the order of arrival
    Stamp stamp{};
    SenderId sender{};
    std::uint32_t kernelDropsBefore = 0; ///< see Arrival
    PacketFlags flags{};
    std::span<const std::byte> bytes;

    /// Datagrams dropped by the computer that received it.
    [[nodiscard]] constexpr std::uint32_t droppedBefore() const {
        return flags.isLostOnWay ? 0 : kernelDropsBefore;
    }
    /// Behind that many more.
    constexpr void addDrops(std::uint64_t more) {
        kernelDropsBefore +=
            static_cast<std::uint32_t>(std::min<std::uint64_t>(more, UINT32_MAX - kernelDropsBefore));
    }
};

} // namespace posewire::log
