// SPDX-License-Identifier: MIT
#include "core/log/reassembly.h"

#include "core/log/ip_endpoint.h"
#include "core/log/udp_payload.h"
#include "core/wire/byte_order.h"
#include "core/wire/header.h"

#include <algorithm>

namespace posewire::log {
namespace {

/// The header of a TCP segment (RFC 9293 section 3.1).
struct TcpHeader {
    std::uint16_t sourcePort = 0;
    std::uint16_t targetPort = 0;
    std::uint32_t sequence = 0;
    std::size_t size = 0;
    bool begins = false; ///< SYN
    bool ends = false;   ///< FIN or RST
};

std::optional<TcpHeader> tcpHeaderOf(std::span<const std::byte> segment) {
    if (segment.size() < 20) {
        return std::nullopt;
    }
    const auto flags = std::to_integer<unsigned>(segment[13]);
    const std::size_t size = std::to_integer<std::size_t>(segment[12] >> 4) * 4;
    if (size < 20 || size > segment.size()) {
        return std::nullopt;
    }
    return TcpHeader{wire::load16(segment.data()),
                     wire::load16(segment.data() + 2),
                     wire::load32(segment.data() + 4),
                     size,
                     (flags & 2U) != 0,
                     (flags & 5U) != 0};
}

FileRecord recordOf(const WholePacket& whole, const UdpPayload& payload) {
    return {whole.fileOffset + payload.offset, payload.bytes, false, whole.stamp,
            SenderInfo{endpointText({whole.packet.sender, payload.sourcePort}), Transport::Udp,
                       payload.targetPort}};
}

} // namespace

void Reassembly::add(const CapturedFrame& frame) {
    const auto packet = ipPacketOf(frame.linkType, frame.bytes);
    if (!packet || (packet->protocol != kUdp && packet->protocol != kTcp)) {
        return;
    }
    const std::uint64_t offset = frame.offset + packet->offset;
    if (packet->isFragment()) {
        m_fragments.add(*packet, offset, frame.stamp, [&](const WholePacket& whole) { addPacket(whole); });
    } else {
        addPacket({*packet, packet->bytes, offset, frame.stamp});
    }
}

void Reassembly::addRecorded(const CapturedFrame& frame) {
    const auto packet = ipPacketOf(frame.linkType, frame.bytes);
    const auto payload = packet ? udpPayloadOf(*packet, packet->bytes) : std::nullopt;
    if (payload) {
        m_visit(recordOf({*packet, packet->bytes, frame.offset + packet->offset, frame.stamp}, *payload));
    }
}

void Reassembly::finish() {
    m_fragments.finish([&](const WholePacket& whole) { addPacket(whole); });
    for (auto& [direction, followed] : m_streams) {
        followed.stream->finish(m_visit);
    }
    m_streams.clear();
}

void Reassembly::addPacket(const WholePacket& whole) {
    if (whole.packet.protocol == kUdp) {
        addUdp(whole);
    } else {
        addTcp(whole);
    }
}

void Reassembly::addUdp(const WholePacket& whole) {
    const auto payload = udpPayloadOf(whole.packet, whole.bytes);
    if (!payload) {
        return;
    }
    if (wire::startsWithMagic(payload->bytes)) {
        m_ports.insert(payload->targetPort);
    } else if (!m_ports.contains(payload->targetPort)) {
        return;
    }
    m_visit(recordOf(whole, *payload));
}

void Reassembly::addTcp(const WholePacket& whole) {
    const auto header = tcpHeaderOf(whole.bytes);
    if (!header) {
        return;
    }
    const auto bytes = whole.bytes.subspan(header->size);
    const std::uint32_t sequence = header->sequence + (header->begins ? 1U : 0U);
    const Direction direction{whole.packet.sender, whole.packet.target, header->sourcePort,
                              header->targetPort};
    auto found = m_streams.find(direction);
    if (found == m_streams.end()) {
        const bool mayCarry = header->targetPort == kDefaultPort && (header->begins || !bytes.empty());
        if (!mayCarry && !wire::startsDatagram(bytes)) {
            return;
        }
        endOldest();
        SenderInfo sender{endpointText({direction.sender, direction.sourcePort}), Transport::Tcp,
                          direction.targetPort};
        Followed added{std::make_unique<TcpStream>(std::move(sender), sequence), 0};
        found = m_streams.emplace(direction, std::move(added)).first;
    } else if (header->begins && found->second.stream->expected() != sequence) {
        found->second.stream->restart(sequence, m_visit);
    }
    TcpStream& stream = *found->second.stream;
    found->second.lastUse = ++m_uses;
    stream.add({sequence, bytes, whole.fileOffset + header->size, whole.stamp}, m_visit);
    if (header->ends && stream.expected() == sequence + static_cast<std::uint32_t>(bytes.size())) {
        stream.finish(m_visit);
        m_streams.erase(found);
    }
}

/// Makes room for one more stream.
void Reassembly::endOldest() {
    if (m_streams.size() < kMostStreams) {
        return;
    }
    const auto oldest =
        std::ranges::min_element(m_streams, {}, [](const auto& entry) { return entry.second.lastUse; });
    oldest->second.stream->finish(m_visit);
    m_streams.erase(oldest);
}

} // namespace posewire::log
