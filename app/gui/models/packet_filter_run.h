// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/filter/filter.h"
#include "core/log/packet_log.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace posewire::gui {

/// Finds the packets of a log that a filter lets through: a thread of its own reads the log from its
/// beginning, and then whatever follows, until the run is destroyed, which stops it at once. The thread has a
/// reader and a digester of its own; nothing else is shared with it.
class PacketFilterRun {
public:
    /// The log must outlive the run. `firstStampNs` is where the filter's `time` begins.
    PacketFilterRun(const log::PacketLog& log, filter::Filter filter, std::int64_t firstStampNs);
    ~PacketFilterRun();
    PacketFilterRun(const PacketFilterRun&) = delete;
    PacketFilterRun& operator=(const PacketFilterRun&) = delete;

    /// Numbers found since the last call that lie below `end`, in growing order. Has the thread look for
    /// packets that came meanwhile.
    [[nodiscard]] std::vector<std::uint64_t> take(std::uint64_t end);

    /// Ends the search; what was found stays.
    void cancel();
    [[nodiscard]] bool isCancelled() const { return m_isCancelled.load(std::memory_order_relaxed); }

    /// How far it is. Up to date where `done` has come to the end of the log.
    struct Progress {
        std::uint64_t done = 0;  ///< packets looked at
        std::uint64_t total = 0; ///< of so many in the log when it last looked
    };
    [[nodiscard]] Progress progress() const;

    /// Blocks until everything that the log holds now was looked at, or the run was cancelled.
    void wait();

private:
    void run();
    bool rest(std::uint64_t end);
    void hand(std::vector<std::uint64_t>& found, std::uint64_t number);

    const log::PacketLog& m_log;
    const filter::Filter m_filter;
    const std::int64_t m_firstStampNs;
    std::atomic<bool> m_isCancelled = false;
    std::atomic<std::uint64_t> m_begin = 0; ///< the first packet there was
    std::atomic<std::uint64_t> m_next = 0;  ///< the packet to be looked at next
    std::atomic<std::uint64_t> m_end = 0;
    std::mutex m_mutex; ///< guards all that follows
    std::condition_variable m_changed;
    std::vector<std::uint64_t> m_found;
    bool m_isAwake = true; ///< there may be new packets
    std::thread m_thread;  // last: it uses the others
};

} // namespace posewire::gui
