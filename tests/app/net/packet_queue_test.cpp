// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/packet_queue.h"

#include "tests/app/net/net_fixture.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace posewire::net {
namespace {

const log::SenderInfo kSender{"10.0.0.5:50000", log::Transport::Tcp, 9763};

TEST(PacketQueue, HandsPacketsOverInOrderWithAllThatIsKnownOfThem) {
    PacketQueue queue;
    log::PacketLog log;
    EXPECT_TRUE(queue.isEmpty());
    for (std::size_t i = 0; i < 100; ++i) {
        EXPECT_TRUE(
            queue.push(numbered(i, i), kSender,
                       {.stamp = log::stampOf(static_cast<std::int64_t>(i)), .flags = {.skipped = i == 3}}));
    }
    EXPECT_FALSE(queue.isEmpty());
    EXPECT_EQ(queue.moveTo(log), 100U);
    EXPECT_TRUE(queue.isEmpty());
    EXPECT_EQ(queue.moveTo(log), 0U);

    log::LogReader reader(log);
    ASSERT_EQ(reader.end(), 100U);
    for (std::size_t i = 0; i < 100; ++i) {
        const auto packet = reader.packet(i);
        EXPECT_TRUE(equal(packet->bytes, numbered(i, i)));
        EXPECT_EQ(packet->stamp, log::stampOf(static_cast<std::int64_t>(i)));
        EXPECT_EQ(packet->flags.skipped, i == 3);
        EXPECT_EQ(*log.senders().find(packet->sender), kSender);
    }
}

TEST(PacketQueue, TellsOnceThatItIsNotEmptyAnyMore) {
    int told = 0;
    PacketQueue queue([&] { ++told; });
    log::PacketLog log;
    for (int round = 1; round <= 3; ++round) {
        for (std::size_t i = 0; i < 10; ++i) {
            EXPECT_TRUE(queue.push(numbered(10, i), kSender, {}));
        }
        EXPECT_EQ(told, round);
        queue.moveTo(log);
    }
}

TEST(PacketQueue, WaitingForRoomLosesNothingAndEndsWithTheQueue) {
    PacketQueue queue({}, 4000);
    log::PacketLog log;
    std::atomic<std::size_t> pushed = 0;
    std::thread pushing([&] {
        while (queue.push(numbered(760, 1), kSender, {})) {
            ++pushed;
        }
    });
    std::size_t moved = 0;
    while (moved < 500) {
        moved += queue.moveTo(log);
    }
    queue.close();
    pushing.join();
    moved += queue.moveTo(log);
    EXPECT_EQ(moved, pushed);
}

TEST(PacketQueue, AnEmptyOneTakesWhatIsLargerThanItsLimit) {
    PacketQueue queue({}, 100);
    EXPECT_TRUE(queue.push(numbered(760, 1), kSender, {}));
}

} // namespace
} // namespace posewire::net
