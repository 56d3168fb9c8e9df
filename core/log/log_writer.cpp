// SPDX-License-Identifier: MIT
#include "core/log/log_writer.h"

#include "core/log/shared_packet.h"

#include <algorithm>
#include <cstring>

namespace posewire::log {
namespace {

/// Below this many lanes a batch is no batch any more and a new chunk is the better way.
constexpr std::size_t kFewestLanes = 4;

constexpr std::size_t aligned(std::size_t size) {
    return (size + 7) & ~std::size_t{7};
}

/// The kernel is about to write there: having the memory come while other packets are looked at hides its
/// latency.
void prefetchForWriting(const std::byte* begin, std::size_t size) {
#if defined(__GNUC__)
    constexpr std::size_t kCacheLine = 64;
    for (std::size_t at = 0; at < size; at += kCacheLine) {
        __builtin_prefetch(begin + at, 1);
    }
#endif
}

} // namespace

LogWriter::LogWriter(ChunkHistory& history, const SenderTable& senders)
    : m_history(history),
      m_senders(senders),
      m_blockSize(std::clamp<std::size_t>(history.limits().chunkSize / 256, 4096, std::size_t{32} << 10)),
      m_spill(new std::byte[kLaneLimit * kSpillSize]) { // left as it is: its pages exist once a packet spills
    for (std::size_t i = 0; i < kLaneLimit; ++i) {
        m_lanes[i].spill = {m_spill.get() + i * kSpillSize, kSpillSize};
    }
}

std::span<const LogWriter::Lane> LogWriter::lanes() {
    if (!m_chunk || m_chunk != m_laneChunk) {
        openLanes();
    }
    for (std::size_t i = 0; i < m_laneCount;) {
        if (m_lanes[i].bytes.size() >= kLaneRoom || refill(i)) {
            ++i;
            continue;
        }
        // The chunk has no block left: this lane takes over what the last one has.
        m_lanes[i].bytes = m_lanes[--m_laneCount].bytes;
    }
    if (m_laneCount < kFewestLanes || !hasPlaceFor(m_laneCount)) {
        beginChunk();
        openLanes();
    }
    return std::span<const Lane>(m_lanes).first(m_laneCount);
}

void LogWriter::commit(std::size_t lane, std::size_t size, const Arrival& arrival) {
    const std::span<std::byte> bytes = m_lanes[lane].bytes;
    const bool isInLane = size <= bytes.size();
    if (isInLane && wire::firstDatagram(bytes.first(size)) != size) {
        append(bytes.first(size), arrival);
        return;
    }
    if (isInLane && m_chunk == m_laneChunk && hasPlaceFor(1)) {
        addRecord(bytes.data(), size, arrival);
        m_lanes[lane].bytes = bytes.subspan(std::min(aligned(size), bytes.size()));
        prefetchForWriting(m_lanes[lane].bytes.data(),
                           std::min({size, m_lanes[lane].bytes.size(), kLaneRoom}));
        return;
    }
    const std::size_t inLane = std::min(size, bytes.size());
    const std::size_t inSpill = std::min(size - inLane, kSpillSize);
    std::byte* copy = place(inLane + inSpill);
    std::memcpy(copy, bytes.data(), inLane);
    std::memcpy(copy + inLane, m_lanes[lane].spill.data(), inSpill);
    const std::span<const std::byte> whole(copy, inLane + inSpill);
    wire::firstDatagram(whole) == whole.size() ? addRecord(copy, whole.size(), arrival)
                                               : append(whole, arrival);
}

void LogWriter::append(std::span<const std::byte> bytes, const Arrival& arrival) {
    forEachDatagram(bytes, arrival.flags, [&](std::size_t from, std::size_t size, PacketFlags flags) {
        Arrival own = arrival;
        own.flags = flags;
        own.kernelDropsBefore = from == 0 ? arrival.kernelDropsBefore : 0;
        appendOne(bytes.subspan(from, size), own);
    });
}

void LogWriter::appendOne(std::span<const std::byte> bytes, const Arrival& arrival) {
    // What is longer than a chunk can hold cannot be a datagram; its beginning is kept.
    const std::size_t most = m_history.limits().chunkSize - sizeof(Record);
    Arrival kept = arrival;
    kept.flags.truncated |= bytes.size() > most;
    const std::span<const std::byte> head = bytes.first(std::min(bytes.size(), most));
    std::byte* copy = place(head.size());
    if (!head.empty()) {
        std::memcpy(copy, head.data(), head.size());
    }
    addRecord(copy, head.size(), kept);
}

void LogWriter::openLanes() {
    if (!m_chunk) {
        beginChunk();
    }
    m_laneChunk = m_chunk;
    m_laneCount = 0;
    while (m_laneCount < kLaneLimit && refill(m_laneCount)) {
        ++m_laneCount;
    }
}

bool LogWriter::refill(std::size_t lane) {
    // Every block is worth some records, for which there must be room as well.
    const std::size_t records = kLaneLimit * sizeof(Record);
    if (m_chunk->room() < m_blockSize + records) {
        return false;
    }
    m_lanes[lane].bytes = {m_chunk->take(m_blockSize), m_blockSize};
    return true;
}

std::byte* LogWriter::place(std::size_t size) {
    if (!m_chunk || m_chunk->room() < aligned(size) + sizeof(Record) || m_next == m_chunkEnd) {
        beginChunk();
    }
    return m_chunk->take(aligned(size));
}

void LogWriter::addRecord(const std::byte* data, std::size_t size, const Arrival& arrival) {
    m_chunk->addRecord({data, arrival.stamp, static_cast<std::uint32_t>(size), arrival.sender,
                        arrival.kernelDropsBefore, arrival.flags});
    ++m_next;
    m_drops.add(arrival.kernelDropsBefore, arrival.flags);
    Noted& noted = m_noted[static_cast<std::uint32_t>(arrival.sender) % m_noted.size()];
    if (noted.sender != arrival.sender || noted.chunk != m_chunkCount) {
        noted = {arrival.sender, m_chunkCount};
        holdSender(arrival.sender);
    }
}

void LogWriter::beginChunk() {
    ChunkHistory::Begun begun = m_history.beginChunk(m_next, m_drops);
    m_chunk = std::move(begun.chunk);
    m_chunkEnd = begun.end;
    ++m_chunkCount;
    m_heldSenders.clear();
}

void LogWriter::holdSender(SenderId sender) {
    if (!m_heldSenders.insert(sender).second) {
        return;
    }
    if (auto held = m_senders.find(sender)) {
        m_chunk->hold(std::move(held));
    }
}

} // namespace posewire::log
