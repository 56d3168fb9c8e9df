// SPDX-License-Identifier: MIT
#include "core/log/chunk.h"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace posewire::log {

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
    if (chunk) {
        chunk->clear();
    } else {
        chunk = std::make_unique<Chunk>(m_chunkSize);
    }
    return {chunk.release(),
            [pool = shared_from_this()](Chunk* used) { pool->give(std::unique_ptr<Chunk>(used)); }};
}

void ChunkPool::keepReady() {
    std::unique_lock lock(m_mutex);
    while (true) {
        m_changed.wait(lock, [this] { return m_isClosed || needsSpare(); });
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
    const std::lock_guard lock(m_mutex);
    if (m_spare.size() < m_limit) {
        m_spare.push_back(std::move(chunk));
    } else {
        --m_existing;
    }
}

} // namespace posewire::log
