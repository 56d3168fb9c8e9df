// SPDX-License-Identifier: MIT
#include "core/log/chunk_history.h"

#include "core/log/system_memory.h"

#include <algorithm>
#include <new>

namespace posewire::log {
namespace {

constexpr std::size_t kSmallestChunk = std::size_t{256} << 10;
constexpr std::size_t kLargestChunk = std::size_t{1} << 30;
/// Bytes that a sender takes in the table and in a chunk, about.
constexpr std::size_t kSenderCost = 256;

LogLimits sensible(LogLimits limits) {
    limits.chunkSize = std::clamp(limits.chunkSize, kSmallestChunk, kLargestChunk) & ~std::size_t{4095};
    limits.memoryCap = std::max(limits.memoryCap, 3 * limits.chunkSize);
    return limits;
}

} // namespace

Chunk::Chunk(std::size_t size)
    : m_memory(static_cast<std::byte*>(::operator new (size, std::align_val_t{kAlignment}))),
      m_size(size),
      m_bytesBegin(size) {
    useLargePages(m_memory, size);
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

void ChunkPool::setRoom(std::size_t chunks) {
    std::vector<std::unique_ptr<Chunk>> freed; // outside the lock
    const std::lock_guard lock(m_mutex);
    m_room = chunks;
    for (; m_spare.size() > m_room; --m_existing) {
        freed.push_back(std::move(m_spare.back()));
        m_spare.pop_back();
    }
}

std::shared_ptr<Chunk> ChunkPool::take() {
    std::unique_ptr<Chunk> chunk;
    {
        std::unique_lock lock(m_mutex);
        m_changed.wait(lock, [this] { return !m_spare.empty() || !m_isMakingSpare || m_room > 1; });
        m_room -= std::min<std::size_t>(m_room, 1);
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
        m_changed.wait(lock, [this] { return m_isClosed || (m_spare.empty() && m_room > 0); });
        if (m_isClosed) {
            return;
        }
        m_isMakingSpare = true;
        ++m_existing;
        lock.unlock();
        auto chunk = std::make_unique<Chunk>(m_chunkSize);
        chunk->touch();
        lock.lock();
        if (m_spare.size() < m_room) {
            m_spare.push_back(std::move(chunk));
        } else {
            --m_existing;
        }
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
    if (m_spare.size() < m_room) {
        m_spare.push_back(std::move(chunk));
    } else {
        --m_existing;
    }
}

ChunkHistory::ChunkHistory(LogLimits limits, std::shared_ptr<const Scratch> scratch)
    : m_limits(sensible(limits)),
      m_scratch(std::move(scratch)),
      m_pool(std::make_shared<ChunkPool>(m_limits.chunkSize)) {}

ChunkHistory::~ChunkHistory() {
    m_pool->close();
    if (m_preparer.joinable()) {
        m_preparer.join();
    }
}

std::size_t ChunkHistory::left(std::size_t chunks, std::uint64_t packets) const {
    const std::size_t used = chunks * m_limits.chunkSize + packets * besidePacket();
    return m_limits.memoryCap - std::min(m_limits.memoryCap, used);
}

/// How many packets the chunk will take is not known: so much is left for them that it seldom ends early, and
/// it ends where the cap would be passed.
ChunkHistory::Begun ChunkHistory::beginChunk(std::uint64_t first, const DropSums& drops) {
    const std::size_t mostBeside = left(2, 0) / 2;
    std::vector<Held> dropped; // given back outside the lock
    std::size_t chunks = 0;
    std::uint64_t packets = 0;
    std::size_t beside = 0;
    {
        const std::lock_guard lock(m_mutex);
        const auto kept = [&] { return m_chunks.empty() ? 0 : first - m_chunks.front().first; };
        const std::uint64_t newest = m_chunks.empty() ? 0 : first - m_chunks.back().first;
        beside = std::clamp((newest + newest / 4) * besidePacket(), mostBeside / 64, mostBeside);
        while (!m_chunks.empty() && left(m_chunks.size() + 1, kept()) < beside) {
            dropped.push_back(std::move(m_chunks.front()));
            m_chunks.pop_front();
        }
        chunks = m_chunks.size() + 1;
        packets = kept();
    }
    const std::size_t rest = left(chunks, packets);
    m_pool->setRoom(1 + (rest - std::min(rest, beside)) / m_limits.chunkSize);
    dropped.clear();
    std::shared_ptr<Chunk> chunk = m_pool->take();
    if (!m_preparer.joinable()) {
        m_preparer = std::thread([pool = m_pool] { pool->keepReady(); });
    }
    const std::lock_guard lock(m_mutex);
    m_chunks.push_back({first, drops, chunk});
    m_version.fetch_add(1, std::memory_order_release);
    return {std::move(chunk), first + std::min(rest, mostBeside) / besidePacket()};
}

std::vector<ChunkHistory::Entry> ChunkHistory::entries() const {
    const std::lock_guard lock(m_mutex);
    return {m_chunks.begin(), m_chunks.end()};
}

LogFigures ChunkHistory::figures() const {
    LogFigures figures;
    const std::size_t allocated = m_pool->existing() * m_limits.chunkSize;
    figures.memoryCap = m_limits.memoryCap;
    const std::lock_guard lock(m_mutex);
    figures.end = end();
    figures.begin = m_chunks.empty() ? 0 : std::min(m_chunks.front().first, figures.end);
    const std::size_t beside = (figures.end - figures.begin) * besidePacket();
    figures.chunkBytes = m_chunks.size() * m_limits.chunkSize;
    figures.memoryInUse = figures.chunkBytes + beside;
    figures.memoryAllocated = allocated + beside;
    return figures;
}

} // namespace posewire::log
