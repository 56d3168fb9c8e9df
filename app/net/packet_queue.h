// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/packet_log.h"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace posewire::net {

/// Packets from other threads (TCP connections, files, a performer) for the one thread that writes the log.
/// Bounded to what can be appended without keeping sockets waiting.
class PacketQueue {
public:
    static constexpr std::size_t kByteLimit = std::size_t{4} << 20;

    /// The pushing thread calls `onFilled` whenever the queue stops being empty.
    explicit PacketQueue(std::function<void()> onFilled = {}, std::size_t byteLimit = kByteLimit)
        : m_onFilled(std::move(onFilled)), m_byteLimit(byteLimit) {}

    /// Waits for room. `arrival.sender` is set when the packet reaches the log. False once the queue is
    /// closed. From any thread.
    bool push(std::span<const std::byte> bytes, const log::SenderInfo& sender, const log::Arrival& arrival);

    /// The queue is no longer emptied: releases those who wait.
    void close();

    /// Appends everything to the log and publishes it; returns the number of packets. Only from the log's
    /// writing thread.
    std::size_t moveTo(log::PacketLog& log);

    [[nodiscard]] bool isEmpty() const { return m_isEmpty.load(std::memory_order_acquire); }

private:
    using Sender = std::shared_ptr<const log::SenderInfo>;
    struct Entry {
        std::size_t size;
        Sender sender; ///< shared, since packets arrive in runs from one sender
        log::Arrival arrival;
    };
    [[nodiscard]] bool hasRoomFor(std::size_t bytes) const;

    const std::function<void()> m_onFilled;
    const std::size_t m_byteLimit;
    std::mutex m_mutex; ///< guards all members that are neither atomic nor taken
    std::condition_variable m_hasRoom;
    std::vector<Entry> m_entries;
    std::vector<std::byte> m_bytes;
    Sender m_lastSender;
    bool m_isClosed = false;
    std::vector<Entry> m_takenEntries; ///< swapped with the above, so that both keep their memory
    std::vector<std::byte> m_takenBytes;
    std::atomic<bool> m_isEmpty = true;
};

} // namespace posewire::net
