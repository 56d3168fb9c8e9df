// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QEventLoop>

#include <memory>
#include <mutex>

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

} // namespace posewire::net
