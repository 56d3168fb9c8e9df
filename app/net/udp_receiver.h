// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "app/net/net_error.h"
#include "app/net/packet_queue.h"
#include "core/log/clock.h"
#include "core/log/packet_log.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace posewire::net {

class ReceiveLoop;

/// How datagrams are fetched. Both ways keep the same log, except that only Native knows kernel stamps and
/// kernel drops.
enum class ReceivePath : std::uint8_t {
    Native,   ///< the system's fastest: recvmmsg on Linux, elsewhere the same as Portable
    Portable, ///< Qt alone
};

struct ReceiveOptions {
    std::vector<Endpoint> endpoints{Endpoint{}};
    ReceivePath path = ReceivePath::Native;
    /// Of the kernel's buffer of each socket: asked for. See ReceiveCounters for what was granted.
    int bufferBytes = 4 << 20;
    /// The thread sleeps at most so long after each emptying of the sockets, and less where much arrives: the
    /// cheapest way to receive, at the price of this delay, since waking costs as much as receiving dozens of
    /// datagrams. Stamps are the kernel's and do not suffer.
    std::chrono::microseconds nap{6000};
};

/// Written by the receiving thread, to be read by any.
struct ReceiveCounters {
    std::atomic<std::uint64_t> datagrams = 0;
    std::atomic<std::uint64_t> bytes = 0;
    std::atomic<std::uint64_t> kernelDropped = 0; ///< datagrams lost in this computer for want of buffer room
    std::atomic<std::int64_t> receiveBufferBytes = 0; ///< the smallest that a socket was granted
    std::atomic<std::int64_t> longestDelayNs =
        0; ///< the longest time the thread did not come to look at its sockets
};

/// The one thread that writes a PacketLog: takes datagrams from UDP sockets straight into the log, and
/// packets of other threads through a queue. It is a std::thread (the thread sanitizer sees nothing on a
/// QThread), does nothing else, and so loses nothing when the window is busy. The process needs a
/// QCoreApplication, whose loop need not run.
class UdpReceiver {
public:
    /// Opens all endpoints, or fails with the first that cannot be opened. While it runs, log.writer() and
    /// interning belong to its thread. `log` and `clock` must outlive it.
    static NetResult<std::unique_ptr<UdpReceiver>> start(log::PacketLog& log, const log::Clock& clock,
                                                         const ReceiveOptions& options);

    /// Stops and joins; the log has what had arrived in the sockets before.
    ~UdpReceiver();
    UdpReceiver(const UdpReceiver&) = delete;
    UdpReceiver& operator=(const UdpReceiver&) = delete;

    /// What it listens on, in the order of the options, with the real port where 0 was asked for.
    [[nodiscard]] const std::vector<Endpoint>& endpoints() const { return m_endpoints; }
    [[nodiscard]] const ReceiveCounters& counters() const { return m_counters; }

    /// Brings a packet into the log from any thread. False where the queue is full.
    bool submit(std::span<const std::byte> bytes, const log::SourceInfo& source, const log::Arrival& arrival);

private:
    UdpReceiver(log::PacketLog& log, const log::Clock& clock);
    NetResult<void> open(const ReceiveOptions& options);

    log::PacketLog& m_log;
    const log::Clock& m_clock;
    PacketQueue m_queue;
    ReceiveCounters m_counters;
    std::vector<Endpoint> m_endpoints;
    std::unique_ptr<ReceiveLoop> m_loop;
    std::thread m_thread;
};

} // namespace posewire::net
