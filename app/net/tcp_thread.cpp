// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/tcp_thread.h"

#include "app/net/tcp_inputs.h"

#include <QEventLoop>
#include <QTimer>

#include <algorithm>
#include <optional>
#include <vector>

namespace posewire::net {

struct TcpThread::Inside {
    explicit Inside(const TcpContext& itsContext) : context(itsContext) { timer.setSingleShot(true); }

    TcpContext context;
    std::vector<std::unique_ptr<TcpInput>> inputs;
    QTimer timer; ///< ends the wait for events when an input is due

    /// True if there is more to do at once.
    bool turn() {
        const log::Moment now = context.clock.monotonic();
        bool hasMore = false;
        std::optional<log::Moment> earliest;
        for (const auto& input : inputs) {
            hasMore |= input->turn(now);
            if (const auto due = input->due()) {
                earliest = std::min(*due, earliest.value_or(*due));
            }
        }
        if (earliest && !hasMore) {
            using std::chrono::milliseconds;
            const log::Duration wait = std::max(*earliest - now, log::Duration::zero());
            timer.start(std::chrono::duration_cast<milliseconds>(wait) + milliseconds(1));
        }
        return hasMore;
    }
};

TcpThread::TcpThread(const log::Clock& clock, PacketQueue& queue, InputCounters& totals)
    : m_clock(clock), m_queue(queue), m_totals(totals), m_thread([this] { run(); }) {}

TcpThread::~TcpThread() {
    m_isStopping.store(true, std::memory_order_release);
    wake();
    m_thread.join();
}

void TcpThread::run() {
    {
        const std::lock_guard lock(m_mutex);
        m_eventLoop = std::make_unique<QEventLoop>();
    }
    m_inside = std::make_unique<Inside>(TcpContext{m_clock, m_queue, m_totals});
    while (!m_isStopping.load(std::memory_order_acquire)) {
        m_commands.run();
        const bool hasMore = m_inside->turn();
        m_eventLoop->processEvents(hasMore ? QEventLoop::AllEvents : QEventLoop::WaitForMoreEvents);
    }
    for (const auto& input : m_inside->inputs) {
        input->drain();
    }
    m_inside.reset();
    const std::lock_guard lock(m_mutex);
    m_eventLoop.reset();
}

void TcpThread::wake() {
    const std::lock_guard lock(m_mutex);
    if (m_eventLoop) {
        m_eventLoop->wakeUp();
    }
}

NetResult<void> TcpThread::listen(const std::shared_ptr<Input>& input, const Endpoint& endpoint) {
    NetResult<void> result;
    m_commands.call([&] {
        auto listener = std::make_unique<TcpListener>(m_inside->context, input);
        result = listener->listen(endpoint);
        if (result) {
            m_inside->inputs.push_back(std::move(listener));
        }
    });
    return result;
}

void TcpThread::connect(const std::shared_ptr<Input>& input, const Endpoint& endpoint) {
    m_commands.call(
        [&] { m_inside->inputs.push_back(std::make_unique<TcpDialer>(m_inside->context, input, endpoint)); });
}

void TcpThread::remove(InputId id) {
    m_commands.call([&] {
        const auto place = std::ranges::find(m_inside->inputs, id, &TcpInput::id);
        if (place != m_inside->inputs.end()) {
            (*place)->drain();
            m_inside->inputs.erase(place);
        }
    });
}

} // namespace posewire::net
