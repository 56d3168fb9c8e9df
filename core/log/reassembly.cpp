// SPDX-License-Identifier: MIT
#include "core/log/reassembly.h"

#include "core/wire/header.h"

#include <algorithm>
#include <utility>

namespace posewire::log {
namespace {

/// No IP packet is larger.
constexpr std::uint32_t kLargest = 65535;

bool belongTogether(const IpPacket& first, const IpPacket& second) {
    return first.identity == second.identity && first.protocol == second.protocol &&
           first.sender == second.sender && first.target == second.target;
}

/// What it costs to keep a segment, so that many small ones are few enough too.
std::size_t costOf(std::span<const std::byte> bytes) {
    constexpr std::size_t overhead = 128;
    return bytes.size() + overhead;
}

FileRecord recordOf(const IpPacket& packet, const UdpPayload& payload) {
    return {.offset = payload.offset,
            .bytes = payload.bytes,
            .time = packet.time,
            .sender = SenderInfo{endpointText({packet.sender, payload.sourcePort}), Transport::Udp,
                                 payload.targetPort},
            .isInOnePiece = packet.isInOnePiece};
}

} // namespace

void IpFragments::add(const IpPacket& fragment) {
    if (fragment.bytes.empty() || fragment.fragmentOffset + fragment.bytes.size() > kLargest) {
        return;
    }
    giveUpOld(fragment.time);
    Pending& pending = pendingOf(fragment);
    if (!fragment.hasMoreFragments) {
        pending.size = fragment.fragmentOffset + static_cast<std::uint32_t>(fragment.bytes.size());
    }
    // Fragments that overlap without end are nobody's honest packet.
    if (pending.kept + fragment.bytes.size() <= std::size_t{2} * kLargest) {
        auto& piece = pending.pieces[fragment.fragmentOffset];
        if (piece.empty() && fragment.fragmentOffset == 0) {
            pending.packet = fragment;
        }
        if (piece.size() < fragment.bytes.size()) { // cut into larger pieces on another path
            const auto more = fragment.bytes.subspan(piece.size());
            piece.insert(piece.end(), more.begin(), more.end());
            pending.kept += more.size();
        }
    }
    pending.packet.time = fragment.time;
    if (isWhole(pending)) {
        give(pending);
        std::erase_if(m_pending, [&](const Pending& one) { return &one == &pending; });
    }
}

void IpFragments::finish() {
    for (const Pending& pending : m_pending) {
        give(pending);
    }
    m_pending.clear();
}

void IpFragments::giveUpOld(std::optional<WallTime> now) {
    std::erase_if(m_pending, [&](const Pending& pending) {
        const bool isOld = now && pending.packet.time && *now - *pending.packet.time > kLongestWait;
        if (isOld) {
            give(pending);
        }
        return isOld;
    });
}

IpFragments::Pending& IpFragments::pendingOf(const IpPacket& fragment) {
    const auto found = std::ranges::find_if(
        m_pending, [&](const Pending& pending) { return belongTogether(pending.packet, fragment); });
    if (found != m_pending.end()) {
        return *found;
    }
    if (m_pending.size() == kMostPending) {
        give(m_pending.front());
        m_pending.pop_front();
    }
    return m_pending.emplace_back(Pending{fragment, {}, 0, {}});
}

bool IpFragments::isWhole(const Pending& pending) {
    std::size_t reached = 0;
    for (const auto& [offset, bytes] : pending.pieces) {
        if (offset > reached) {
            return false;
        }
        reached = std::max(reached, offset + bytes.size());
    }
    return pending.size && reached >= *pending.size;
}

/// As far as it goes without a hole; of bytes that came twice the first count.
void IpFragments::give(const Pending& pending) const {
    if (pending.pieces.empty() || pending.pieces.begin()->first != 0) {
        return;
    }
    std::vector<std::byte> bytes;
    for (const auto& [offset, piece] : pending.pieces) {
        if (offset > bytes.size()) {
            break;
        }
        const std::size_t known = bytes.size() - offset;
        if (known < piece.size()) {
            bytes.insert(bytes.end(), piece.begin() + static_cast<std::ptrdiff_t>(known), piece.end());
        }
    }
    IpPacket whole = pending.packet;
    whole.bytes = bytes;
    whole.isInOnePiece = false;
    m_visit(whole);
}

void TcpStream::add(const TcpSegment& segment) {
    if (segment.bytes.empty()) {
        return;
    }
    const auto ahead = static_cast<std::int32_t>(segment.sequence - m_expected);
    const auto farthest = static_cast<std::int32_t>(2 * kMostWaiting);
    if (ahead > farthest || ahead < -farthest) {
        restart(segment.sequence); // no window is so wide: another connection between the same ports
    } else if (ahead > 0) {
        keepWaiting(segment, m_expectedPosition + static_cast<std::uint32_t>(ahead));
        if (m_waitingSize > kMostWaiting || hasWaitedTooLong(segment)) {
            passOver();
        }
        return;
    }
    append(segment);
    appendWaiting(segment.time);
    if (hasWaitedTooLong(segment)) {
        passOver();
    }
}

void TcpStream::finish() {
    while (!m_waiting.empty()) {
        passOver();
    }
    endPart();
}

void TcpStream::restart(std::uint32_t firstSequence) {
    finish();
    m_expected = firstSequence;
}

void TcpStream::append(const TcpSegment& segment) {
    const std::size_t known = m_expected - segment.sequence;
    if (known >= segment.bytes.size()) {
        return;
    }
    const auto added = segment.bytes.subspan(known);
    m_places.push_back({m_given, segment.offset + known, segment.isInOnePiece});
    m_given += added.size();
    m_expected += static_cast<std::uint32_t>(added.size());
    m_expectedPosition += added.size();
    m_time = segment.time;
    m_framer.push(added, [this](const TcpFramer::Piece& piece) { visit(piece); });
    while (m_places.size() > 1 && m_places[1].position <= m_given - m_framer.kept()) {
        m_places.pop_front();
    }
}

/// Keeps what is new of a segment behind a gap; one that comes again may have grown.
void TcpStream::keepWaiting(TcpSegment segment, std::uint64_t position) {
    for (auto known = m_waiting.find(position); known != m_waiting.end(); known = m_waiting.find(position)) {
        const std::size_t size = known->second.bytes.size();
        if (size >= segment.bytes.size()) {
            return;
        }
        segment.bytes = segment.bytes.subspan(size);
        segment.offset += size;
        position += size;
    }
    m_waitingSize += costOf(segment.bytes);
    m_waiting.emplace(position, Waiting{{segment.bytes.begin(), segment.bytes.end()},
                                        segment.offset,
                                        segment.time,
                                        segment.isInOnePiece});
}

/// Hands on what has waited for the bytes before it. Without a time each keeps its own.
void TcpStream::appendWaiting(std::optional<WallTime> time) {
    while (!m_waiting.empty() && m_waiting.begin()->first <= m_expectedPosition) {
        const auto node = m_waiting.extract(m_waiting.begin());
        const Waiting& waiting = node.mapped();
        m_waitingSize -= costOf(waiting.bytes);
        const auto behind = static_cast<std::uint32_t>(m_expectedPosition - node.key());
        append({.sequence = m_expected - behind,
                .bytes = waiting.bytes,
                .offset = waiting.fileOffset,
                .time = time ? time : waiting.time,
                .isInOnePiece = waiting.isInOnePiece});
    }
}

/// Continues behind the gap.
void TcpStream::passOver() {
    endPart();
    const std::uint64_t position = m_waiting.begin()->first;
    m_expected += static_cast<std::uint32_t>(position - m_expectedPosition);
    m_expectedPosition = position;
    appendWaiting(std::nullopt);
}

/// What the framer has been given is all that there is before a gap or the end.
void TcpStream::endPart() {
    m_framer.finish([this](const TcpFramer::Piece& piece) { visit(piece); });
    m_places.clear();
    m_given = 0;
}

bool TcpStream::hasWaitedTooLong(const TcpSegment& segment) const {
    if (m_waiting.empty()) {
        return false;
    }
    const auto since = m_waiting.begin()->second.time;
    return since && segment.time && *segment.time - *since > kLongestWait;
}

void TcpStream::visit(const TcpFramer::Piece& piece) {
    while (m_places.size() > 1 && m_places[1].position <= piece.offset) {
        m_places.pop_front();
    }
    const Place& place = m_places.front();
    const std::uint64_t end = piece.offset + piece.bytes.size();
    m_visit({.offset = place.fileOffset + (piece.offset - place.position),
             .bytes = piece.bytes,
             .time = m_time,
             .sender = m_sender,
             .flags = {.skipped = piece.kind == TcpFramer::Kind::Skipped},
             .isInOnePiece = place.isInOnePiece && (m_places.size() == 1 || end <= m_places[1].position)});
}

void Reassembly::add(const CapturedFrame& frame) {
    ++m_contents.packets;
    const auto packet = ipPacketOf(frame);
    if (!isLinkTypeKnown(frame.linkType)) {
        m_contents.otherLink = m_contents.ofOtherLinks++ == 0 ? frame.linkType : m_contents.otherLink;
        return;
    }
    if (!packet || (packet->protocol != kUdp && packet->protocol != kTcp)) {
        ++m_contents.withoutIp;
        return;
    }
    ++(packet->protocol == kUdp ? m_contents.udp : m_contents.tcp);
    if (packet->isFragment()) {
        m_fragments.add(*packet);
    } else {
        addPacket(*packet);
    }
}

void Reassembly::addRecorded(const CapturedFrame& frame) {
    ++m_contents.packets;
    ++m_contents.udp;
    const auto packet = ipPacketOf(frame);
    if (const auto payload = packet ? udpPayloadOf(*packet) : std::nullopt) {
        m_visit(recordOf(*packet, *payload));
    }
}

void Reassembly::finish() {
    m_fragments.finish();
    for (auto& [direction, followed] : m_streams) {
        followed.stream.finish();
    }
    m_streams.clear();
}

void Reassembly::addPacket(const IpPacket& packet) {
    if (packet.protocol == kUdp) {
        addUdp(packet);
    } else {
        addTcp(packet);
    }
}

void Reassembly::addUdp(const IpPacket& packet) {
    const auto payload = udpPayloadOf(packet);
    if (!payload) {
        return;
    }
    if (wire::startsWithMagic(payload->bytes)) {
        m_ports.insert(payload->targetPort);
    } else if (!m_ports.contains(payload->targetPort)) {
        return;
    }
    m_visit(recordOf(packet, *payload));
}

void Reassembly::addTcp(const IpPacket& packet) {
    const auto segment = tcpSegmentOf(packet);
    if (!segment) {
        return;
    }
    const Direction direction{packet.sender, packet.target, segment->sourcePort, segment->targetPort};
    auto found = m_streams.find(direction);
    if (found == m_streams.end()) {
        const bool mayCarry =
            segment->targetPort == kDefaultPort && (segment->begins || !segment->bytes.empty());
        if (!mayCarry && !wire::startsDatagram(segment->bytes)) {
            return;
        }
        endOldest();
        SenderInfo sender{endpointText({packet.sender, segment->sourcePort}), Transport::Tcp,
                          segment->targetPort};
        Followed added{TcpStream(std::move(sender), segment->sequence, m_visit)};
        found = m_streams.emplace(direction, std::move(added)).first;
    } else if (segment->begins && found->second.stream.expected() != segment->sequence) {
        found->second.stream.restart(segment->sequence);
    }
    TcpStream& stream = found->second.stream;
    found->second.lastUse = ++m_uses;
    stream.add(*segment);
    const auto end = segment->sequence + static_cast<std::uint32_t>(segment->bytes.size());
    if (segment->ends && stream.expected() == end) {
        stream.finish();
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
    oldest->second.stream.finish();
    m_streams.erase(oldest);
}

} // namespace posewire::log
