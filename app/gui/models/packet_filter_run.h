// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/filter/filter.h"
#include "core/log/log_reader.h"
#include "core/log/packet_log.h"
#include "core/log/time.h"
#include "core/model/accounting/packet_digest.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace posewire::gui {

/// Finds the packets of a log that a filter lets through: a thread of its own reads those that the session
/// has followed, and then whatever is handed to it, until the run is destroyed, which stops it at once. What
/// is known about a packet beyond its bytes is the session's own digest, so that list and filter agree.
class PacketFilterRun {
public:
    /// The log must outlive the run. `firstStamp` is where the filter's `time` begins.
    PacketFilterRun(const log::PacketLog& log, const model::PacketDigests& digests, filter::Filter filter,
                    log::Stamp firstStamp);
    ~PacketFilterRun();
    PacketFilterRun(const PacketFilterRun&) = delete;
    PacketFilterRun& operator=(const PacketFilterRun&) = delete;

    struct Found {
        std::vector<std::uint64_t> packets;  ///< in growing order
        std::vector<std::uint64_t> problems; ///< those of them that are problems
    };
    /// What was found since the last call. Has the thread look at the packets that were digested meanwhile.
    [[nodiscard]] Found take(const model::PacketDigests& digests);

    /// Ends the search; what was found stays.
    void cancel();
    [[nodiscard]] bool isCancelled() const { return m_isCancelled.load(std::memory_order_relaxed); }

    /// How far it is. Up to date where `done` has come to `total`.
    struct Progress {
        std::uint64_t done = 0;  ///< packets looked at
        std::uint64_t total = 0; ///< of so many that were handed to it
    };
    [[nodiscard]] Progress progress() const;

    /// Blocks until everything handed to it was looked at, or the run was cancelled.
    void wait();

private:
    void run();
    [[nodiscard]] std::optional<model::PacketDigests::Excerpt> nextExcerpt();
    void lookAt(const model::PacketDigests::Excerpt& excerpt, log::LogReader& reader);
    void hand(Found& found, std::uint64_t next);

    const log::PacketLog& m_log;
    const filter::Filter m_filter;
    const log::Stamp m_firstStamp;
    const std::uint64_t m_begin; ///< the first packet there was
    std::atomic<bool> m_isCancelled = false;
    std::atomic<std::uint64_t> m_next; ///< the packet to be looked at next
    std::atomic<std::uint64_t> m_end;  ///< of those handed to it
    wire::Datagram m_datagram;         // the thread's
    std::mutex m_mutex;                ///< guards all that follows
    std::condition_variable m_changed;
    Found m_found;
    std::deque<model::PacketDigests::Excerpt> m_excerpts; ///< yet to be looked at
    std::thread m_thread;                                 // last: it uses the others
};

} // namespace posewire::gui
