// SPDX-License-Identifier: MIT
#include "core/log/timeline.h"

#include "core/log/packet_log.h"
#include "core/log/recording.h"
#include "tests/core/log/recording_fixture.h"
#include "tests/support/manual_clock.h"

#include <gtest/gtest.h>

namespace posewire::log {
namespace {

using namespace std::chrono_literals;

constexpr WallTime kBegin(1'700'000'000s);

class TimelineTest : public testing::Test {
protected:
    [[nodiscard]] Stamp now() const { return timeline.now(clock); }
    [[nodiscard]] std::vector<Duration> changes() const {
        std::vector<Duration> all;
        for (std::size_t i = 0; i < timeline.stepCount(); ++i) {
            all.push_back(timeline.step(i).change);
        }
        return all;
    }

    ManualClock clock{kBegin, Moment(7s)};
    Timeline timeline;
};

TEST_F(TimelineTest, BeginsAsTheWallClockAndRunsOnWhereThatIsSet) {
    EXPECT_EQ(now(), asStamp(kBegin));
    clock.advance(3s);
    clock.setWall(-1h);
    EXPECT_EQ(now(), asStamp(kBegin + 3s));
    EXPECT_EQ(timeline.wallAhead(clock), -1h);
}

TEST_F(TimelineTest, KnowsWhatTheWallClockShowed) {
    const Stamp begin = now();
    timeline.add({begin + 10s, -1h, -1h});
    timeline.add({begin + 20s, 5s, 1h + 5s});
    EXPECT_EQ(timeline.wallOf(begin - 1s), kBegin - 1s);
    EXPECT_EQ(timeline.wallOf(begin + 10s - 1ns), kBegin + 10s - 1ns);
    EXPECT_EQ(timeline.wallOf(begin + 10s), kBegin + 10s - 1h);
    EXPECT_EQ(timeline.wallOf(begin + 20s), kBegin + 25s);
}

TEST_F(TimelineTest, FindsWhenTheClockLastShowedATime) {
    const Stamp begin = now();
    timeline.add({begin + 10s, -4s, -4s});
    timeline.add({begin + 20s, 5s, 9s});
    EXPECT_EQ(timeline.stampOf(kBegin + 3s), begin + 3s);
    EXPECT_EQ(timeline.stampOf(kBegin + 8s), begin + 12s) << "it showed that twice";
    EXPECT_EQ(timeline.stampOf(kBegin + 18s), begin + 20s) << "it never showed that";
    EXPECT_EQ(timeline.stampOf(kBegin + 30s), begin + 25s);
}

TEST_F(TimelineTest, BoundsWhatItKeeps) {
    const Stamp begin = now();
    for (std::size_t i = 0; i < 2 * Timeline::kMostSteps; ++i) {
        timeline.add({begin + static_cast<std::int64_t>(i) * 1s, 1s, 1s});
    }
    EXPECT_EQ(timeline.stepCount(), Timeline::kMostSteps);
}

class ClockWatchTest : public TimelineTest {
protected:
    ClockWatch watch{timeline, clock};
};

TEST_F(ClockWatchTest, StampsWithoutAStepAreTheKernels) {
    for (int i = 0; i < 5; ++i) {
        clock.advance(6ms);
        watch.look();
        EXPECT_EQ(watch.stampOf(clock.wall() - 2ms), asStamp(clock.wall() - 2ms));
    }
    EXPECT_TRUE(changes().empty());
}

TEST_F(ClockWatchTest, TellsPacketsBeforeAStepFromThoseAfter) {
    for (const Duration step : {Duration(-1h), Duration(1h), Duration(-2s), Duration(40ms)}) {
        watch.look();
        const Stamp begin = now();
        clock.advance(1ms);
        const WallTime before = clock.wall();
        clock.advance(2ms);
        clock.setWall(step);
        clock.advance(1ms);
        const WallTime after = clock.wall();
        clock.advance(2ms);
        watch.look();
        EXPECT_EQ(watch.stampOf(before), begin + 1ms) << step.count();
        EXPECT_EQ(watch.stampOf(after), begin + 4ms) << step.count();
        EXPECT_EQ(watch.stampOf(before), begin + 1ms) << "of another socket";
        EXPECT_EQ(timeline.wallOf(begin + 1ms), before);
        EXPECT_EQ(timeline.wallOf(begin + 4ms), after);
        EXPECT_EQ(changes().back(), step);
    }
    EXPECT_EQ(changes().size(), 4U);
}

TEST_F(ClockWatchTest, TellsAStepWhereNothingComes) {
    watch.look();
    clock.advance(1h);
    clock.setWall(5s);
    watch.look();
    EXPECT_TRUE(changes().empty()) << "a packet may show where it was";
    watch.settle();
    EXPECT_EQ(changes(), std::vector<Duration>{5s});
    EXPECT_EQ(timeline.wallOf(now()), clock.wall());
}

TEST_F(ClockWatchTest, LeavesAloneWhatIsNoStep) {
    watch.look();
    for (int i = 0; i < 9; ++i) {
        clock.advance(1s);
        clock.setWall(100us);
        watch.look();
    }
    EXPECT_TRUE(changes().empty()) << "0.9 ms";
    clock.setWall(100us);
    watch.look();
    watch.settle();
    EXPECT_EQ(changes(), std::vector<Duration>{1ms});
}

TEST_F(ClockWatchTest, TellsEveryStep) {
    for (const Duration step : {Duration(1h), Duration(-1h), Duration(2s)}) {
        clock.advance(1s);
        clock.setWall(step);
        watch.look();
    }
    watch.settle();
    EXPECT_EQ(changes(), (std::vector<Duration>{1h, -1h, 2s}));
}

class RecordedClockTest : public TimelineTest {
protected:
    RecordedClock recorded{timeline};
};

TEST_F(RecordedClockTest, GoesByWhatTheRecordingSays) {
    EXPECT_EQ(recorded.stampOf(kBegin, {}), asStamp(kBegin));
    EXPECT_EQ(recorded.stampOf(kBegin + 1h + 4ms, 1h), asStamp(kBegin + 4ms));
    EXPECT_EQ(recorded.stampOf(kBegin - 1h + 8ms, -1h), asStamp(kBegin + 8ms));
    EXPECT_EQ(changes(), (std::vector<Duration>{1h, -2h}));
    EXPECT_EQ(timeline.wallOf(asStamp(kBegin + 8ms)), kBegin - 1h + 8ms);
}

TEST_F(RecordedClockTest, SeesAClockThatGoesBack) {
    EXPECT_EQ(recorded.stampOf(kBegin, {}), asStamp(kBegin));
    EXPECT_EQ(recorded.stampOf(kBegin - 1h, {}), asStamp(kBegin));
    EXPECT_EQ(recorded.stampOf(kBegin - 1h + 4ms, {}), asStamp(kBegin + 4ms));
    EXPECT_EQ(changes(), std::vector<Duration>{-1h});
    EXPECT_EQ(timeline.wallOf(asStamp(kBegin + 4ms)), kBegin - 1h + 4ms);
}

TEST_F(RecordedClockTest, KeepsOneTimeWhereTwoClocksTakeTurns) {
    for (int i = 0; i < 1000; ++i) {
        const Duration at = i * 4ms;
        const Stamp stamp = recorded.stampOf(kBegin + at - (i % 2 == 0 ? 0s : 5s), {});
        EXPECT_LE(std::chrono::abs(stamp - asStamp(kBegin + at)), 8ms) << i;
    }
}

TEST_F(RecordedClockTest, LeavesAloneWhatIsOnlyOutOfOrder) {
    for (const Duration at : {0ms, 900ms, 100ms, 800ms, 5000ms, 4001ms}) {
        EXPECT_EQ(recorded.stampOf(kBegin + at, {}), asStamp(kBegin + at));
    }
    EXPECT_TRUE(changes().empty());
}

TEST_F(RecordedClockTest, TakesMonthsForAClockThatWasSetForward) {
    EXPECT_EQ(recorded.stampOf(kBegin, {}), asStamp(kBegin));
    EXPECT_EQ(recorded.stampOf(kBegin + 100h, {}), asStamp(kBegin + 100h)) << "somebody left it running";
    EXPECT_EQ(recorded.stampOf(kBegin + 10'000h, {}), asStamp(kBegin + 100h));
    EXPECT_EQ(recorded.stampOf(kBegin + 10'000h + 4ms, {}), asStamp(kBegin + 100h + 4ms));
    EXPECT_EQ(changes(), std::vector<Duration>{9'900h});
}

TEST_F(RecordedClockTest, GivesStampsThatCanBeSubtractedWhateverAFileSays) {
    const std::int64_t most = INT64_MAX;
    const std::vector<Duration> sets{Duration(0),        Duration(most),           Duration(-most),
                                     Duration(most / 2), Duration(9'000'000'000s), Duration(-9'000'000'000s)};
    const std::vector<WallTime> times{kBegin, kBegin - 4'000'000'000s, kBegin + 4'000'000'000s,
                                      WallTime(9'151'487'999s), WallTime(-7'258'118'400s)};
    std::optional<Stamp> first;
    for (int round = 0; round < 4; ++round) {
        for (const Duration set : sets) {
            for (const WallTime time : times) {
                const Stamp stamp = recorded.stampOf(time, set);
                first = first.value_or(stamp);
                const double apart = static_cast<double>(stamp.time_since_epoch().count()) -
                                     static_cast<double>(first->time_since_epoch().count());
                EXPECT_LT(std::abs(apart), 3e18);
                static_cast<void>(timeline.wallOf(stamp));
            }
        }
    }
}

TEST_F(RecordedClockTest, ChangesNothingForWhatComesAfterTheFile) {
    EXPECT_EQ(recorded.stampOf(kBegin, {}), asStamp(kBegin));
    EXPECT_EQ(recorded.stampOf(kBegin - 1h, {}), asStamp(kBegin));
    recorded.end();
    EXPECT_EQ(timeline.wallOf(asStamp(kBegin + 1s)), kBegin + 1s);
    EXPECT_EQ(changes().back(), Duration::zero()) << "nothing that anybody did";
}

/// What was received while the clock was set is on the same time line when it is read again.
TEST(RecordedTime, IsGivenBackWithBothClocks) {
    PacketLog log;
    const Stamp begin = asStamp(kBegin);
    const SenderId sender = log.senders().intern({"10.0.0.2:40001", Transport::Udp, 9763});
    log.timeline().add({begin - 1s, 7s, 7s}); // before the recording
    log.timeline().add({begin + 2s, -1h, -1h - 7s});
    log.timeline().add({begin + 4s, 1ns, 1h + 1ns});
    std::vector<Stamp> stamps;
    for (int i = 0; i < 6; ++i) {
        stamps.push_back(begin + i * 1s);
        log.writer().append(poseDatagram(static_cast<std::uint32_t>(i)),
                            {.stamp = stamps.back(), .sender = sender, .flags = {.stampedByKernel = true}});
    }
    log.writer().publish();
    MemorySink sink;
    Recorder recorder(log, sink);
    ASSERT_TRUE(recorder.begin({}));
    ASSERT_TRUE(recorder.finish());

    Timeline timeline;
    RecordedClock clock(timeline);
    BytesSource source(sink.bytes);
    std::size_t count = 0;
    ASSERT_TRUE(readFile(source, [&](const FileRecord& record) {
        const Stamp stamp = clock.stampOf(*record.time, record.setBy);
        EXPECT_EQ(record.time, log.timeline().wallOf(stamps[count]));
        EXPECT_EQ(stamp, stamps[count] + 7s) << "a recording begins as the wall clock";
        EXPECT_EQ(timeline.wallOf(stamp), *record.time);
        EXPECT_TRUE(record.comments.empty());
        ++count;
    }));
    EXPECT_EQ(count, 6U);
    EXPECT_EQ(timeline.stepCount(), 2U);
}

} // namespace
} // namespace posewire::log
