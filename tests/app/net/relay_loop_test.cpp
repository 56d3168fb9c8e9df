// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/relay.h"
#include "tests/app/net/net_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

namespace posewire::net {
namespace {

using ::testing::HasSubstr;

/// Monitors that relay to one another: receivers and relays, joined by loopback.
struct Monitor {
    Receiving receiving;
    std::unique_ptr<Relay> relay = std::make_unique<Relay>(receiving.log, receiving.clock);

    void relayTo(const Monitor& other) { ASSERT_TRUE(relay->add(other.receiving.endpoint(), {})); }
    [[nodiscard]] RelayTarget target() const { return relay->targets().at(0); }
    [[nodiscard]] bool isStopped() const { return target().isStopped; }
};

std::vector<std::byte> unlike(std::uint64_t number) {
    std::vector<std::byte> bytes(200);
    std::memcpy(bytes.data(), &number, sizeof number);
    return bytes;
}

class RelayLoopTest : public ::testing::TestWithParam<int> {
protected:
    /// As many datagrams as the review sent, 500 a second.
    void perform(const Monitor& monitor, std::uint64_t count = 500) {
        auto sender = DatagramSender::connect(monitor.receiving.target());
        for (std::uint64_t i = 0; i < count; ++i) {
            ASSERT_TRUE(sender->send(unlike(++sent)).has_value());
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }
    std::uint64_t sent = 0;
};

TEST_P(RelayLoopTest, IsFoundAndTheTargetStopped) {
    std::vector<Monitor> monitors(static_cast<std::size_t>(GetParam()));
    for (std::size_t i = 0; i < monitors.size(); ++i) {
        monitors[i].relayTo(monitors[(i + 1) % monitors.size()]);
    }
    perform(monitors[0]);
    ASSERT_TRUE(eventually([&] { return monitors[0].isStopped(); }));
    EXPECT_THAT(monitors[0].target().problem,
                HasSubstr(textOf(monitors[1].receiving.endpoint()) + " sent back what was relayed there: "));
    EXPECT_EQ(monitors[0].receiving.log.senders().find(monitors[0].target().returner)->transport,
              log::Transport::Udp);
    std::this_thread::sleep_for(std::chrono::milliseconds(100)); // what is still under way
    const std::uint64_t then = monitors[0].receiving.packets();
    EXPECT_LE(then, 2 * sent + LoopWatch::kSuspicious) << "of " << sent;
    perform(monitors[0], 20);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(monitors[0].receiving.packets(), then + 20) << "nothing comes back any more";
}

TEST_P(RelayLoopTest, IsFoundAgainAfterARelayStartedAnew) {
    std::vector<Monitor> monitors(static_cast<std::size_t>(GetParam()));
    for (std::size_t i = 0; i < monitors.size(); ++i) {
        monitors[i].relayTo(monitors[(i + 1) % monitors.size()]);
    }
    perform(monitors[0], 20);
    for (Monitor& monitor : monitors) { // its port is another then
        const RelayTarget target = monitor.target();
        monitor.relay = std::make_unique<Relay>(monitor.receiving.log, monitor.receiving.clock);
        ASSERT_TRUE(monitor.relay->add(target.endpoint, {}));
    }
    perform(monitors[0], 300);
    EXPECT_TRUE(eventually([&] { return monitors[0].isStopped(); }));
    EXPECT_LE(monitors[0].receiving.packets(), 3 * sent);
}

INSTANTIATE_TEST_SUITE_P(Monitors, RelayLoopTest, ::testing::Values(2, 3));

TEST_F(RelayLoopTest, MonitorsThatBothPerformStopOneOfTheirTargetsAtLeast) {
    std::vector<Monitor> monitors(2);
    monitors[0].relayTo(monitors[1]);
    monitors[1].relayTo(monitors[0]);
    std::thread second([&] {
        auto sender = DatagramSender::connect(monitors[1].receiving.target());
        for (std::uint64_t i = 0; i < 750; ++i) {
            EXPECT_TRUE(sender->send(unlike(1'000'000 + i)).has_value());
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    });
    perform(monitors[0], 750);
    second.join();
    EXPECT_TRUE(eventually([&] { return monitors[0].isStopped() || monitors[1].isStopped(); }));
    EXPECT_LE(monitors[0].receiving.packets(), std::uint64_t{4 * 750});
}

TEST_F(RelayLoopTest, WhatCameIsSentRefusedOrSkipped) {
    std::vector<Monitor> monitors(2);
    monitors[0].relayTo(monitors[1]);
    monitors[1].relayTo(monitors[0]);
    perform(monitors[0], 100); // amid a trial, perhaps
    const auto isAllCounted = [&] {
        const RelayTarget target = monitors[0].target();
        return target.behind == 0 &&
               target.sent + target.refused + target.skipped == monitors[0].receiving.packets();
    };
    ASSERT_FALSE(monitors[0].isStopped()) << "then it does not count on";
    EXPECT_TRUE(eventually(isAllCounted)) << monitors[0].target().sent << " " << monitors[0].target().skipped;
}

TEST_F(RelayLoopTest, RepeatsOnPurposeAreRelayedOneAndAll) {
    Monitor monitor;
    Receiving consumer;
    ASSERT_TRUE(monitor.relay->add(consumer.endpoint(), {}));
    auto sender = DatagramSender::connect(monitor.receiving.target());
    for (int i = 0; i < 500; ++i) {
        ASSERT_TRUE(sender->send(unlike(static_cast<std::uint64_t>(i % 4))).has_value());
        if (i % 50 == 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }
    EXPECT_TRUE(eventually([&] { return consumer.packets() == 500; })) << consumer.packets();
    EXPECT_FALSE(monitor.isStopped());
}

} // namespace
} // namespace posewire::net
