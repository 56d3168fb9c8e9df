// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/datagram_sender.h"
#include "app/net/udp_receiver.h"
#include "core/log/clock.h"
#include "core/log/packet_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace posewire::net {

/// Looks again and again until the condition holds. False after ten seconds.
inline bool eventually(const std::function<bool()>& condition) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > deadline) {
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

inline std::vector<std::byte> numbered(std::size_t size, std::size_t number) {
    std::vector<std::byte> bytes(size);
    for (std::size_t i = 0; i < size; ++i) {
        bytes[i] = static_cast<std::byte>((number * 151 + i) & 0xff);
    }
    return bytes;
}

inline bool equal(std::span<const std::byte> a, std::span<const std::byte> b) {
    return std::ranges::equal(a, b);
}

inline std::string pathName(const ::testing::TestParamInfo<ReceivePath>& path) {
    return path.param == ReceivePath::Native ? "Native" : "Portable";
}

/// A log with a receiver that listens on loopback, on ports that the system chooses.
struct Receiving {
    explicit Receiving(ReceiveOptions options) : receiver(UdpReceiver::start(log, clock, options)) {}

    [[nodiscard]] bool isRunning() const { return receiver.has_value(); }
    [[nodiscard]] SendTarget target(std::size_t index = 0) const { return {(*receiver)->endpoints()[index]}; }
    [[nodiscard]] const ReceiveCounters& counters() const { return (*receiver)->counters(); }
    [[nodiscard]] std::uint64_t packets() const { return log.figures().end; }

    log::PacketLog log;
    log::SystemClock clock;
    NetResult<std::unique_ptr<UdpReceiver>> receiver;
};

} // namespace posewire::net
