// SPDX-License-Identifier: MIT
#include "core/log/clock.h"

#include <gtest/gtest.h>

namespace posewire::log {
namespace {

using namespace std::chrono_literals;

TEST(Clock, SystemClockIsInThisCenturyAndDoesNotGoBack) {
    const SystemClock clock;
    EXPECT_GT(clock.wall(), WallTime(1'700'000'000s));
    const Moment before = clock.monotonic();
    EXPECT_GE(clock.monotonic(), before);
}

} // namespace
} // namespace posewire::log
