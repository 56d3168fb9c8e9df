// SPDX-License-Identifier: MIT
#include "core/log/tcp_stream.h"

#include <utility>

namespace posewire::log {
namespace {

/// What it costs to keep a segment, so that many small ones are few enough too.
std::size_t costOf(std::span<const std::byte> bytes) {
    constexpr std::size_t overhead = 128;
    return bytes.size() + overhead;
}

} // namespace

TcpStream::TcpStream(SenderInfo sender, std::uint32_t firstSequence)
    : m_sender(std::move(sender)), m_expected(firstSequence) {}

void TcpStream::add(const TcpSegment& segment, const FileVisitor& visit) {
    if (segment.bytes.empty()) {
        return;
    }
    const auto ahead = static_cast<std::int32_t>(segment.sequence - m_expected);
    const auto farthest = static_cast<std::int32_t>(2 * kMostWaiting);
    if (ahead > farthest || ahead < -farthest) {
        restart(segment.sequence, visit); // no window is so wide: another connection between the same ports
    } else if (ahead > 0) {
        const auto [place, isNew] = m_waiting.try_emplace(
            m_expectedPosition + static_cast<std::uint32_t>(ahead),
            Waiting{{segment.bytes.begin(), segment.bytes.end()}, segment.fileOffset, segment.stamp});
        m_waitingSize += isNew ? costOf(segment.bytes) : 0;
        if (m_waitingSize > kMostWaiting || hasWaitedTooLong(segment)) {
            passOver(visit);
        }
        return;
    }
    append(segment, visit);
    appendWaiting(segment.stamp, visit);
    if (hasWaitedTooLong(segment)) {
        passOver(visit);
    }
}

void TcpStream::finish(const FileVisitor& visit) {
    while (!m_waiting.empty()) {
        passOver(visit);
    }
    m_framer.finish([&](const TcpFramer::Piece& piece) { visit(recordOf(piece, m_lastStamp)); });
    m_places.clear();
    m_given = 0;
}

void TcpStream::restart(std::uint32_t firstSequence, const FileVisitor& visit) {
    finish(visit);
    m_expected = firstSequence;
}

/// Hands on what is new of a segment that begins at the expected byte or before it.
void TcpStream::append(const TcpSegment& segment, const FileVisitor& visit) {
    const std::size_t known = m_expected - segment.sequence;
    if (known >= segment.bytes.size()) {
        return;
    }
    const auto bytes = segment.bytes.subspan(known);
    m_places.push_back({m_given, segment.fileOffset + known});
    m_given += bytes.size();
    m_expected += static_cast<std::uint32_t>(bytes.size());
    m_expectedPosition += bytes.size();
    m_lastStamp = segment.stamp;
    m_framer.push(bytes, [&](const TcpFramer::Piece& piece) { visit(recordOf(piece, segment.stamp)); });
    while (m_places.size() > 1 && m_places[1].position <= m_given - m_framer.kept()) {
        m_places.pop_front();
    }
}

/// Hands on what has waited for the bytes before it. Without a stamp each keeps its own.
void TcpStream::appendWaiting(std::optional<Stamp> stamp, const FileVisitor& visit) {
    while (!m_waiting.empty() && m_waiting.begin()->first <= m_expectedPosition) {
        const auto node = m_waiting.extract(m_waiting.begin());
        const Waiting& waiting = node.mapped();
        m_waitingSize -= costOf(waiting.bytes);
        const auto behind = static_cast<std::uint32_t>(m_expectedPosition - node.key());
        append({m_expected - behind, waiting.bytes, waiting.fileOffset, stamp ? stamp : waiting.stamp},
               visit);
    }
}

/// Goes on behind the gap.
void TcpStream::passOver(const FileVisitor& visit) {
    m_framer.finish([&](const TcpFramer::Piece& piece) { visit(recordOf(piece, m_lastStamp)); });
    m_places.clear();
    m_given = 0;
    const std::uint64_t position = m_waiting.begin()->first;
    m_expected += static_cast<std::uint32_t>(position - m_expectedPosition);
    m_expectedPosition = position;
    appendWaiting(std::nullopt, visit);
}

bool TcpStream::hasWaitedTooLong(const TcpSegment& segment) const {
    if (m_waiting.empty()) {
        return false;
    }
    const auto since = m_waiting.begin()->second.stamp;
    return since && segment.stamp && *segment.stamp - *since > kLongestWait;
}

FileRecord TcpStream::recordOf(const TcpFramer::Piece& piece, std::optional<Stamp> stamp) {
    while (m_places.size() > 1 && m_places[1].position <= piece.offset) {
        m_places.pop_front();
    }
    const Place& place = m_places.front();
    return {place.fileOffset + (piece.offset - place.position), piece.bytes,
            piece.kind == TcpFramer::Kind::Skipped, stamp, m_sender};
}

} // namespace posewire::log
