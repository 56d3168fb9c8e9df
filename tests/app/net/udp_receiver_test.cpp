// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/udp_receiver.h"

#include "tests/app/net/net_fixture.h"

#include <gtest/gtest.h>

namespace posewire::net {
namespace {

class UdpReceiverTest : public ::testing::TestWithParam<ReceivePath> {
protected:
    [[nodiscard]] static ReceiveOptions onLoopback(std::size_t ports = 1) {
        ReceiveOptions options;
        options.endpoints.assign(ports, Endpoint{"127.0.0.1", 0});
        options.path = GetParam();
        return options;
    }
};

TEST_P(UdpReceiverTest, ReceivesWhatWasSentBitForBitAndInOrder) {
    Receiving receiving(onLoopback());
    ASSERT_TRUE(receiving.isRunning()) << receiving.receiver.error().text;
    auto sender = DatagramSender::connect({receiving.target()});
    ASSERT_TRUE(sender.has_value());
    const auto sizeOf = [](std::size_t i) { return i * 97 % 2169; };
    constexpr std::size_t kCount = 2000;
    for (std::size_t i = 0; i < kCount; ++i) {
        ASSERT_TRUE(sender->send(numbered(sizeOf(i), i)).has_value());
        if (i % 100 == 99) { // the kernel's buffer is not what this test is about
            ASSERT_TRUE(eventually([&] { return receiving.packets() == i + 1; })) << receiving.packets();
        }
    }
    log::LogReader reader(receiving.log);
    for (std::size_t i = 0; i < kCount; ++i) {
        const auto packet = reader.packet(i);
        ASSERT_TRUE(packet);
        ASSERT_TRUE(equal(packet->bytes, numbered(sizeOf(i), i))) << i;
        ASSERT_EQ(packet->kernelDropsBefore, 0U);
        ASSERT_FALSE(packet->flags.truncated);
    }
    EXPECT_EQ(receiving.counters().datagrams, kCount);
    EXPECT_EQ(receiving.counters().kernelDropped, 0U);
}

TEST_P(UdpReceiverTest, OversizedDatagramsArriveWhole) {
    Receiving receiving(onLoopback());
    ASSERT_TRUE(receiving.isRunning());
    auto sender = DatagramSender::connect({receiving.target()});
    ASSERT_TRUE(sender.has_value());
    const std::vector<std::size_t> sizes{65'507, 10, 9000, 40'000, 2305, 0, 65'507};
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        ASSERT_TRUE(sender->send(numbered(sizes[i], i)).has_value());
    }
    ASSERT_EQ(sender->refused(), 0U);
    ASSERT_TRUE(eventually([&] { return receiving.packets() == sizes.size(); })) << receiving.packets();
    log::LogReader reader(receiving.log);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        EXPECT_TRUE(equal(reader.packet(i)->bytes, numbered(sizes[i], i))) << sizes[i];
    }
}

TEST_P(UdpReceiverTest, StampsAreOfNowAndDoNotGoBack) {
    Receiving receiving(onLoopback());
    ASSERT_TRUE(receiving.isRunning());
    auto sender = DatagramSender::connect({receiving.target()});
    const std::int64_t before = receiving.clock.wallNs();
    for (std::size_t i = 0; i < 50; ++i) {
        ASSERT_TRUE(sender->send(numbered(760, i)).has_value());
    }
    ASSERT_TRUE(eventually([&] { return receiving.packets() == 50; }));
    const std::int64_t after = receiving.clock.wallNs();
    log::LogReader reader(receiving.log);
    std::int64_t last = before - 1'000'000; // the kernel's clock and ours are read apart
    for (std::size_t i = 0; i < 50; ++i) {
        const auto packet = reader.packet(i);
        EXPECT_GE(packet->stampNs, last);
        EXPECT_LE(packet->stampNs, after);
        last = packet->stampNs;
#ifdef __linux__
        EXPECT_EQ(packet->flags.stampedByKernel, GetParam() == ReceivePath::Native);
#endif
    }
}

TEST_P(UdpReceiverTest, SeveralPortsShareOneLogAndTellTheirSourcesApart) {
    Receiving receiving(onLoopback(3));
    ASSERT_TRUE(receiving.isRunning());
    auto first = DatagramSender::connect({receiving.target(0), receiving.target(1), receiving.target(2)});
    auto second = DatagramSender::connect({receiving.target(0)});
    ASSERT_TRUE(first->send(numbered(100, 1)).has_value());
    ASSERT_TRUE(second->send(numbered(100, 2)).has_value());
    ASSERT_TRUE(eventually([&] { return receiving.packets() == 4; }));
    EXPECT_EQ(receiving.log.sources().size(), 4U) << "two senders to one port, one of them to two more";
    log::LogReader reader(receiving.log);
    for (std::size_t i = 0; i < 4; ++i) {
        const log::SourceInfo* source = receiving.log.sources().find(reader.packet(i)->source);
        ASSERT_NE(source, nullptr);
        EXPECT_EQ(source->transport, log::Transport::Udp);
        EXPECT_EQ(source->address.find("127.0.0.1:"), 0U) << source->address;
        EXPECT_TRUE(std::ranges::any_of((*receiving.receiver)->endpoints(), [&](const Endpoint& endpoint) {
            return endpoint.port == source->localPort;
        }));
    }
}

TEST_P(UdpReceiverTest, ReceivesOverIpv6) {
    ReceiveOptions options = onLoopback();
    options.endpoints[0].host = "::1";
    Receiving receiving(options);
    if (!receiving.isRunning() && receiving.receiver.error().kind != NetError::Kind::PortInUse) {
        GTEST_SKIP() << "this computer has no IPv6 loopback: " << receiving.receiver.error().text;
    }
    ASSERT_TRUE(receiving.isRunning());
    auto sender = DatagramSender::connect({receiving.target()});
    ASSERT_TRUE(sender->send(numbered(760, 5)).has_value());
    ASSERT_TRUE(eventually([&] { return receiving.packets() == 1; }));
    log::LogReader reader(receiving.log);
    EXPECT_TRUE(equal(reader.packet(0)->bytes, numbered(760, 5)));
    EXPECT_EQ(receiving.log.sources().find(reader.packet(0)->source)->address.find("[::1]:"), 0U);
}

TEST_P(UdpReceiverTest, AnyAddressTakesIpv4AndShowsItAsSuch) {
    ReceiveOptions options = onLoopback();
    options.endpoints[0].host = "";
    Receiving receiving(options);
    ASSERT_TRUE(receiving.isRunning());
    auto sender = DatagramSender::connect({receiving.target()});
    ASSERT_TRUE(sender->send(numbered(24, 5)).has_value());
    ASSERT_TRUE(eventually([&] { return receiving.packets() == 1; }));
    EXPECT_EQ(receiving.log.sources().find(log::SourceId{})->address.find("127.0.0.1:"), 0U);
}

TEST_P(UdpReceiverTest, WakesAfterALongPause) {
    ReceiveOptions options = onLoopback();
    options.nap = std::chrono::microseconds(1); // so that idleness begins soon
    Receiving receiving(options);
    ASSERT_TRUE(receiving.isRunning());
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    auto sender = DatagramSender::connect({receiving.target()});
    for (std::size_t i = 1; i <= 3; ++i) {
        ASSERT_TRUE(sender->send(numbered(24, i)).has_value());
        ASSERT_TRUE(eventually([&] { return receiving.packets() == i; }));
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

TEST_P(UdpReceiverTest, PacketsOfOtherThreadsJoinTheLog) {
    Receiving receiving(onLoopback());
    ASSERT_TRUE(receiving.isRunning());
    const log::SourceInfo source{"demo", log::Transport::Performer, 0};
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (std::size_t i = 0; i < 500; ++i) {
                (*receiving.receiver)->submit(numbered(100 + t, i), source, {.stampNs = 7});
            }
        });
    }
    EXPECT_TRUE(eventually([&] { return receiving.packets() == 2000; }));
    EXPECT_EQ(*receiving.log.sources().find(log::SourceId{}), source);
    EXPECT_EQ(receiving.counters().datagrams, 0U);
}

TEST_P(UdpReceiverTest, StopsAtOnceAndStartsAgainOnTheSamePort) {
    log::PacketLog log;
    const log::SystemClock clock;
    ReceiveOptions options = onLoopback();
    for (std::size_t i = 1; i <= 5; ++i) {
        auto receiver = UdpReceiver::start(log, clock, options);
        ASSERT_TRUE(receiver.has_value()) << receiver.error().text;
        options.endpoints = (*receiver)->endpoints();
        auto sender = DatagramSender::connect({{options.endpoints[0]}});
        ASSERT_TRUE(sender->send(numbered(760, i)).has_value());
        receiver->reset(); // what is in the socket by then is in the log
        EXPECT_EQ(log.figures().end, i);
    }
}

TEST_P(UdpReceiverTest, TellsTheReceiveBufferItGot) {
    ReceiveOptions options = onLoopback();
    options.bufferBytes = 65'536;
    Receiving receiving(options);
    ASSERT_TRUE(receiving.isRunning());
    EXPECT_EQ(receiving.counters().receiveBufferBytes, 65'536);
}

INSTANTIATE_TEST_SUITE_P(Paths, UdpReceiverTest,
                         ::testing::Values(ReceivePath::Native, ReceivePath::Portable), &pathName);

#ifdef __linux__
TEST(UdpReceiverKernelDrops, AreCountedAndPlacedInTheLog) {
    ReceiveOptions options;
    options.endpoints = {Endpoint{"127.0.0.1", 0}};
    options.bufferBytes = 4096;
    options.nap = std::chrono::milliseconds(50); // the thread sleeps while the buffer overflows
    Receiving receiving(options);
    ASSERT_TRUE(receiving.isRunning());
    auto sender = DatagramSender::connect({receiving.target()});
    constexpr std::size_t kBurst = 500;
    for (std::size_t i = 0; i < kBurst; ++i) {
        ASSERT_TRUE(sender->send(numbered(760, i)).has_value());
    }
    ASSERT_TRUE(eventually([&] { return receiving.packets() > 0; }));
    std::uint64_t sent = kBurst;
    const auto dropsInLog = [&] {
        std::uint64_t drops = 0;
        log::LogReader reader(receiving.log);
        for (std::uint64_t i = 0; i < reader.end(); ++i) {
            drops += reader.packet(i)->kernelDropsBefore;
        }
        return drops;
    };
    // Only a datagram that is queued after the loss tells of it.
    ASSERT_TRUE(eventually([&] {
        EXPECT_TRUE(sender->send(numbered(760, sent++)).has_value());
        return dropsInLog() > 0;
    }));
    receiving.receiver->reset();
    EXPECT_EQ(receiving.packets() + dropsInLog(), sent);
}

TEST(UdpReceiverKernelDrops, AreCountedBeforeTheNextDatagramComes) {
    ReceiveOptions options;
    options.endpoints = {Endpoint{"127.0.0.1", 0}};
    options.bufferBytes = 4096;
    options.nap = std::chrono::milliseconds(20);
    Receiving receiving(options);
    ASSERT_TRUE(receiving.isRunning());
    auto sender = DatagramSender::connect({receiving.target()});
    for (std::size_t i = 0; i < 3000; ++i) {
        ASSERT_TRUE(sender->send(numbered(760, i)).has_value());
    }
    EXPECT_TRUE(eventually([&] { return receiving.packets() + receiving.counters().kernelDropped == 3000; }))
        << receiving.packets() << " and " << receiving.counters().kernelDropped;
    EXPECT_GT(receiving.counters().kernelDropped, 0U);
}
#endif

} // namespace
} // namespace posewire::net
