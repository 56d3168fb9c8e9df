// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/packet_log.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace posewire::net {

/// Packets that other threads have for the one thread that writes the log: from TCP connections, from the
/// performer. Bounded: what does not fit is refused, and counted.
class PacketQueue {
public:
    explicit PacketQueue(std::size_t byteLimit = std::size_t{64} << 20) : m_byteLimit(byteLimit) {}

    /// False where the queue is full. `arrival.source` is set when the packet reaches the log. From any
    /// thread.
    bool push(std::span<const std::byte> bytes, const log::SourceInfo& source, log::Arrival arrival);

    /// Appends everything to the log and publishes it; tells how many packets. The log's writing thread only.
    std::size_t moveTo(log::PacketLog& log);

    [[nodiscard]] bool isEmpty() const { return m_count.load(std::memory_order_acquire) == 0; }
    [[nodiscard]] std::uint64_t refused() const { return m_refused.load(std::memory_order_relaxed); }

private:
    struct Entry {
        std::size_t size;
        log::SourceInfo source;
        log::Arrival arrival;
    };

    const std::size_t m_byteLimit;
    std::mutex m_mutex;
    std::vector<Entry> m_entries;
    std::vector<std::byte> m_bytes;
    std::vector<Entry> m_takenEntries; ///< swapped with the above, so that both keep their memory
    std::vector<std::byte> m_takenBytes;
    std::atomic<std::size_t> m_count = 0;
    std::atomic<std::uint64_t> m_refused = 0;
};

} // namespace posewire::net
