// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/allow_list.h"
#include "app/net/command_queue.h"
#include "app/net/input.h"
#include "app/net/packet_queue.h"
#include "core/log/clock.h"
#include "core/log/time.h"
#include "core/log/timeline.h"

#include <QEventLoop>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

class QTimer;

namespace posewire::net {

/// Qt's event dispatcher of a std::thread, which its sockets need. Only wake() may be called from others.
class ThreadEvents {
public:
    /// Again and again if need be.
    void begin() {
        const std::lock_guard lock(m_mutex);
        if (!m_eventLoop) {
            m_eventLoop = std::make_unique<QEventLoop>();
        }
    }
    void process(QEventLoop::ProcessEventsFlag flag) { m_eventLoop->processEvents(flag); }
    void end() {
        const std::lock_guard lock(m_mutex);
        m_eventLoop.reset();
    }

    /// Ends a wait for events; without effect before begin() and after end().
    void wake() {
        const std::lock_guard lock(m_mutex);
        if (m_eventLoop) {
            m_eventLoop->wakeUp();
        }
    }

private:
    std::mutex m_mutex; ///< guards m_eventLoop against a wake() before or after its life
    std::unique_ptr<QEventLoop> m_eventLoop;
};

/// Must outlive the connection.
struct TcpContext {
    const log::Clock& clock;
    const log::Timeline& timeline;
    PacketQueue& queue;
    AllowList allowed; ///< changes only between turns

    /// On the time line of the log.
    [[nodiscard]] log::Stamp now() const { return timeline.now(clock); }
};

/// An input that receives by TCP. Belongs to one thread, whose event loop runs between turns.
class TcpInput {
public:
    TcpInput(const TcpContext& context, std::shared_ptr<Input> input)
        : m_context(context), m_input(std::move(input)) {}
    virtual ~TcpInput() = default;
    TcpInput(const TcpInput&) = delete;
    TcpInput& operator=(const TcpInput&) = delete;

    [[nodiscard]] InputId id() const { return m_input->id(); }

    /// Does the work at hand; true if there is more that no event will announce.
    virtual bool turn(log::Moment now) = 0;

    /// When it needs a turn even without events; empty for never.
    [[nodiscard]] virtual std::optional<log::Moment> due() const = 0;

    /// Reads what has arrived, before destruction.
    virtual void drain() = 0;

    /// The list of those who are listened to has changed.
    virtual void heedAllowed() {}

protected:
    const TcpContext& m_context;
    std::shared_ptr<Input> m_input;
};

[[nodiscard]] NetResult<std::unique_ptr<TcpInput>> makeTcpListener(const TcpContext& context,
                                                                   const std::shared_ptr<Input>& input);

/// Connects to a sender that listens, and reconnects.
[[nodiscard]] std::unique_ptr<TcpInput> makeTcpDialer(const TcpContext& context,
                                                      const std::shared_ptr<Input>& input);

/// Reads TCP connections and passes their datagrams to the queue; while that is full it waits, and TCP makes
/// the senders wait. One thread for all connections, separate from the one that receives UDP.
class TcpThread {
public:
    /// The parts of `context` must outlive it.
    explicit TcpThread(const TcpContext& context) : m_context(context), m_thread([this] { run(); }) {}

    /// Ends all connections. The queue must be emptied meanwhile, or be closed.
    ~TcpThread();

    // From any other thread.
    NetResult<void> listen(const std::shared_ptr<Input>& input);
    void connect(const std::shared_ptr<Input>& input);
    void remove(InputId id);
    void listenTo(const AllowList& allowed);

private:
    void run();
    bool turn(QTimer& timer);

    TcpContext m_context;
    ThreadEvents m_events;
    CommandQueue m_commands{[this] { m_events.wake(); }};
    std::atomic<bool> m_isStopping = false;
    std::vector<std::unique_ptr<TcpInput>> m_inputs; ///< of the thread alone
    std::thread m_thread;
};

} // namespace posewire::net
