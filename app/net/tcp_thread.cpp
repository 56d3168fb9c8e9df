// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/tcp_thread.h"

#include <QTimer>

#include <algorithm>

namespace posewire::net {

TcpThread::~TcpThread() {
    m_isStopping.store(true, std::memory_order_release);
    m_events.wake();
    m_thread.join();
}

void TcpThread::run() {
    m_events.begin();
    {
        QTimer timer; // ends the wait for events when an input is due
        timer.setSingleShot(true);
        while (!m_isStopping.load(std::memory_order_acquire)) {
            m_commands.run();
            const bool hasMore = turn(timer);
            m_events.process(hasMore ? QEventLoop::AllEvents : QEventLoop::WaitForMoreEvents);
        }
        for (const auto& input : m_inputs) {
            input->drain();
        }
        m_inputs.clear();
    }
    m_events.end();
}

/// True if there is more to do at once.
bool TcpThread::turn(QTimer& timer) {
    const log::Moment now = m_context.clock.monotonic();
    bool hasMore = false;
    std::optional<log::Moment> earliest;
    for (const auto& input : m_inputs) {
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

NetResult<void> TcpThread::listen(const std::shared_ptr<Input>& input) {
    NetResult<void> result;
    m_commands.call([&] {
        if (auto listener = makeTcpListener(m_context, input)) {
            m_inputs.push_back(std::move(*listener));
        } else {
            result = tl::unexpected(listener.error());
        }
    });
    return result;
}

void TcpThread::connect(const std::shared_ptr<Input>& input) {
    m_commands.call([&] { m_inputs.push_back(makeTcpDialer(m_context, input)); });
}

void TcpThread::listenTo(const AllowList& allowed) {
    m_commands.call([&] {
        m_context.allowed = allowed;
        for (const auto& input : m_inputs) {
            input->heedAllowed();
        }
    });
}

void TcpThread::remove(InputId id) {
    m_commands.call([&] {
        const auto place = std::ranges::find(m_inputs, id, &TcpInput::id);
        if (place != m_inputs.end()) {
            (*place)->drain();
            m_inputs.erase(place);
        }
    });
}

} // namespace posewire::net
