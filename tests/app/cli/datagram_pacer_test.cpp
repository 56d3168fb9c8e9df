// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/datagram_pacer.h"

#include "core/wire/codec.h"

#include <gtest/gtest.h>

namespace posewire::cli {
namespace {

using namespace std::chrono_literals;

std::vector<std::byte> datagram(std::uint8_t type, std::uint32_t sample, std::uint32_t timeCode) {
    wire::Datagram datagram;
    datagram.header.setType(type);
    datagram.header.sampleCounter = sample;
    datagram.header.timeCode = timeCode;
    return *wire::encode(datagram);
}

std::optional<log::Duration> due(DatagramPacer& pacer, const std::vector<std::byte>& bytes,
                                 std::optional<log::WallTime> time = {}, log::Duration setBy = {}) {
    log::FileRecord record;
    record.bytes = bytes;
    record.time = time;
    record.setBy = setBy;
    return pacer.due(record);
}

TEST(DatagramPacer, FollowsTheTimeCodesOfTheSender) {
    DatagramPacer pacer(0.1, 1.0);
    EXPECT_EQ(due(pacer, datagram(2, 100, 5000)), 0ms);
    EXPECT_EQ(due(pacer, datagram(21, 100, 5000)), 0ms);
    EXPECT_EQ(due(pacer, datagram(12, 0, 0)), 0ms);
    EXPECT_EQ(due(pacer, datagram(2, 104, 5017)), 17ms);
}

TEST(DatagramPacer, TakesAPeriodWhereTimeCodesStandStillOrJump) {
    DatagramPacer pacer(0.1, 1.0);
    EXPECT_EQ(due(pacer, datagram(2, 1, 5000)), 0ms);
    EXPECT_EQ(due(pacer, datagram(2, 2, 5000)), 100ms);
    EXPECT_EQ(due(pacer, datagram(2, 3, 0)), 200ms);
    EXPECT_EQ(due(pacer, datagram(2, 4, 900000)), 300ms);
}

TEST(DatagramPacer, FollowsStampsWhereThereAreAny) {
    DatagramPacer pacer(0.1, 1.0);
    EXPECT_EQ(due(pacer, datagram(2, 1, 5000), log::WallTime(1000ms)), 0ms);
    EXPECT_EQ(due(pacer, datagram(12, 0, 0), log::WallTime(1003ms)), 3ms);
    EXPECT_EQ(due(pacer, datagram(2, 2, 5000), log::WallTime(1002ms)), 3ms);
}

TEST(DatagramPacer, DoesNotWaitWhereTheClockWasSet) {
    DatagramPacer pacer(0.1, 1.0);
    EXPECT_EQ(due(pacer, datagram(2, 1, 5000), log::WallTime(1000ms)), 0ms);
    EXPECT_EQ(due(pacer, datagram(2, 2, 5004), log::WallTime(1004ms + 1h), 1h), 4ms);
    EXPECT_EQ(due(pacer, datagram(2, 3, 5008), log::WallTime(1008ms), 0ms), 8ms);
}

TEST(DatagramPacer, PlaysFasterAndAgain) {
    DatagramPacer pacer(0.1, 2.0);
    EXPECT_EQ(due(pacer, datagram(2, 1, 5000)), 0ms);
    EXPECT_EQ(due(pacer, datagram(2, 2, 5010)), 5ms);
    pacer.beginAgain();
    EXPECT_EQ(due(pacer, datagram(2, 1, 5000)), 55ms);
}

TEST(DatagramPacer, OnlyARangeIsDue) {
    DatagramPacer pacer(0.1, 2.0, {"0.010", "0.030"});
    const auto dueAt = [&](std::uint32_t sample, std::chrono::milliseconds time) {
        return due(pacer, datagram(2, sample, 0), log::WallTime(1000ms + time));
    };
    EXPECT_EQ(dueAt(1, 0ms), std::nullopt);
    EXPECT_EQ(dueAt(2, 10ms), 0ms);
    EXPECT_EQ(dueAt(3, 20ms), 5ms);
    EXPECT_FALSE(pacer.isPast());
    EXPECT_EQ(dueAt(4, 30ms), std::nullopt);
    EXPECT_TRUE(pacer.isPast());
    pacer.beginAgain();
    EXPECT_FALSE(pacer.isPast());
    EXPECT_EQ(dueAt(1, 0ms), std::nullopt);
    EXPECT_EQ(dueAt(2, 10ms), 55ms) << "a period after what was due last";
}

} // namespace
} // namespace posewire::cli
