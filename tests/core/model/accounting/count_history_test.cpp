// SPDX-License-Identifier: MIT
#include "core/model/accounting/count_history.h"

#include "tests/core/model/accounting/accounting_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <random>
#include <vector>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

/// What was added, all of it.
struct Added {
    log::Stamp stamp;
    CountHistory::Counters change;
};

/// Sums of what was added in [from, to).
StreamCounts sumOf(const std::vector<Added>& all, log::Stamp from, log::Stamp to) {
    StreamCounts sum;
    for (const auto& [stamp, change] : all) {
        if (stamp >= from && stamp < to) {
            sum.datagrams += change.datagrams;
            sum.bytes += change.bytes;
            sum.samples += change.samples;
            sum.lost += change.lost;
            sum.duplicates += change.duplicates;
            sum.reordered += change.reordered;
            sum.late += change.late;
            sum.incomplete += change.incomplete;
            sum.restarts += change.restarts;
        }
    }
    return sum;
}

CountHistory::Counters randomChange(std::mt19937& random) {
    const auto upTo = [&random](std::uint32_t most) {
        return static_cast<std::uint32_t>(random() % (most + 1));
    };
    CountHistory::Counters change;
    change.datagrams = upTo(3);
    change.bytes = upTo(2'168);
    change.samples = upTo(3);
    change.lost = upTo(5);
    change.duplicates = upTo(1);
    change.reordered = upTo(1);
    change.late = upTo(1);
    change.incomplete = upTo(1);
    change.restarts = upTo(1);
    return change;
}

/// Hours of a stream, in steps that are no multiple of a bucket.
class Hours : public testing::TestWithParam<int> {
protected:
    void SetUp() override {
        std::mt19937 random(static_cast<std::uint32_t>(GetParam()));
        log::Stamp stamp = m_begin;
        for (int i = 0; i < 8'000; ++i) {
            stamp += log::Duration(static_cast<std::int64_t>(random() % (GetParam() * 1'000'000'000ULL)));
            add(stamp, randomChange(random));
            if (i > 30 && random() % 50 == 0) { // what was due with an earlier arrival turns out to be lost
                add(m_added[m_added.size() - 1 - random() % 30].stamp, randomChange(random));
            }
        }
        m_end = stamp;
    }
    void add(log::Stamp stamp, const CountHistory::Counters& change) {
        m_history.add(stamp, change);
        m_added.push_back({stamp, change});
    }
    /// The end of the bucket that a stamp lies in.
    [[nodiscard]] log::Stamp aligned(log::Stamp stamp) const {
        const log::Duration width = m_history.width();
        return log::Stamp(stamp.time_since_epoch() / width * width);
    }

    log::Stamp m_begin = at(1'000'003s + 7ms);
    log::Stamp m_end{};
    CountHistory m_history;
    std::vector<Added> m_added;
};

TEST_P(Hours, HaveTheCountsOfAnyRangeOfWholeBuckets) {
    EXPECT_EQ(m_history.countsBetween(log::Stamp::min(), log::Stamp::max()),
              sumOf(m_added, log::Stamp::min(), log::Stamp::max()));
    std::mt19937 random(99);
    const auto seconds = static_cast<std::uint64_t>(log::secondsOf(m_end - m_begin));
    for (int round = 0; round < 100; ++round) {
        const log::Stamp a = aligned(m_begin + std::chrono::seconds(random() % seconds));
        const log::Stamp b = aligned(m_begin + std::chrono::seconds(random() % seconds));
        ASSERT_EQ(m_history.countsBetween(std::min(a, b), std::max(a, b)),
                  sumOf(m_added, std::min(a, b), std::max(a, b)));
        EXPECT_EQ(m_history.countsBetween(std::max(a, b), std::min(a, b)), StreamCounts{});
    }
}

TEST_P(Hours, AddUpInPartsOfAnyWidth) {
    const StreamCounts all = m_history.countsBetween(log::Stamp::min(), log::Stamp::max());
    for (const log::Duration width : std::initializer_list<log::Duration>{7s + 1ns, 61s, 1009s}) {
        StreamCounts sum;
        for (log::Stamp from = m_begin - 1h; from <= m_end; from += width) {
            sum += m_history.countsBetween(from, from + width);
        }
        EXPECT_EQ(sum.datagrams, all.datagrams);
        EXPECT_EQ(sum.bytes, all.bytes);
        EXPECT_EQ(sum.samples, all.samples);
        EXPECT_EQ(sum.lost, all.lost);
        EXPECT_EQ(sum.incomplete, all.incomplete);
    }
}

TEST_P(Hours, AreKeptInBucketsOfTwiceTheWidthAgainAndAgain) {
    const double doublings =
        std::log2(log::secondsOf(m_history.width()) / log::secondsOf(CountHistory::kFirstWidth));
    EXPECT_EQ(doublings, std::round(doublings));
    EXPECT_GE(m_history.width() * static_cast<std::int64_t>(AccountingDepth().buckets), m_end - m_begin);
}

TEST_P(Hours, AreExactToATenthOfASecondWhereTheyAreNew) {
    const log::Duration fine =
        CountHistory::kFirstWidth * static_cast<std::int64_t>(AccountingDepth().buckets / 2);
    std::mt19937 random(7);
    for (int round = 0; round < 100; ++round) {
        const auto any = [&] {
            return model::roundedDown(
                m_end - log::Duration(static_cast<std::int64_t>(random() % 1'000) * fine / 1'000),
                CountHistory::kFirstWidth);
        };
        const log::Stamp a = any();
        const log::Stamp b = any();
        ASSERT_EQ(m_history.countsBetween(std::min(a, b), std::max(a, b)),
                  sumOf(m_added, std::min(a, b), std::max(a, b)));
        EXPECT_EQ(m_history.roundedUp(a), a);
        EXPECT_EQ(m_history.width(a), CountHistory::kFirstWidth);
    }
}

TEST_P(Hours, SayWhereARangeBegins) {
    std::mt19937 random(8);
    for (int round = 0; round < 200; ++round) {
        const log::Stamp from =
            m_begin + (m_end - m_begin) / 1'000 * static_cast<std::int64_t>(random() % 1'000);
        EXPECT_EQ(m_history.countsBetween(from, log::Stamp::max()),
                  sumOf(m_added, m_history.roundedUp(from), log::Stamp::max()));
        EXPECT_LE(m_history.roundedUp(from) - from, m_history.width(from));
    }
}

INSTANTIATE_TEST_SUITE_P(SecondsApart, Hours, testing::Values(1, 4, 12));

TEST(CountHistory, IsExactBetweenEdgesHoweverWideItsBucketsAre) {
    const TimeRange range{log::Stamp(123'456ms), log::Stamp(234'567ms)};
    CountHistory history;
    history.setEdges(range);
    history.setMost(64);
    std::vector<Added> all;
    for (log::Stamp stamp(100s); stamp < log::Stamp(600s); stamp += 7ms) {
        all.push_back({stamp, {.bytes = 3, .datagrams = 1, .samples = 1}});
        history.add(stamp, all.back().change);
    }
    EXPECT_GT(history.width(range.from), 1s);
    EXPECT_EQ(history.countsBetween(range.from, range.to), sumOf(all, range.from, range.to));
    EXPECT_EQ(history.countsBetween(log::Stamp(), range.from), sumOf(all, log::Stamp(), range.from));
}

TEST(CountHistory, IsEmptyBeforeAnythingIsAdded) {
    const CountHistory history;
    EXPECT_EQ(history.countsBetween(log::Stamp::min(), log::Stamp::max()), StreamCounts{});
    EXPECT_EQ(history.arrivalsBetween(log::Stamp::min(), log::Stamp::max()).count, 0U);
    EXPECT_EQ(history.burstsBetween(log::Stamp::min(), log::Stamp::max()).bursts, 0U);
    EXPECT_EQ(history.malformedBetween(log::Stamp::min(), log::Stamp::max()), 0U);
    EXPECT_EQ(history.skewBetween(log::Stamp::min(), log::Stamp::max()).skewPpm, 0);
    EXPECT_EQ(history.jitterMsAt(log::Stamp::max()), 0);
    EXPECT_EQ(history.width(), 100ms);
}

TEST(CountHistory, CountsABucketWhereItBegins) {
    CountHistory history;
    history.add(at(1'050ms), {.datagrams = 1});
    history.add(at(1'150ms), {.datagrams = 2});
    EXPECT_EQ(history.countsBetween(at(1'000ms), at(1'100ms)).datagrams, 1U);
    EXPECT_EQ(history.countsBetween(at(1'001ms), at(1'100ms)).datagrams, 0U);
    EXPECT_EQ(history.countsBetween(at(1'001ms), at(1'101ms)).datagrams, 2U);
    EXPECT_EQ(history.countsBetween(at(1'200ms), at(9'000ms)).datagrams, 0U);
}

TEST(CountHistory, AlignsStampsBeforeTheEpochDownwards) {
    CountHistory history;
    history.add(at(-150ms), {.datagrams = 1});
    history.add(at(-50ms), {.datagrams = 2});
    history.add(at(50ms), {.datagrams = 4});
    EXPECT_EQ(history.countsBetween(at(-200ms), at(-100ms)).datagrams, 1U);
    EXPECT_EQ(history.countsBetween(at(-100ms), at(0ms)).datagrams, 2U);
    EXPECT_EQ(history.countsBetween(at(0ms), at(100ms)).datagrams, 4U);
}

TEST(CountHistory, TakesBackWhatWasNoLoss) {
    CountHistory history;
    history.add(at(1s), {.samples = 1, .lost = 9});
    history.add(at(2s), {.samples = 1});
    history.add(at(3s), {.samples = 1});
    history.add(at(1s), {.lost = 0U - 4U});
    EXPECT_EQ(history.countsBetween(at(1s), at(2s)).lost, 5U);
    EXPECT_EQ(history.countsBetween(at(2s), at(4s)).lost, 0U);
    EXPECT_EQ(history.countsBetween(at(0s), at(4s)).lost, 5U);
}

TEST(CountHistory, CountsWhatIsOlderThanAllInTheFirstBucket) {
    CountHistory history;
    history.add(at(10s), {.samples = 1});
    history.add(at(11s), {.samples = 1});
    history.add(at(5s), {.lost = 3});
    EXPECT_EQ(history.countsBetween(at(10s), at(11s)).lost, 3U);
    EXPECT_EQ(history.countsBetween(at(11s), at(12s)).lost, 0U);
}

TEST(CountHistory, KeepsTheLongestGapOfEachRange) {
    CountHistory history;
    history.addGap(at(1s), 3);
    history.addGap(at(1s), 2);
    history.addGap(at(5s), 7);
    EXPECT_EQ(history.countsBetween(at(0s), at(2s)).longestGapSamples, 3U);
    EXPECT_EQ(history.countsBetween(at(2s), at(5s)).longestGapSamples, 0U);
    EXPECT_EQ(history.countsBetween(at(0s), at(9s)).longestGapSamples, 7U);
    for (int i = 60; i < 7'200; ++i) { // two hours make wider buckets of these
        history.add(at(i * 1s), {.samples = 1});
    }
    EXPECT_EQ(history.countsBetween(at(0s), at(60s)).longestGapSamples, 7U);
    EXPECT_EQ(history.countsBetween(at(60s), at(7'200s)).longestGapSamples, 0U);
}

TEST(CountHistory, MeasuresArrivalsAsAPlainListDoes) {
    CountHistory history;
    std::mt19937 random(5);
    std::vector<double> all;
    log::Stamp stamp = at(100s);
    for (int i = 0; i < 6'000; ++i) {
        const log::Duration since = std::chrono::microseconds(500 + random() % 400'000);
        stamp += since;
        history.addArrival(stamp, since, 0.25 * (i % 8));
        all.push_back(log::millisecondsOf(since));
    }
    const InterArrival read = history.arrivalsBetween(log::Stamp::min(), log::Stamp::max());
    double sum = 0;
    double squares = 0;
    for (const double ms : all) {
        sum += ms;
        squares += ms * ms;
    }
    const double mean = sum / 6'000;
    EXPECT_EQ(read.count, 6'000U);
    EXPECT_NEAR(read.meanMs, mean, 1e-6);
    EXPECT_NEAR(read.deviationMs, std::sqrt(squares / 6'000 - mean * mean), 1e-3);
    EXPECT_NEAR(read.leastMs, *std::ranges::min_element(all), 1e-3);
    EXPECT_NEAR(read.mostMs, *std::ranges::max_element(all), 1e-2);
    EXPECT_NEAR(history.jitterMsAt(log::Stamp::max()), 0.25 * (5'999 % 8), 1e-6);
    EXPECT_EQ(history.jitterMsAt(at(99s)), 0) << "before the first arrival";
    EXPECT_EQ(history.arrivalsBetween(at(0s), at(99s)).count, 0U);
}

TEST(CountHistory, HasNoArrivalsWhereOnlyOtherThingsHappened) {
    CountHistory history;
    history.addArrival(at(1s), 10ms, 1.0);
    history.add(at(2s), {.malformed = 2});
    const InterArrival none = history.arrivalsBetween(at(2s), at(3s));
    EXPECT_EQ(none.count, 0U);
    EXPECT_EQ(none.mostMs, 0);
    EXPECT_EQ(history.malformedBetween(at(2s), at(3s)), 2U);
    EXPECT_EQ(history.malformedBetween(at(1s), at(2s)), 0U);
    EXPECT_EQ(history.jitterMsAt(at(3s)), 1.0) << "it stays what it was";
    EXPECT_EQ(history.skewBetween(at(0s), at(3s)).skewPpm, 0) << "no clock was compared";
}

/// The difference of two clocks, `ppm` of which is the sender's gain, four times a second.
void addClock(CountHistory& history, log::Stamp from, log::Duration span, double ppm,
              std::uint32_t generation) {
    for (log::Stamp stamp = from; stamp < from + span; stamp += 250ms) {
        history.addDifference(stamp, -ppm * 1e-3 * log::secondsOf(stamp - from), generation);
    }
}

TEST(CountHistory, FitsTheClockOfHoursInWiderBuckets) {
    for (const double ppm : {-150.0, -3.0, 0.0, 20.0, 500.0}) {
        CountHistory history;
        addClock(history, at(500s), 3h, ppm, 1);
        const ClockSkew skew = history.skewBetween(log::Stamp::min(), log::Stamp::max());
        EXPECT_GT(history.width(), 5s);
        EXPECT_NEAR(skew.skewPpm, ppm, 0.01 + std::abs(ppm) * 1e-3);
        EXPECT_NEAR(skew.driftMs, ppm * 1e-3 * 10'800, 0.1 + std::abs(ppm) * 0.1);
    }
}

TEST(CountHistory, ASampleThatIsHeldUpAtTheEndIsNoSkew) {
    CountHistory history;
    const auto addSample = [&history](log::Stamp stamp, double differenceMs) {
        history.addArrival(stamp, 4ms, 0);
        history.addDifference(stamp, differenceMs, 1);
    };
    for (log::Stamp stamp = at(100s); stamp < at(111s); stamp += 4ms) {
        addSample(stamp, 0);
    }
    EXPECT_NEAR(history.skewBetween(at(0s), at(200s)).skewPpm, 0, 1e-6);
    addSample(at(111'060ms), 60); // nothing without delay came beside it
    EXPECT_NEAR(history.skewBetween(at(0s), at(200s)).skewPpm, 0, 1e-6);
    EXPECT_NEAR(history.skewBetween(at(0s), at(200s)).driftMs, 0, 1e-6);
}

TEST(CountHistory, FitsTheNewestGenerationOfARangeAlone) {
    CountHistory history;
    addClock(history, at(100s), 60s, 100.0, 1);
    addClock(history, at(160s), 60s, -40.0, 2); // the counter restarted
    EXPECT_NEAR(history.skewBetween(at(0s), at(1'000s)).skewPpm, -40.0, 0.1);
    EXPECT_NEAR(history.skewBetween(at(100s), at(160s)).skewPpm, 100.0, 0.1);
    EXPECT_NEAR(history.skewBetween(at(120s), at(200s)).skewPpm, -40.0, 0.1);
}

TEST(CountHistoryOfFewBuckets, GoesOn) {
    CountHistory history;
    history.setMost(2);
    for (int i = 0; i < 1'000; ++i) {
        history.add(log::Stamp(i * 100ms), {.datagrams = 1});
    }
    EXPECT_EQ(history.countsBetween(log::Stamp(), log::Stamp(1h)).datagrams, 1'000U);
}

} // namespace
} // namespace posewire::model
