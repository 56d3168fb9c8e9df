// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/command_queue.h"
#include "app/net/input.h"
#include "app/net/net_error.h"
#include "app/net/packet_queue.h"
#include "core/log/clock.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>

class QEventLoop;

namespace posewire::net {

class TcpInput;

/// Reads TCP connections and passes their datagrams to the queue; while that is full it waits, and TCP makes
/// the senders wait. One thread for all connections, separate from the one that receives UDP.
class TcpThread {
public:
    /// All must outlive it. Its thread writes `totals`.
    TcpThread(const log::Clock& clock, PacketQueue& queue, InputCounters& totals);

    /// Ends all connections. The queue must be emptied meanwhile, or be closed.
    ~TcpThread();
    TcpThread(const TcpThread&) = delete;
    TcpThread& operator=(const TcpThread&) = delete;

    // From any other thread.
    NetResult<void> listen(const std::shared_ptr<Input>& input, const Endpoint& endpoint);
    void connect(const std::shared_ptr<Input>& input, const Endpoint& endpoint);
    void remove(InputId id);

private:
    struct Inside;

    void run();
    void wake();

    const log::Clock& m_clock;
    PacketQueue& m_queue;
    InputCounters& m_totals;
    CommandQueue m_commands{[this] { wake(); }};
    std::atomic<bool> m_isStopping = false;
    std::mutex m_mutex; ///< guards m_eventLoop
    std::unique_ptr<QEventLoop> m_eventLoop;
    std::unique_ptr<Inside> m_inside; ///< of the thread alone
    std::thread m_thread;
};

} // namespace posewire::net
