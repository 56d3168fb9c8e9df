// SPDX-License-Identifier: MIT
#include "core/log/clock.h"

#include <gtest/gtest.h>

namespace posewire::log {
namespace {

using namespace std::chrono_literals;

TEST(Clock, SystemClockIsInThisCenturyAndDoesNotGoBack) {
    const SystemClock clock;
    EXPECT_GT(clock.wall(), Stamp(1'700'000'000s));
    const Moment before = clock.monotonic();
    EXPECT_GE(clock.monotonic(), before);
}

TEST(Clock, ManualClockMovesOnlyWhenTold) {
    ManualClock clock(Stamp(100ns), Moment(7ns));
    EXPECT_EQ(clock.wall(), Stamp(100ns));
    EXPECT_EQ(clock.monotonic(), Moment(7ns));
    clock.advance(5ns);
    EXPECT_EQ(clock.wall(), Stamp(105ns));
    EXPECT_EQ(clock.monotonic(), Moment(12ns));
    clock.setWall(Stamp(-3ns));
    EXPECT_EQ(clock.wall(), Stamp(-3ns));
    EXPECT_EQ(clock.monotonic(), Moment(12ns));
}

} // namespace
} // namespace posewire::log
