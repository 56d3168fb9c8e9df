// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/command_queue.h"
#include "app/net/tcp_inputs.h"
#include "app/net/thread_events.h"

#include <atomic>
#include <thread>

class QTimer;

namespace posewire::net {

/// Reads TCP connections and passes their datagrams to the queue; while that is full it waits, and TCP makes
/// the senders wait. One thread for all connections, separate from the one that receives UDP.
class TcpThread {
public:
    /// What `context` names must outlive it. Its thread writes the totals.
    explicit TcpThread(const TcpContext& context);

    /// Ends all connections. The queue must be emptied meanwhile, or be closed.
    ~TcpThread();

    // From any other thread.
    NetResult<void> listen(const std::shared_ptr<Input>& input, const Endpoint& endpoint);
    void connect(const std::shared_ptr<Input>& input, const Endpoint& endpoint);
    void remove(InputId id);

private:
    void run();
    bool turn(QTimer& timer);

    const TcpContext m_context;
    ThreadEvents m_events;
    CommandQueue m_commands{[this] { m_events.wake(); }};
    std::atomic<bool> m_isStopping = false;
    std::vector<std::unique_ptr<TcpInput>> m_inputs; ///< of the thread alone
    std::thread m_thread;
};

} // namespace posewire::net
