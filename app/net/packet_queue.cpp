// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/packet_queue.h"

namespace posewire::net {

bool PacketQueue::push(std::span<const std::byte> bytes, const log::SenderInfo& sender,
                       const log::Arrival& arrival) {
    {
        std::unique_lock lock(m_mutex);
        m_hasRoom.wait(lock, [&] { return m_isClosed || hasRoomFor(bytes.size()); });
        if (m_isClosed) {
            return false;
        }
        if (!m_lastSender || *m_lastSender != sender) {
            m_lastSender = std::make_shared<const log::SenderInfo>(sender);
        }
        m_bytes.insert(m_bytes.end(), bytes.begin(), bytes.end());
        m_entries.push_back({bytes.size(), m_lastSender, arrival});
        m_isEmpty.store(false, std::memory_order_release);
        if (m_entries.size() > 1 || !m_onFilled) {
            return true;
        }
    }
    m_onFilled();
    return true;
}

void PacketQueue::close() {
    {
        const std::lock_guard lock(m_mutex);
        m_isClosed = true;
    }
    m_hasRoom.notify_all();
}

/// An empty queue accepts a packet of any size, so that nobody waits forever.
bool PacketQueue::hasRoomFor(std::size_t bytes) const {
    return m_entries.empty() || m_bytes.size() + bytes + m_entries.size() * sizeof(Entry) <= m_byteLimit;
}

std::size_t PacketQueue::moveTo(log::PacketLog& log) {
    {
        const std::lock_guard lock(m_mutex);
        m_entries.swap(m_takenEntries);
        m_bytes.swap(m_takenBytes);
        m_isEmpty.store(true, std::memory_order_release);
    }
    m_hasRoom.notify_all();
    std::span<const std::byte> bytes(m_takenBytes);
    const log::SenderInfo* last = nullptr;
    log::SenderId id{};
    for (Entry& entry : m_takenEntries) {
        if (entry.sender.get() != last) {
            last = entry.sender.get();
            id = log.senders().intern(*last);
        }
        entry.arrival.sender = id;
        log.writer().append(bytes.first(entry.size), entry.arrival);
        bytes = bytes.subspan(entry.size);
    }
    log.writer().publish();
    const std::size_t moved = m_takenEntries.size();
    m_takenEntries.clear();
    m_takenBytes.clear();
    return moved;
}

} // namespace posewire::net
