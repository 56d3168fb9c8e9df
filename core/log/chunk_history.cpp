// SPDX-License-Identifier: MIT
#include "core/log/chunk_history.h"

#include <algorithm>

namespace posewire::log {

namespace {

constexpr std::size_t kSmallestChunk = std::size_t{256} << 10;
constexpr std::size_t kLargestChunk = std::size_t{1} << 30;

LogLimits sensible(LogLimits limits) {
    limits.chunkSize = std::clamp(limits.chunkSize, kSmallestChunk, kLargestChunk) & ~std::size_t{4095};
    limits.memoryCap = std::max(limits.memoryCap, 2 * limits.chunkSize);
    return limits;
}

} // namespace

ChunkHistory::ChunkHistory(LogLimits limits)
    : m_limits(sensible(limits)),
      m_chunkLimit(m_limits.memoryCap / m_limits.chunkSize),
      m_pool(std::make_shared<ChunkPool>(m_limits.chunkSize, m_chunkLimit)) {}

ChunkHistory::~ChunkHistory() {
    m_pool->close();
    if (m_preparer.joinable()) {
        m_preparer.join();
    }
}

std::shared_ptr<Chunk> ChunkHistory::beginChunk(std::uint64_t first) {
    std::vector<Held> dropped; // given back outside the lock
    {
        const std::lock_guard lock(m_mutex);
        while (m_chunks.size() >= m_chunkLimit) {
            dropped.push_back(std::move(m_chunks.front()));
            m_chunks.pop_front();
        }
    }
    dropped.clear();
    std::shared_ptr<Chunk> chunk = m_pool->take();
    if (!m_preparer.joinable()) {
        m_preparer = std::thread([pool = m_pool] { pool->keepReady(); });
    }
    const std::lock_guard lock(m_mutex);
    m_chunks.push_back({first, chunk});
    m_chunkCount.store(m_chunks.size(), std::memory_order_relaxed);
    m_begin.store(m_chunks.front().first, std::memory_order_release);
    m_version.fetch_add(1, std::memory_order_release);
    return chunk;
}

std::vector<ChunkHistory::Entry> ChunkHistory::entries() const {
    const std::lock_guard lock(m_mutex);
    std::vector<Entry> list;
    list.reserve(m_chunks.size());
    for (const Held& held : m_chunks) {
        list.push_back({held.first, held.chunk});
    }
    return list;
}

LogFigures ChunkHistory::figures() const {
    LogFigures figures;
    figures.end = end();
    figures.begin = std::min(begin(), figures.end);
    figures.memoryInUse = m_chunkCount.load(std::memory_order_relaxed) * m_limits.chunkSize;
    figures.memoryAllocated = m_pool->existing() * m_limits.chunkSize;
    figures.memoryCap = m_limits.memoryCap;
    return figures;
}

} // namespace posewire::log
