// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <mutex>
#include <vector>

namespace posewire::net {

/// Calls that other threads have one thread make. Checking for calls costs one load.
class CommandQueue {
public:
    using Command = std::function<void()>;

    /// `wake` makes the thread look.
    explicit CommandQueue(Command wake = {}) : m_wake(std::move(wake)) {}

    /// Returns once the thread has made the call.
    void call(const Command& command) {
        std::promise<void> promise;
        {
            const std::lock_guard lock(m_mutex);
            m_commands.emplace_back([&] {
                command();
                promise.set_value();
            });
            m_isEmpty.store(false, std::memory_order_release);
        }
        m_wake();
        promise.get_future().wait();
    }

    /// Makes the queued calls in order. Only from the one thread.
    void run() {
        if (m_isEmpty.load(std::memory_order_acquire)) {
            return;
        }
        std::vector<Command> taken;
        {
            const std::lock_guard lock(m_mutex);
            taken.swap(m_commands);
            m_isEmpty.store(true, std::memory_order_release);
        }
        for (const Command& command : taken) {
            command();
        }
    }

private:
    const Command m_wake;
    std::mutex m_mutex;
    std::vector<Command> m_commands;
    std::atomic<bool> m_isEmpty = true;
};

} // namespace posewire::net
