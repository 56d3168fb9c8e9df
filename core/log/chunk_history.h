// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/log/scratch.h"
#include "core/log/sender_table.h"
#include "core/log/time.h"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace posewire::log {

struct Record {
    const std::byte* data;
    Stamp stamp;
    std::uint32_t size;
    SenderId sender;
    std::uint32_t kernelDropsBefore;
    PacketFlags flags;
};
static_assert(sizeof(Record) == 32);

/// One piece of memory of the log: records grow from its front, packet bytes from its back, until they meet,
/// so that it is used up alike by many small and by few large packets. The writer fills it; readers see
/// records once published.
class Chunk {
public:
    /// Aligned like the pages that Linux may back it with: a chunk of 8 MiB then costs four page faults and
    /// not 2,048.
    static constexpr std::size_t kAlignment = std::size_t{2} << 20;

    explicit Chunk(std::size_t size);
    ~Chunk();
    Chunk(const Chunk&) = delete;
    Chunk& operator=(const Chunk&) = delete;

    /// Makes the system provide all of the memory now. The first touch of fresh memory costs more than
    /// everything else that is done with a packet.
    void touch();

    /// Forgets everything; the memory stays.
    void clear() {
        m_senders.clear();
        m_recordCount = 0;
        m_bytesBegin = m_size;
    }

    [[nodiscard]] std::size_t room() const { return m_bytesBegin - m_recordCount * sizeof(Record); }

    /// `size` bytes, 8-byte aligned. The caller has made sure of the room.
    [[nodiscard]] std::byte* take(std::size_t size) { return m_memory + (m_bytesBegin -= size); }

    void addRecord(const Record& record);

    /// Keeps the sender of a record for as long as the record, and gives up as much room as it takes.
    void hold(SenderTable::Held sender);

    [[nodiscard]] const Record& record(std::size_t index) const {
        return *reinterpret_cast<const Record*>(m_memory + index * sizeof(Record));
    }

private:
    std::byte* m_memory;
    std::size_t m_size;
    std::size_t m_recordCount = 0;
    std::size_t m_bytesBegin;
    std::vector<SenderTable::Held> m_senders;
};

/// Chunks without a holder, to be used again: memory stays flat, and its pages are there already.
/// While it still grows a thread gets the next chunk ready. Safe from any thread; a chunk may come back from
/// a reader's.
class ChunkPool : public std::enable_shared_from_this<ChunkPool> {
public:
    explicit ChunkPool(std::size_t chunkSize) : m_chunkSize(chunkSize) {}

    /// How many may be taken before others must come back: more are neither made ready nor kept.
    void setRoom(std::size_t chunks);

    /// An empty chunk, used or made ready before if there is one; comes back by itself with its last
    /// owner.
    [[nodiscard]] std::shared_ptr<Chunk> take();

    /// What the thread does: has a spare chunk ready whenever the last one was taken, as long as there is
    /// room. Returns after close().
    void keepReady();
    void close();

    /// Chunks that exist: in the log, held by readers, spare.
    [[nodiscard]] std::size_t existing() const;

private:
    void give(std::unique_ptr<Chunk> chunk);

    const std::size_t m_chunkSize;
    mutable std::mutex m_mutex; ///< guards all that follows
    std::condition_variable m_changed;
    std::vector<std::unique_ptr<Chunk>> m_spare;
    std::size_t m_room = 0;
    std::size_t m_existing = 0;
    bool m_isMakingSpare = false;
    bool m_isClosed = false;
};

/// What is kept of each packet beside its chunk as long as the log has it, at most: its place in the
/// StreamIndex, its model::PacketDigest, and a bit or two where a display filter finds it. The cap of the log
/// is for these too.
inline constexpr std::size_t kBesidePacket = 44;
/// What of that is in memory where the rest is in a scratch file.
inline constexpr std::size_t kBesidePacketInMemory = 4;

struct LogLimits {
    /// Bytes of chunks and of what is kept beside them. Two chunks are kept whatever it says, with half a
    /// chunk beside each.
    std::size_t memoryCap = std::size_t{512} << 20;
    std::size_t chunkSize = std::size_t{8} << 20; ///< bytes; at least 256 KiB
};

struct LogFigures {
    std::uint64_t begin = 0;     ///< number of the oldest packet kept: as many have been dropped from history
    std::uint64_t end = 0;       ///< one past the newest packet
    std::size_t chunkBytes = 0;  ///< of the chunks in the log
    std::size_t memoryInUse = 0; ///< the same and what is kept beside each packet
    std::size_t memoryAllocated = 0; ///< the same and what readers still hold and what is spare
    std::size_t memoryCap = 0;
};

/// The chunks of a log in order, shared between its writer and its readers. A lock once per chunk, none per
/// packet.
class ChunkHistory {
public:
    struct Entry {
        std::uint64_t first; ///< number of the first packet of the chunk
        DropSums drops;      ///< before that
        std::weak_ptr<const Chunk> chunk;
    };

    /// `scratch`: where what is kept beside packets lies.
    explicit ChunkHistory(LogLimits limits,
                          std::shared_ptr<const Scratch> scratch = std::make_shared<Scratch>());
    ~ChunkHistory();

    struct Begun {
        std::shared_ptr<Chunk> chunk;
        std::uint64_t end; ///< it may take the packets below this number
    };
    /// Writer: the next chunk, which begins at packet `first`, before which so much was dropped; the oldest
    /// ones go where the cap demands it.
    Begun beginChunk(std::uint64_t first, const DropSums& drops);

    /// Writer: readers now see all packets below `end`.
    void publish(std::uint64_t end) { m_end.store(end, std::memory_order_release); }

    [[nodiscard]] std::uint64_t end() const { return m_end.load(std::memory_order_acquire); }

    /// Grows with every change of the list of chunks. Read it after end(): then the list contains every
    /// packet below that.
    [[nodiscard]] std::uint64_t version() const { return m_version.load(std::memory_order_acquire); }
    [[nodiscard]] std::vector<Entry> entries() const;

    [[nodiscard]] const LogLimits& limits() const { return m_limits; }
    [[nodiscard]] LogFigures figures() const;

private:
    /// Bytes of memory that are kept beside each packet.
    [[nodiscard]] std::size_t besidePacket() const {
        return m_scratch->hasFile() ? kBesidePacketInMemory : kBesidePacket;
    }
    struct Held {
        std::uint64_t first;
        DropSums drops;
        std::shared_ptr<Chunk> chunk;
        operator Entry() const { return {first, drops, chunk}; }
    };

    /// What the cap leaves beside that many chunks and what is kept beside that many packets.
    [[nodiscard]] std::size_t left(std::size_t chunks, std::uint64_t packets) const;

    const LogLimits m_limits;
    const std::shared_ptr<const Scratch> m_scratch; ///< for what is kept beside packets
    const std::shared_ptr<ChunkPool> m_pool;
    mutable std::mutex m_mutex;
    std::deque<Held> m_chunks;
    std::atomic<std::uint64_t> m_version = 0;
    std::thread m_preparer;                           ///< gets the next chunk ready; begins with the first
    alignas(64) std::atomic<std::uint64_t> m_end = 0; // written with every batch: on a cache line of its own
};

} // namespace posewire::log
