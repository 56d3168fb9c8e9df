// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/ip_fragments.h"
#include "core/log/tcp_stream.h"
#include "core/log/time.h"

#include <memory>
#include <set>

namespace posewire::log {

/// A captured frame and where it is in the file.
struct CapturedFrame {
    std::uint32_t linkType = 0;
    std::span<const std::byte> bytes;
    std::uint64_t offset = 0;
    std::optional<Stamp> stamp;
};

/// Finds what a listener for MXTP would have received in captured frames: one datagram to a UDP packet, which
/// IP may have sent in fragments, or back to back on TCP. A UDP packet counts if it begins with "MXTP"; any
/// other one is foreign if it goes to port 9763 or to one that has carried MXTP, and else none of ours. A TCP
/// stream counts if it goes to port 9763 or one of its segments begins a datagram. Memory is bounded: by
/// IpFragments, and by kMostStreams.
class Reassembly {
public:
    /// At most this many TCP streams are followed at a time; the one that was silent longest is ended first.
    static constexpr std::size_t kMostStreams = 64;

    explicit Reassembly(const FileVisitor& visit) : m_visit(visit) {}

    void add(const CapturedFrame& frame);
    /// A frame of a recording: a UDP packet that carries whatever was received.
    void addRecorded(const CapturedFrame& frame);
    /// The capture has ended: what is incomplete comes out.
    void finish();

private:
    static constexpr std::uint16_t kDefaultPort = 9763;
    /// One direction of a connection.
    struct Direction {
        IpAddress sender;
        IpAddress target;
        std::uint16_t sourcePort = 0;
        std::uint16_t targetPort = 0;
        friend auto operator<=>(const Direction&, const Direction&) = default;
    };
    struct Followed {
        std::unique_ptr<TcpStream> stream;
        std::uint64_t lastUse = 0;
    };

    void addPacket(const WholePacket& whole);
    void addUdp(const WholePacket& whole);
    void addTcp(const WholePacket& whole);
    void endOldest();

    const FileVisitor& m_visit;
    IpFragments m_fragments;
    std::map<Direction, Followed> m_streams;
    std::set<std::uint16_t> m_ports{kDefaultPort}; ///< UDP ports where other datagrams are foreign
    std::uint64_t m_uses = 0;
};

} // namespace posewire::log
