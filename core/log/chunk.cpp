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

std::shared_ptr<Chunk> ChunkPool::take() {
    std::unique_ptr<Chunk> chunk;
    {
        const std::lock_guard lock(m_mutex);
        if (!m_spare.empty()) {
            chunk = std::move(m_spare.back());
            m_spare.pop_back();
        }
    }
    if (chunk) {
        chunk->clear();
    } else {
        chunk = std::make_unique<Chunk>(m_chunkSize);
        m_existing.fetch_add(1, std::memory_order_relaxed);
    }
    return {chunk.release(),
            [pool = shared_from_this()](Chunk* used) { pool->give(std::unique_ptr<Chunk>(used)); }};
}

void ChunkPool::give(std::unique_ptr<Chunk> chunk) {
    const std::lock_guard lock(m_mutex);
    if (m_spare.size() < m_spareLimit) {
        m_spare.push_back(std::move(chunk));
    } else {
        m_existing.fetch_sub(1, std::memory_order_relaxed);
    }
}

} // namespace posewire::log
