// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/chunk_history.h"
#include "core/log/sender_table.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_set>

namespace posewire::log {

/// The writing end of a PacketLog. One thread at a time.
///
/// Whoever can have the kernel place packets asks for lanes(), has packets written into them, one packet a
/// lane, calls commit() for those that came and publish() once for all. Whoever has a packet already calls
/// append() and publish(). No lock and no allocation per packet.
class LogWriter {
public:
    /// Few: the kernel writes to that many places in turn, and more than the processor can prefetch cost more
    /// than the system calls they save.
    static constexpr std::size_t kLaneLimit = 8;
    /// A lane has at least this much room; the largest legal datagram, 67 items of type 02, has 2,168 bytes.
    static constexpr std::size_t kLaneRoom = 2304;
    /// Room for what does not fit into a lane: a lane and its spill take any datagram of UDP.
    static constexpr std::size_t kSpillSize = std::size_t{64} << 10;

    /// Where one packet can be written: first into `bytes`, then on into `spill` (which costs a copy in
    /// commit).
    struct Lane {
        std::span<std::byte> bytes;
        std::span<std::byte> spill;
    };

    /// Arrivals name their senders as the table numbers them.
    LogWriter(ChunkHistory& history, const SenderTable& senders);
    LogWriter(const LogWriter&) = delete;
    LogWriter& operator=(const LogWriter&) = delete;

    /// At least one lane and at most kLaneLimit. The result and what is written there last until the next
    /// call of lanes() or append().
    std::span<const Lane> lanes();

    /// The packet of `size` bytes in `lane` joins the log, as several if it holds several datagrams. A lane
    /// can be committed once; lanes may be left out.
    void commit(std::size_t lane, std::size_t size, const Arrival& arrival);

    /// Copies a packet into the log, likewise.
    void append(std::span<const std::byte> bytes, const Arrival& arrival);

    /// Readers now see everything committed and appended so far.
    void publish() { m_history.publish(m_next); }

private:
    void openLanes();
    bool refill(std::size_t lane);
    /// True if that many more records have their place in the chunk.
    [[nodiscard]] bool hasPlaceFor(std::size_t records) const {
        return m_chunk->room() >= records * sizeof(Record) && m_next + records <= m_chunkEnd;
    }
    std::byte* place(std::size_t size);
    void appendOne(std::span<const std::byte> bytes, const Arrival& arrival);
    void addRecord(const std::byte* data, std::size_t size, const Arrival& arrival);
    void beginChunk();
    /// The chunk keeps the sender.
    void holdSender(SenderId sender);

    ChunkHistory& m_history;
    const SenderTable& m_senders;
    const std::size_t m_blockSize;
    std::shared_ptr<Chunk> m_chunk;
    std::uint64_t m_chunkEnd = 0; ///< it takes the packets below this number
    std::shared_ptr<Chunk>
        m_laneChunk; ///< where the lanes lie: differs from m_chunk only while a batch is cut in two
    std::uint64_t m_next = 0;
    DropSums m_drops;               ///< before m_next
    std::uint64_t m_chunkCount = 0; ///< begun so far
    /// Senders that the chunk keeps, and the last of each place with its chunk, so that most packets need no
    /// more than a comparison.
    std::unordered_set<SenderId> m_heldSenders;
    struct Noted {
        SenderId sender{};
        std::uint64_t chunk = 0;
    };
    std::array<Noted, 64> m_noted{};
    std::size_t m_laneCount = 0;
    std::array<Lane, kLaneLimit> m_lanes{};
    std::unique_ptr<std::byte[]> m_spill;
};

} // namespace posewire::log
