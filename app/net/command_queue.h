// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <vector>

namespace posewire::net {

/// Calls that other threads queue for one thread to make. Checking for calls costs one load.
class CommandQueue {
public:
    using Command = std::function<void()>;

    void push(Command command) {
        const std::lock_guard lock(m_mutex);
        m_commands.push_back(std::move(command));
        m_isEmpty.store(false, std::memory_order_release);
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
    std::mutex m_mutex;
    std::vector<Command> m_commands;
    std::atomic<bool> m_isEmpty = true;
};

} // namespace posewire::net
