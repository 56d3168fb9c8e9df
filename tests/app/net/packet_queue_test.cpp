// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/packet_queue.h"

#include "tests/app/net/net_fixture.h"

#include <gtest/gtest.h>

namespace posewire::net {
namespace {

const log::SourceInfo kSource{"10.0.0.5:50000", log::Transport::Tcp, 9763};

TEST(PacketQueue, HandsPacketsOverInOrderWithAllThatIsKnownOfThem) {
    PacketQueue queue;
    log::PacketLog log;
    EXPECT_TRUE(queue.isEmpty());
    for (std::size_t i = 0; i < 100; ++i) {
        EXPECT_TRUE(queue.push(numbered(i, i), kSource,
                               {.stampNs = static_cast<std::int64_t>(i), .flags = {.skipped = i == 3}}));
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
        EXPECT_EQ(packet->stampNs, static_cast<std::int64_t>(i));
        EXPECT_EQ(packet->flags.skipped, i == 3);
        EXPECT_EQ(*log.sources().find(packet->source), kSource);
    }
}

TEST(PacketQueue, RefusesAndCountsWhatDoesNotFit) {
    PacketQueue queue(4000);
    log::PacketLog log;
    std::size_t taken = 0;
    while (queue.push(numbered(760, taken), kSource, {})) {
        ++taken;
    }
    EXPECT_GT(taken, 0U);
    EXPECT_LE(taken * 760, 4000U);
    EXPECT_EQ(queue.refused(), 1U);
    EXPECT_EQ(queue.moveTo(log), taken);
    EXPECT_TRUE(queue.push(numbered(760, 0), kSource, {}));
}

} // namespace
} // namespace posewire::net
