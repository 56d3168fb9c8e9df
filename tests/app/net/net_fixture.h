// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/datagram_sender.h"
#include "app/net/receiver.h"
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

/// A log with a receiver that listens on loopback, on UDP ports that the system chooses.
/// The system's clock, which a test can set back: as the kernel's stamps are the real ones, the other clock
/// goes forward instead.
class SettableClock final : public log::Clock {
public:
    [[nodiscard]] log::WallTime wall() const override { return m_system.wall(); }
    [[nodiscard]] log::Moment monotonic() const override { return m_system.monotonic() + m_setBack.load(); }
    void setBack(log::Duration by) { m_setBack = m_setBack.load() + by; }

private:
    log::SystemClock m_system;
    std::atomic<log::Duration> m_setBack{};
};

struct Receiving {
    explicit Receiving(const ReceiverOptions& options = {}, std::size_t ports = 1)
        : receiver(std::make_unique<Receiver>(log, clock, options)) {
        for (std::size_t i = 0; i < ports; ++i) {
            EXPECT_TRUE(receiver->addUdp(Endpoint{"127.0.0.1", 0}));
        }
    }

    [[nodiscard]] Endpoint endpoint(std::size_t index = 0) const {
        return receiver->inputs().at(index).endpoint;
    }
    [[nodiscard]] SendTarget target(std::size_t index = 0) const { return {endpoint(index)}; }
    [[nodiscard]] ReceiveTotals totals() const { return receiver->totals(); }
    [[nodiscard]] std::uint64_t packets() const { return log.figures().end; }

    /// Datagrams that the log says were lost in this computer.
    [[nodiscard]] std::uint64_t dropsInLog() const {
        std::uint64_t drops = 0;
        log::LogReader reader(log);
        for (std::uint64_t i = reader.begin(); i < reader.end(); ++i) {
            drops += reader.packet(i)->kernelDropsBefore;
        }
        return drops;
    }
    [[nodiscard]] std::uint64_t dropRecords() const {
        std::uint64_t records = 0;
        log::LogReader reader(log);
        for (std::uint64_t i = reader.begin(); i < reader.end(); ++i) {
            records += reader.packet(i)->flags.isDropRecord ? 1 : 0;
        }
        return records;
    }

    log::PacketLog log;
    SettableClock clock;
    std::unique_ptr<Receiver> receiver;
};

} // namespace posewire::net
