// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/chunk.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace posewire::log {

struct LogLimits {
    std::size_t memoryCap = std::size_t{512} << 20; ///< bytes; at least two chunks are kept whatever it says
    std::size_t chunkSize = std::size_t{8} << 20;   ///< bytes; at least 256 KiB
};

/// What the log holds, in figures for display.
struct LogFigures {
    std::uint64_t begin = 0;     ///< number of the oldest packet kept: as many have been dropped from history
    std::uint64_t end = 0;       ///< one past the newest packet
    std::size_t memoryInUse = 0; ///< bytes of the chunks in the log
    std::size_t memoryAllocated = 0; ///< the same and what readers still hold and what is spare
    std::size_t memoryCap = 0;
};

/// The chunks of a log in order, shared between its writer and its readers. A lock once per chunk, none per
/// packet.
class ChunkHistory {
public:
    struct Entry {
        std::uint64_t first; ///< number of the first packet of the chunk
        std::weak_ptr<const Chunk> chunk;
    };

    explicit ChunkHistory(LogLimits limits);
    ~ChunkHistory();
    ChunkHistory(const ChunkHistory&) = delete;
    ChunkHistory& operator=(const ChunkHistory&) = delete;

    /// Writer: the next chunk, which begins at packet `first`; the oldest ones go where the cap demands it.
    std::shared_ptr<Chunk> beginChunk(std::uint64_t first);

    /// Writer: readers now see all packets below `end`.
    void publish(std::uint64_t end) { m_end.store(end, std::memory_order_release); }

    [[nodiscard]] std::uint64_t end() const { return m_end.load(std::memory_order_acquire); }
    [[nodiscard]] std::uint64_t begin() const { return m_begin.load(std::memory_order_acquire); }

    /// Grows with every change of the list of chunks. Read it after end(): then the list contains every
    /// packet below that.
    [[nodiscard]] std::uint64_t version() const { return m_version.load(std::memory_order_acquire); }
    [[nodiscard]] std::vector<Entry> entries() const;

    [[nodiscard]] const LogLimits& limits() const { return m_limits; }
    [[nodiscard]] LogFigures figures() const;

private:
    struct Held {
        std::uint64_t first;
        std::shared_ptr<Chunk> chunk;
    };

    const LogLimits m_limits;
    const std::size_t m_chunkLimit;
    const std::shared_ptr<ChunkPool> m_pool;
    mutable std::mutex m_mutex;
    std::deque<Held> m_chunks;
    std::atomic<std::size_t> m_chunkCount = 0;
    std::atomic<std::uint64_t> m_version = 0;
    std::atomic<std::uint64_t> m_begin = 0;
    std::thread m_preparer;                           ///< gets the next chunk ready; begins with the first
    alignas(64) std::atomic<std::uint64_t> m_end = 0; // written with every batch: on a cache line of its own
};

} // namespace posewire::log
