// SPDX-License-Identifier: MIT
#include "core/log/clock.h"

#include <gtest/gtest.h>

namespace posewire::log {
namespace {

TEST(Clock, SystemClockIsInThisCenturyAndDoesNotGoBack) {
    const SystemClock clock;
    EXPECT_GT(clock.wallNs(), 1'700'000'000LL * 1'000'000'000LL);
    const std::int64_t before = clock.monotonicNs();
    EXPECT_GE(clock.monotonicNs(), before);
}

TEST(Clock, ManualClockMovesOnlyWhenTold) {
    ManualClock clock(100, 7);
    EXPECT_EQ(clock.wallNs(), 100);
    EXPECT_EQ(clock.monotonicNs(), 7);
    clock.advance(5);
    EXPECT_EQ(clock.wallNs(), 105);
    EXPECT_EQ(clock.monotonicNs(), 12);
    clock.setWallNs(-3);
    EXPECT_EQ(clock.wallNs(), -3);
    EXPECT_EQ(clock.monotonicNs(), 12);
}

} // namespace
} // namespace posewire::log
