// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/datagram_pacer.h"

#include "core/wire/codec.h"

#include <gtest/gtest.h>

namespace posewire::cli {
namespace {

std::vector<std::byte> datagram(std::uint8_t type, std::uint32_t sample, std::uint32_t timeCode) {
    wire::Datagram datagram;
    datagram.header.setType(type);
    datagram.header.sampleCounter = sample;
    datagram.header.timeCode = timeCode;
    return *wire::encode(datagram);
}

constexpr std::int64_t kMillisecond = 1'000'000;

TEST(DatagramPacer, FollowsTheTimeCodesOfTheSender) {
    DatagramPacer pacer(0.1, 1.0);
    EXPECT_EQ(pacer.due(datagram(2, 100, 5000), {}), 0);
    EXPECT_EQ(pacer.due(datagram(21, 100, 5000), {}), 0);
    EXPECT_EQ(pacer.due(datagram(12, 0, 0), {}), 0);
    EXPECT_EQ(pacer.due(datagram(2, 104, 5017), {}), 17 * kMillisecond);
}

TEST(DatagramPacer, TakesAPeriodWhereTimeCodesStandStillOrJump) {
    DatagramPacer pacer(0.1, 1.0);
    EXPECT_EQ(pacer.due(datagram(2, 1, 5000), {}), 0);
    EXPECT_EQ(pacer.due(datagram(2, 2, 5000), {}), 100 * kMillisecond);
    EXPECT_EQ(pacer.due(datagram(2, 3, 0), {}), 200 * kMillisecond);
    EXPECT_EQ(pacer.due(datagram(2, 4, 900000), {}), 300 * kMillisecond);
}

TEST(DatagramPacer, FollowsStampsWhereThereAreAny) {
    DatagramPacer pacer(0.1, 1.0);
    EXPECT_EQ(pacer.due(datagram(2, 1, 5000), 1'000'000'000), 0);
    EXPECT_EQ(pacer.due(datagram(12, 0, 0), 1'003'000'000), 3 * kMillisecond);
    EXPECT_EQ(pacer.due(datagram(2, 2, 5000), 1'002'000'000), 3 * kMillisecond);
}

TEST(DatagramPacer, PlaysFasterAndAgain) {
    DatagramPacer pacer(0.1, 2.0);
    EXPECT_EQ(pacer.due(datagram(2, 1, 5000), {}), 0);
    EXPECT_EQ(pacer.due(datagram(2, 2, 5010), {}), 5 * kMillisecond);
    pacer.beginAgain();
    EXPECT_EQ(pacer.due(datagram(2, 1, 5000), {}), 55 * kMillisecond);
}

} // namespace
} // namespace posewire::cli
