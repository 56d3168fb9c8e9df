// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/send_schedule.h"

#include <gtest/gtest.h>

namespace posewire::net {
namespace {

constexpr std::int64_t kFrameNs = 1'000'000'000 / 240;

TEST(SendSchedule, LateSleepsDoNotAddUp) {
    log::ManualClock clock(0, 5'000);
    SendSchedule schedule(clock, [&](std::int64_t nanoseconds) { clock.advance(nanoseconds + 60'000); });
    for (std::int64_t frame = 0; frame < 240'000; ++frame) {
        const std::int64_t lateNs = schedule.waitUntil(frame * kFrameNs);
        ASSERT_GE(lateNs, 0);
        ASSERT_LE(lateNs, 60'000) << "frame " << frame;
    }
    EXPECT_LE(schedule.elapsedNs() - 239'999 * kFrameNs, 60'000);
}

TEST(SendSchedule, SleepsAgainAfterWakingEarly) {
    log::ManualClock clock;
    int sleeps = 0;
    SendSchedule schedule(clock, [&](std::int64_t nanoseconds) {
        ++sleeps;
        clock.advance((nanoseconds + 1) / 2);
    });
    EXPECT_EQ(schedule.waitUntil(1000), 0);
    EXPECT_GT(sleeps, 1);
}

TEST(SendSchedule, DoesNotSleepWhenLate) {
    log::ManualClock clock;
    int sleeps = 0;
    SendSchedule schedule(clock, [&](std::int64_t) { ++sleeps; });
    clock.advance(700);
    EXPECT_EQ(schedule.waitUntil(500), 200);
    EXPECT_EQ(sleeps, 0);
}

} // namespace
} // namespace posewire::net
