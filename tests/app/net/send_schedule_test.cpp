// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/datagram_sender.h"

#include "tests/support/manual_clock.h"

#include <gtest/gtest.h>

namespace posewire::net {
namespace {

using namespace std::chrono_literals;

constexpr log::Duration kFrame = log::Duration(1s) / 240;

TEST(SendSchedule, LateSleepsDoNotAddUp) {
    log::ManualClock clock(log::WallTime(), log::Moment(5us));
    SendSchedule schedule(clock, [&](log::Duration duration) { clock.advance(duration + 60us); });
    for (std::int64_t frame = 0; frame < 240'000; ++frame) {
        const log::Duration late = schedule.waitUntil(frame * kFrame);
        ASSERT_GE(late, 0s);
        ASSERT_LE(late, 60us) << "frame " << frame;
    }
    EXPECT_LE(schedule.elapsed() - 239'999 * kFrame, 60us);
}

TEST(SendSchedule, BeginsAgainWhereItIsStartedLater) {
    log::ManualClock clock;
    SendSchedule schedule(clock, [&](log::Duration duration) { clock.advance(duration); });
    clock.advance(4ms); // a file is opened
    schedule.startNow();
    EXPECT_EQ(schedule.waitUntil(0s), 0s);
    EXPECT_EQ(schedule.waitUntil(1ms), 0s);
    EXPECT_EQ(schedule.elapsed(), 1ms);
}

TEST(SendSchedule, SleepsAgainAfterWakingEarly) {
    log::ManualClock clock;
    int sleeps = 0;
    SendSchedule schedule(clock, [&](log::Duration duration) {
        ++sleeps;
        clock.advance((duration + 1ns) / 2);
    });
    EXPECT_EQ(schedule.waitUntil(1us), 0s);
    EXPECT_GT(sleeps, 1);
}

TEST(SendSchedule, DoesNotSleepWhenLate) {
    log::ManualClock clock;
    int sleeps = 0;
    SendSchedule schedule(clock, [&](log::Duration) { ++sleeps; });
    clock.advance(700ns);
    EXPECT_EQ(schedule.waitUntil(500ns), 200ns);
    EXPECT_EQ(sleeps, 0);
}

} // namespace
} // namespace posewire::net
