// SPDX-License-Identifier: MIT
#include "core/log/pcapng_writer.h"

#include "core/log/pcapng_block.h"
#include "core/log/recorded_origin.h"
#include "core/log/udp_frame.h"
#include "core/wire/header.h"

#include <algorithm>
#include <array>

namespace posewire::log {
namespace {

constexpr std::size_t kLongestText = 65'000; ///< the length of an option has 16 bits
constexpr std::uint16_t kRawIp = 101;        ///< LINKTYPE_RAW

/// At most so much of a text, cut between characters of UTF-8.
std::string_view clipped(std::string_view text) {
    std::size_t most = kLongestText;
    if (text.size() <= most) {
        return text;
    }
    while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xc0U) == 0x80U) {
        --most;
    }
    return text.substr(0, most);
}

/// What the headers can say about a sender.
struct Ends {
    IpEndpoint sender;
    IpEndpoint target;
};

/// The address a packet came to is not known, but that this computer sends to itself over loopback.
Ends endsOf(const SenderInfo& info) {
    const bool isNetwork = info.transport == Transport::Udp || info.transport == Transport::Tcp;
    const auto found = isNetwork ? parseIpEndpoint(info.address) : std::nullopt;
    Ends ends{found.value_or(IpEndpoint{}), {}};
    ends.target.address.isIpv6 = ends.sender.address.isIpv6;
    if (isLoopback(ends.sender.address)) {
        ends.target.address = ends.sender.address;
    }
    ends.target.port = info.localPort;
    return ends;
}

/// Whether headers alone would give back the packet.
bool isPlain(const RecordedOrigin& origin, const Packet& packet) {
    return origin == RecordedOrigin{} && wire::startsWithMagic(packet.bytes);
}

RecordedOrigin originOf(const Packet& packet, const SenderInfo& sender, const Ends& ends) {
    constexpr std::size_t ipv4Most = 65'507;
    const bool isMapped = !ends.sender.address.isIpv6 && packet.bytes.size() > ipv4Most;
    const bool isTold = !isMapped && endpointText(ends.sender) == sender.address;
    return {sender.transport, packet.flags, isTold ? std::nullopt : std::optional(sender.address)};
}

} // namespace

PcapngWriter::Result PcapngWriter::begin(const RecordingInfo& info) {
    PcapngBlock section(m_block, PcapngBlockType::SectionHeader);
    section.number(0x1a2b3c4d, 4);
    section.number(1, 2); // version 1.0
    section.number(0, 2);
    section.number(~std::uint64_t{0}, 8); // of a length that is not known
    section.option(PcapngOption::Hardware, clipped(info.hardware));
    section.option(PcapngOption::System, clipped(info.system));
    section.option(PcapngOption::Application, clipped(info.application));
    section.finish();
    if (auto result = write(); !result) {
        return result;
    }
    constexpr std::array<std::byte, 1> nanoseconds{std::byte{9}};
    PcapngBlock interface(m_block, PcapngBlockType::Interface);
    interface.number(kRawIp, 2);
    interface.number(0, 2);
    interface.number(0, 4); // packets are never cut
    interface.option(PcapngOption::InterfaceName, "posewire");
    interface.option(PcapngOption::InterfaceDescription,
                     "MXTP datagrams as received; IP and UDP headers are made up");
    interface.option(PcapngOption::StampResolution, nanoseconds);
    interface.finish();
    return write();
}

PcapngWriter::Result PcapngWriter::add(const Packet& packet, const SenderInfo& sender,
                                       std::span<const std::string> comments) {
    const Ends ends = endsOf(sender);
    m_frame.clear();
    appendUdpFrame(m_frame, ends.sender, ends.target, packet.bytes);
    const Stamp stamp = std::max(packet.stamp, Stamp());
    PcapngBlock block(m_block, PcapngBlockType::EnhancedPacket);
    block.number(0, 4);
    block.halves(static_cast<std::uint64_t>(nanosecondsOf(stamp)));
    block.number(m_frame.size(), 4);
    block.number(m_frame.size(), 4);
    block.padded(m_frame);
    const RecordedOrigin origin = originOf(packet, sender, ends);
    const bool isMistakable =
        std::ranges::any_of(comments, [](const std::string& text) { return parseOrigin(text).has_value(); });
    if (!isPlain(origin, packet) || isMistakable) {
        block.option(PcapngOption::Comment, clipped(originText(origin)));
    }
    for (const std::string& comment : comments) {
        block.option(PcapngOption::Comment, clipped(comment));
    }
    if (packet.kernelDropsBefore != 0) {
        block.option(PcapngOption::DropCount, std::uint64_t{packet.kernelDropsBefore});
    }
    block.finish();
    ++m_packets;
    m_kernelDrops += packet.kernelDropsBefore;
    m_firstStamp = std::min(m_firstStamp, stamp);
    m_lastStamp = std::max(m_lastStamp, stamp);
    return write();
}

PcapngWriter::Result PcapngWriter::finish() {
    const auto last = static_cast<std::uint64_t>(nanosecondsOf(m_lastStamp));
    const auto first = m_packets != 0 ? static_cast<std::uint64_t>(nanosecondsOf(m_firstStamp)) : last;
    const auto stamp = [](std::uint64_t value) { return value >> 32 | value << 32; }; // upper half first
    PcapngBlock block(m_block, PcapngBlockType::InterfaceStatistics);
    block.number(0, 4);
    block.halves(last);
    block.option(PcapngOption::StartTime, stamp(first));
    block.option(PcapngOption::EndTime, stamp(last));
    block.option(PcapngOption::Received, m_packets + m_kernelDrops);
    block.option(PcapngOption::DroppedBySystem, m_kernelDrops);
    block.option(PcapngOption::Delivered, m_packets);
    block.finish();
    return write();
}

PcapngWriter::Result PcapngWriter::write() {
    m_bytes += m_block.size();
    return m_sink.write(m_block);
}

} // namespace posewire::log
