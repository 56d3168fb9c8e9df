// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/packet_queue.h"

namespace posewire::net {

bool PacketQueue::push(std::span<const std::byte> bytes, const log::SourceInfo& source,
                       log::Arrival arrival) {
    const std::lock_guard lock(m_mutex);
    if (m_bytes.size() + bytes.size() + m_entries.size() * sizeof(Entry) > m_byteLimit) {
        m_refused.fetch_add(1, std::memory_order_relaxed);
        return false;
    }
    m_bytes.insert(m_bytes.end(), bytes.begin(), bytes.end());
    m_entries.push_back({bytes.size(), source, arrival});
    m_count.store(m_entries.size(), std::memory_order_release);
    return true;
}

std::size_t PacketQueue::moveTo(log::PacketLog& log) {
    {
        const std::lock_guard lock(m_mutex);
        m_entries.swap(m_takenEntries);
        m_bytes.swap(m_takenBytes);
        m_count.store(0, std::memory_order_release);
    }
    std::span<const std::byte> bytes(m_takenBytes);
    for (Entry& entry : m_takenEntries) {
        entry.arrival.source = log.sources().intern(entry.source);
        log.writer().append(bytes.first(entry.size), entry.arrival);
        bytes = bytes.subspan(entry.size);
    }
    const std::size_t moved = m_takenEntries.size();
    m_takenEntries.clear();
    m_takenBytes.clear();
    log.writer().publish();
    return moved;
}

} // namespace posewire::net
