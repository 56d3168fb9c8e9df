// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/receiver.h"

#include "tests/app/net/net_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <utility>
#include <vector>

namespace posewire::net {
namespace {

class ReceiverTest : public ::testing::TestWithParam<ReceivePath> {
protected:
    [[nodiscard]] static ReceiverOptions options() {
        ReceiverOptions options;
        options.path = GetParam();
        return options;
    }
};

TEST_P(ReceiverTest, ReceivesWhatWasSentBitForBitAndInOrder) {
    Receiving receiving(options());
    auto sender = DatagramSender::connect(receiving.target());
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
    EXPECT_EQ(receiving.totals().datagrams, kCount);
    EXPECT_EQ(receiving.totals().kernelDropped, 0U);
}

TEST_P(ReceiverTest, OversizedDatagramsArriveWhole) {
    Receiving receiving(options());
    auto sender = DatagramSender::connect(receiving.target());
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

TEST_P(ReceiverTest, StampsRunOnWhereTheClockIsSetBack) {
    Receiving receiving(options());
    auto sender = DatagramSender::connect(receiving.target());
    const auto& timeline = receiving.log.timeline();
    const log::Duration near = std::chrono::milliseconds(20); // clocks of two CPUs may be apart by a tick
    log::LogReader reader(receiving.log);
    for (std::size_t i = 0; i < 4; ++i) {
        const log::Stamp begin = timeline.now(receiving.clock) - near;
        const log::WallTime wallBegin = receiving.clock.wall() - near;
        ASSERT_TRUE(sender->send(numbered(760, i)).has_value());
        ASSERT_TRUE(eventually([&] { return receiving.packets() == i + 1; }));
        ASSERT_TRUE(reader.refresh());
        const log::Stamp stamp = reader.packet(i)->stamp;
        EXPECT_GE(stamp, begin);
        EXPECT_LE(stamp, timeline.now(receiving.clock) + near);
        EXPECT_GE(timeline.wallOf(stamp), wallBegin);
        EXPECT_LE(timeline.wallOf(stamp), receiving.clock.wall() + near);
        EXPECT_EQ(timeline.stepCount(), i);
        receiving.clock.setBack(std::chrono::hours(i + 1));
    }
}

TEST_P(ReceiverTest, StampsAreOfNowAndDoNotGoBack) {
    Receiving receiving(options());
    auto sender = DatagramSender::connect(receiving.target());
    // The clocks of the CPUs of a virtual machine may be apart by a tick.
    const log::Duration near = std::chrono::milliseconds(20);
    const log::Duration back = GetParam() == ReceivePath::Native ? log::Duration::zero() : near;
    log::Stamp last = receiving.log.timeline().now(receiving.clock) - near;
    for (std::size_t i = 0; i < 50; ++i) {
        ASSERT_TRUE(sender->send(numbered(760, i)).has_value());
    }
    ASSERT_TRUE(eventually([&] { return receiving.packets() == 50; }));
    const log::Stamp after = receiving.log.timeline().now(receiving.clock) + near;
    log::LogReader reader(receiving.log);
    for (std::size_t i = 0; i < 50; ++i) {
        const auto packet = reader.packet(i);
        EXPECT_GE(packet->stamp, last - back);
        EXPECT_LE(packet->stamp, after);
        last = packet->stamp;
#ifdef __linux__
        EXPECT_EQ(packet->flags.stampedByKernel, GetParam() == ReceivePath::Native);
#endif
    }
}

TEST_P(ReceiverTest, SeveralPortsShareOneLogAndTellTheirSendersApart) {
    Receiving receiving(options(), 3);
    std::vector<NetResult<DatagramSender>> senders;
    for (const std::size_t port : {0U, 0U, 1U, 2U}) {
        senders.push_back(DatagramSender::connect(receiving.target(port)));
        ASSERT_TRUE(senders.back()->send(numbered(100, 1)).has_value());
    }
    ASSERT_TRUE(eventually([&] { return receiving.packets() == 4; }));
    EXPECT_EQ(receiving.log.senders().size(), 4U) << "two to one port, one to each of the others";
    log::LogReader reader(receiving.log);
    for (std::size_t i = 0; i < 4; ++i) {
        const auto sender = receiving.log.senders().find(reader.packet(i)->sender);
        ASSERT_NE(sender, nullptr);
        EXPECT_EQ(sender->transport, log::Transport::Udp);
        EXPECT_EQ(sender->address.find("127.0.0.1:"), 0U) << sender->address;
        EXPECT_TRUE(std::ranges::any_of(receiving.receiver->inputs(), [&](const InputStatus& input) {
            return input.endpoint.port == sender->localPort;
        }));
    }
}

TEST_P(ReceiverTest, ReceivesOverIpv6) {
    Receiving receiving(options(), 0);
    if (const auto id = receiving.receiver->addUdp(Endpoint{"::1", 0}); !id) {
        GTEST_SKIP() << "this computer has no IPv6 loopback: " << id.error().text;
    }
    auto sender = DatagramSender::connect(receiving.target());
    ASSERT_TRUE(sender->send(numbered(760, 5)).has_value());
    ASSERT_TRUE(eventually([&] { return receiving.packets() == 1; }));
    log::LogReader reader(receiving.log);
    EXPECT_TRUE(equal(reader.packet(0)->bytes, numbered(760, 5)));
    EXPECT_EQ(receiving.log.senders().find(reader.packet(0)->sender)->address.find("[::1]:"), 0U);
}

TEST_P(ReceiverTest, AnyAddressTakesIpv4AndShowsItAsSuch) {
    Receiving receiving(options(), 0);
    ASSERT_TRUE(receiving.receiver->addUdp(Endpoint{"", 0}));
    auto sender = DatagramSender::connect(receiving.target());
    ASSERT_TRUE(sender->send(numbered(24, 5)).has_value());
    ASSERT_TRUE(eventually([&] { return receiving.packets() == 1; }));
    EXPECT_EQ(receiving.log.senders().find(log::SenderId{})->address.find("127.0.0.1:"), 0U);
}

TEST_P(ReceiverTest, WakesAfterALongPause) {
    ReceiverOptions brisk = options();
    brisk.nap = std::chrono::microseconds(1); // so that idleness begins soon
    Receiving receiving(brisk);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    auto sender = DatagramSender::connect(receiving.target());
    for (std::size_t i = 1; i <= 3; ++i) {
        ASSERT_TRUE(sender->send(numbered(24, i)).has_value());
        ASSERT_TRUE(eventually([&] { return receiving.packets() == i; }));
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

TEST_P(ReceiverTest, PacketsOfOtherThreadsJoinTheLog) {
    Receiving receiving(options());
    const log::SenderInfo sender{"demo", log::Transport::Performer, 0};
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (std::size_t i = 0; i < 500; ++i) {
                receiving.receiver->submit(numbered(100 + t, i), sender, {.stamp = log::stampOf(7)});
            }
        });
    }
    EXPECT_TRUE(eventually([&] { return receiving.packets() == 2000; }));
    EXPECT_EQ(*receiving.log.senders().find(log::SenderId{}), sender);
    EXPECT_EQ(receiving.totals().datagrams, 0U);
}

TEST_P(ReceiverTest, StopsAtOnceAndStartsAgainOnTheSamePort) {
    log::PacketLog log;
    const log::SystemClock clock;
    Endpoint endpoint{"127.0.0.1", 0};
    for (std::size_t i = 1; i <= 5; ++i) {
        Receiver receiver(log, clock, options());
        ASSERT_TRUE(receiver.addUdp(endpoint));
        endpoint = receiver.inputs()[0].endpoint;
        auto sender = DatagramSender::connect({endpoint});
        ASSERT_TRUE(sender->send(numbered(760, i)).has_value());
        // what is in the socket by now is in the log when the receiver has gone
        EXPECT_TRUE(receiver.remove(receiver.inputs()[0].id));
        EXPECT_EQ(log.figures().end, i);
    }
}

TEST_P(ReceiverTest, WhatIsInTheSocketWhenItEndsIsInTheLog) {
    log::PacketLog log;
    const log::SystemClock clock;
    auto receiver = std::make_unique<Receiver>(log, clock, options());
    ASSERT_TRUE(receiver->addUdp(Endpoint{"127.0.0.1", 0}));
    auto sender = DatagramSender::connect({receiver->inputs()[0].endpoint});
    ASSERT_TRUE(sender->send(numbered(760, 1)).has_value());
    receiver.reset();
    EXPECT_EQ(log.figures().end, 1U);
}

TEST_P(ReceiverTest, InputsComeAndGoAndOthersLoseNothing) {
    Receiving receiving(options());
    std::atomic<bool> isStopping = false;
    std::uint64_t sent = 0;
    std::thread sending([&, target = receiving.target()] {
        auto sender = DatagramSender::connect(target);
        constexpr std::uint64_t atOnce = 100; // how much the socket's buffer holds is not what this is about
        while (!isStopping) {
            if (sent < receiving.packets() + atOnce) {
                EXPECT_TRUE(sender->send(numbered(760, sent++)).has_value());
            }
            std::this_thread::sleep_for(std::chrono::microseconds(100));
        }
    });
    for (int i = 0; i < 100; ++i) {
        const auto id = receiving.receiver->addUdp(Endpoint{"127.0.0.1", 0});
        ASSERT_TRUE(id);
        const auto listener = receiving.receiver->addTcpListener(Endpoint{"127.0.0.1", 0});
        ASSERT_TRUE(listener);
        EXPECT_EQ(receiving.receiver->inputs().size(), 3U);
        EXPECT_TRUE(receiving.receiver->remove(*id));
        EXPECT_TRUE(receiving.receiver->remove(*listener));
        EXPECT_FALSE(receiving.receiver->remove(*id));
    }
    isStopping = true;
    sending.join();
    EXPECT_TRUE(eventually([&] { return receiving.packets() == sent; }))
        << receiving.packets() << " of " << sent;
}

TEST_P(ReceiverTest, TheFirstPacketOfAnInputThatWasRemovedAndAddedAgainSaysSo) {
    Receiving receiving(options());
    const Endpoint target = receiving.endpoint();
    auto sender = DatagramSender::connect({target});
    const auto send = [&](std::size_t number) {
        ASSERT_TRUE(sender->send(numbered(760, number)).has_value());
        ASSERT_TRUE(eventually([&] { return receiving.packets() == number; }));
    };
    send(1);
    ASSERT_TRUE(receiving.receiver->remove(receiving.receiver->inputs()[0].id));
    ASSERT_TRUE(receiving.receiver->addUdp(target));
    send(2);
    send(3);
    log::LogReader reader(receiving.log);
    EXPECT_FALSE(reader.packet(0)->flags.afterClosed);
    EXPECT_TRUE(reader.packet(1)->flags.afterClosed);
    EXPECT_FALSE(reader.packet(2)->flags.afterClosed);
}

TEST_P(ReceiverTest, EachInputHasItsOwnCounters) {
    Receiving receiving(options(), 2);
    auto sender = DatagramSender::connect(receiving.target(1));
    for (std::size_t i = 0; i < 5; ++i) {
        ASSERT_TRUE(sender->send(numbered(100, i)).has_value());
    }
    ASSERT_TRUE(eventually([&] { return receiving.receiver->inputs()[1].datagrams == 5; }));
    EXPECT_EQ(receiving.receiver->inputs()[1].bytes, 500U);
    EXPECT_EQ(receiving.receiver->inputs()[0].datagrams, 0U);
    EXPECT_EQ(receiving.totals().datagrams, 5U);
    EXPECT_TRUE(receiving.receiver->remove(receiving.receiver->inputs()[1].id));
    EXPECT_EQ(receiving.totals().datagrams, 5U) << "what was counted stays";
}

TEST_P(ReceiverTest, TellsTheReceiveBufferItGot) {
    ReceiverOptions small = options();
    small.bufferBytes = 65'536;
    Receiving receiving(small);
    EXPECT_EQ(receiving.receiver->inputs()[0].receiveBufferBytes, 65'536);
    EXPECT_EQ(receiving.totals().receiveBufferBytes, 65'536);
}

INSTANTIATE_TEST_SUITE_P(Paths, ReceiverTest, ::testing::Values(ReceivePath::Native, ReceivePath::Portable),
                         &pathName);

#ifdef __linux__
ReceiverOptions narrow(std::chrono::milliseconds nap) {
    ReceiverOptions options;
    options.bufferBytes = 4096;
    options.nap = nap; // the thread sleeps while the buffer overflows
    return options;
}

TEST(ReceiverDelay, IsKnownWhileItLasts) {
    ReceiverOptions late;
    late.nap = std::chrono::milliseconds(400);
    const Receiving receiving(late);
    EXPECT_TRUE(eventually([&] { return receiving.receiver->isHeldUp(); }));
    const Receiving other;
    EXPECT_TRUE(eventually([&] { return !other.receiver->isHeldUp(); }));
}

TEST(ReceiverKernelDrops, AreInTheLogThoughNoPacketComesToTell) {
    Receiving receiving(narrow(std::chrono::milliseconds(20)));
    auto sender = DatagramSender::connect(receiving.target());
    constexpr std::size_t kSent = 3000;
    for (std::size_t i = 0; i < kSent; ++i) {
        ASSERT_TRUE(sender->send(numbered(760, i)).has_value());
    }
    const auto told = [&] { return receiving.packets() - receiving.dropRecords() + receiving.dropsInLog(); };
    EXPECT_TRUE(eventually([&] { return told() == kSent; })) << told();
    EXPECT_GT(receiving.dropsInLog(), 0U);
    EXPECT_EQ(receiving.totals().kernelDropped, receiving.dropsInLog());
    EXPECT_EQ(receiving.totals().datagrams + receiving.totals().kernelDropped, kSent);
    EXPECT_EQ(receiving.log.senders().size(), 1U) << "a record has the source last heard";
}

TEST(ReceiverKernelDrops, AreCountedOnceWhetherAPacketOrARecordTellsThem) {
    Receiving receiving(narrow(std::chrono::milliseconds(5)));
    auto sender = DatagramSender::connect(receiving.target());
    std::uint64_t sent = 0;
    for (int burst = 0; burst < 20; ++burst) {
        for (std::size_t i = 0; i < 100; ++i, ++sent) {
            ASSERT_TRUE(sender->send(numbered(760, i)).has_value());
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(burst % 3 * 40)); // some idle, some not
    }
    receiving.receiver.reset();
    EXPECT_EQ(receiving.packets() - receiving.dropRecords() + receiving.dropsInLog(), sent);
    EXPECT_GT(receiving.dropRecords(), 0U);
}

TEST(ReceiverKernelDrops, OfAnInputThatIsRemovedAreInTheLog) {
    Receiving receiving(narrow(std::chrono::milliseconds(50)));
    auto sender = DatagramSender::connect(receiving.target());
    for (std::size_t i = 0; i < 500; ++i) {
        ASSERT_TRUE(sender->send(numbered(760, i)).has_value());
    }
    receiving.receiver->remove(receiving.receiver->inputs()[0].id);
    EXPECT_EQ(receiving.packets() - receiving.dropRecords() + receiving.dropsInLog(), 500U);
}
#endif

} // namespace
} // namespace posewire::net
