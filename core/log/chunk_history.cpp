// SPDX-License-Identifier: MIT
#include "core/log/chunk_history.h"

#include <algorithm>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace posewire::log {
namespace {

constexpr std::size_t kSmallestChunk = std::size_t{256} << 10;
constexpr std::size_t kLargestChunk = std::size_t{1} << 30;
/// Bytes that a sender takes in the table and in a chunk, about.
constexpr std::size_t kSenderCost = 256;

LogLimits sensible(LogLimits limits) {
    limits.chunkSize = std::clamp(limits.chunkSize, kSmallestChunk, kLargestChunk) & ~std::size_t{4095};
    limits.memoryCap = std::max(limits.memoryCap, 2 * limits.chunkSize);
    return limits;
}

} // namespace

Chunk::Chunk(std::size_t size)
    : m_memory(static_cast<std::byte*>(::operator new (size, std::align_val_t{kAlignment}))),
      m_size(size),
      m_bytesBegin(size) {
#ifdef __linux__
    ::madvise(m_memory, size, MADV_HUGEPAGE); // a hint: where it is refused, ordinary pages do
#endif
}

Chunk::~Chunk() {
    ::operator delete (m_memory, std::align_val_t{kAlignment});
}

void Chunk::addRecord(const Record& record) {
    ::new (m_memory + m_recordCount * sizeof(Record)) Record(record);
    ++m_recordCount;
}

void Chunk::hold(SenderTable::Held sender) {
    m_senders.push_back(std::move(sender));
    m_bytesBegin -= std::min(kSenderCost, room());
}

void Chunk::touch() {
    constexpr std::size_t kPage = 4096;
    for (std::size_t at = 0; at < m_size; at += kPage) {
        *const_cast<volatile std::byte*>(m_memory + at) = std::byte{0};
    }
}

std::shared_ptr<Chunk> ChunkPool::take() {
    std::unique_ptr<Chunk> chunk;
    {
        std::unique_lock lock(m_mutex);
        m_changed.wait(lock, [this] { return !m_spare.empty() || !m_isMakingSpare || m_existing < m_limit; });
        if (m_spare.empty()) {
            ++m_existing;
        } else {
            chunk = std::move(m_spare.back());
            m_spare.pop_back();
        }
    }
    m_changed.notify_all();
    if (!chunk) {
        chunk = std::make_unique<Chunk>(m_chunkSize);
    }
    return {chunk.release(),
            [pool = shared_from_this()](Chunk* used) { pool->give(std::unique_ptr<Chunk>(used)); }};
}

void ChunkPool::keepReady() {
    std::unique_lock lock(m_mutex);
    while (true) {
        m_changed.wait(lock, [this] { return m_isClosed || (m_spare.empty() && m_existing + 1 < m_limit); });
        if (m_isClosed) {
            return;
        }
        m_isMakingSpare = true;
        ++m_existing;
        lock.unlock();
        auto chunk = std::make_unique<Chunk>(m_chunkSize);
        chunk->touch();
        lock.lock();
        m_spare.push_back(std::move(chunk));
        m_isMakingSpare = false;
        m_changed.notify_all();
    }
}

void ChunkPool::close() {
    {
        const std::lock_guard lock(m_mutex);
        m_isClosed = true;
    }
    m_changed.notify_all();
}

std::size_t ChunkPool::existing() const {
    const std::lock_guard lock(m_mutex);
    return m_existing;
}

void ChunkPool::give(std::unique_ptr<Chunk> chunk) {
    chunk->clear(); // here, so that the receiving thread need not let go of the senders
    const std::lock_guard lock(m_mutex);
    if (m_spare.size() < m_limit) {
        m_spare.push_back(std::move(chunk));
    } else {
        --m_existing;
    }
}

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
    figures.memoryAllocated = m_pool->existing() * m_limits.chunkSize;
    figures.memoryCap = m_limits.memoryCap;
    const std::lock_guard lock(m_mutex);
    figures.end = end();
    figures.begin = m_chunks.empty() ? 0 : std::min(m_chunks.front().first, figures.end);
    figures.memoryInUse = m_chunks.size() * m_limits.chunkSize;
    return figures;
}

} // namespace posewire::log
