// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/udp_receiver.h"

#include <atomic>
#include <memory>
#include <vector>

namespace posewire::net {

/// What a loop works with; outlives it.
struct ReceiveContext {
    log::PacketLog& log;
    const log::Clock& clock;
    PacketQueue& queue;
    ReceiveCounters& counters;
};

/// What the receiving thread does: made, opened, run and destroyed in that thread; only stop() and wake()
/// come from others.
class ReceiveLoop {
public:
    virtual ~ReceiveLoop() = default;

    /// Opens the sockets and tells their endpoints.
    virtual NetResult<std::vector<Endpoint>> open(const ReceiveOptions& options) = 0;

    /// Receives until stop(), then once more what is there already.
    virtual void run() = 0;

    /// Makes an idle loop look at the queue. From any thread.
    virtual void wake() = 0;

    void stop() {
        m_isStopping.store(true, std::memory_order_release);
        wake();
    }

protected:
    [[nodiscard]] bool isStopping() const { return m_isStopping.load(std::memory_order_acquire); }

private:
    std::atomic<bool> m_isStopping = false;
};

/// The loop for a path on this system. The sockets are opened by open().
[[nodiscard]] std::unique_ptr<ReceiveLoop> makeReceiveLoop(ReceivePath path, const ReceiveContext& context);

/// Adds for the one thread that writes it: cheaper than an atomic addition.
template <typename Number>
void add(std::atomic<Number>& counter, Number amount) {
    counter.store(counter.load(std::memory_order_relaxed) + amount, std::memory_order_relaxed);
}

} // namespace posewire::net
