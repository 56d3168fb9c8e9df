// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/packet_queue.h"

#include <algorithm>

namespace posewire::net {

namespace {

/// Losses of more senders than this at a time are booked to the last one.
constexpr std::size_t kMostLosses = 64;

} // namespace

bool PacketQueue::push(std::span<const std::byte> bytes, const log::SenderInfo& sender,
                       const log::Arrival& arrival) {
    bool isFirst = false;
    {
        const std::lock_guard lock(m_mutex);
        if (!hasRoomFor(bytes.size())) {
            remember(sender, arrival.stamp);
            return false;
        }
        isFirst = place(bytes, sender, arrival);
    }
    if (isFirst && m_onFilled) {
        m_onFilled();
    }
    return true;
}

bool PacketQueue::pushWaiting(std::span<const std::byte> bytes, const log::SenderInfo& sender,
                              const log::Arrival& arrival) {
    bool isFirst = false;
    {
        std::unique_lock lock(m_mutex);
        m_hasRoom.wait(lock, [&] { return m_isClosed || hasRoomFor(bytes.size()); });
        if (m_isClosed) {
            return false;
        }
        isFirst = place(bytes, sender, arrival);
    }
    if (isFirst && m_onFilled) {
        m_onFilled();
    }
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

/// True if the queue was empty.
bool PacketQueue::place(std::span<const std::byte> bytes, const log::SenderInfo& sender,
                        const log::Arrival& arrival) {
    if (!m_lastSender || *m_lastSender != sender) {
        m_lastSender = std::make_shared<const log::SenderInfo>(sender);
    }
    m_bytes.insert(m_bytes.end(), bytes.begin(), bytes.end());
    m_entries.push_back({bytes.size(), m_lastSender, arrival});
    m_isEmpty.store(false, std::memory_order_release);
    return m_entries.size() == 1;
}

void PacketQueue::remember(const log::SenderInfo& sender, log::Stamp stamp) {
    m_refused.fetch_add(1, std::memory_order_relaxed);
    const auto known = std::ranges::find(m_losses, sender, &Loss::sender);
    if (known != m_losses.end() || m_losses.size() == kMostLosses) {
        Loss& loss = known != m_losses.end() ? *known : m_losses.back();
        ++loss.count;
        loss.stamp = stamp;
        return;
    }
    m_losses.push_back({sender, stamp, 1});
}

std::size_t PacketQueue::moveTo(log::PacketLog& log) {
    {
        const std::lock_guard lock(m_mutex);
        m_entries.swap(m_takenEntries);
        m_bytes.swap(m_takenBytes);
        m_losses.swap(m_takenLosses);
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
    appendLosses(log);
    log.writer().publish();
    const std::size_t moved = m_takenEntries.size();
    m_takenEntries.clear();
    m_takenBytes.clear();
    return moved;
}

/// A queue that refused a packet is not empty, so losses are logged without waiting for another packet.
void PacketQueue::appendLosses(log::PacketLog& log) {
    for (const Loss& loss : m_takenLosses) {
        log::Arrival arrival;
        arrival.stamp = loss.stamp;
        arrival.sender = log.senders().intern(loss.sender);
        arrival.kernelDropsBefore = loss.count;
        arrival.flags.skipped = true;
        arrival.flags.isDropRecord = true;
        log.writer().append({}, arrival);
    }
    m_takenLosses.clear();
}

} // namespace posewire::net
