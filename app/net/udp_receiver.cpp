// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/udp_receiver.h"

#include "app/net/receive_loop.h"

#include <future>

namespace posewire::net {

NetResult<std::unique_ptr<UdpReceiver>> UdpReceiver::start(log::PacketLog& log, const log::Clock& clock,
                                                           const ReceiveOptions& options) {
    std::unique_ptr<UdpReceiver> receiver(new UdpReceiver(log, clock));
    if (auto opened = receiver->open(options); !opened) {
        return tl::unexpected(opened.error());
    }
    return receiver;
}

UdpReceiver::UdpReceiver(log::PacketLog& log, const log::Clock& clock) : m_log(log), m_clock(clock) {}

UdpReceiver::~UdpReceiver() {
    if (m_thread.joinable()) {
        m_loop->stop();
        m_thread.join();
    }
}

NetResult<void> UdpReceiver::open(const ReceiveOptions& options) {
    // Qt's sockets belong to the thread that makes them, so even opening them is the receiving thread's.
    m_loop = makeReceiveLoop(options.path, {m_log, m_clock, m_queue, m_counters});
    std::promise<NetResult<std::vector<Endpoint>>> promise;
    auto opened = promise.get_future();
    m_thread = std::thread([this, &options, promise = std::move(promise)]() mutable {
        auto result = m_loop->open(options);
        const bool isOpen = result.has_value();
        promise.set_value(std::move(result));
        if (isOpen) {
            m_loop->run();
        }
    });
    auto result = opened.get();
    if (!result) {
        m_thread.join();
        return tl::unexpected(result.error());
    }
    m_endpoints = std::move(*result);
    return {};
}

bool UdpReceiver::submit(std::span<const std::byte> bytes, const log::SourceInfo& source,
                         const log::Arrival& arrival) {
    const bool isTaken = m_queue.push(bytes, source, arrival);
    m_loop->wake();
    return isTaken;
}

} // namespace posewire::net
