// SPDX-License-Identifier: MIT
#include "core/model/range_figures.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace posewire::model {

namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kStart = 1'700'000'000 * kSecond;
constexpr std::size_t kBytes = 760;

void send(StreamAccounting& stream, std::uint32_t sample, std::int64_t stampNs) {
    wire::Header header;
    header.sampleCounter = sample;
    header.datagramCounter = 0x80;
    header.timeCode = sample * 10;
    stream.add(stampNs, kBytes, header);
}

/// 100 samples a second for a minute; the samples between 20 s and 21 s in every fourth place are lost.
StreamAccounting minute() {
    StreamAccounting stream;
    for (std::uint32_t i = 0; i < 6000; ++i) {
        if (i / 100 != 20 || i % 4 != 0) {
            send(stream, i, kStart + i * 10 * kMs);
        }
    }
    return stream;
}

TEST(RangeFigures, AreThoseOfTheAccountingWhereThereIsNoRange) {
    const StreamAccounting stream = minute();
    const RangeFigures figures = figuresOf(stream, std::nullopt);
    EXPECT_EQ(figures.counts, stream.counts());
    EXPECT_EQ(figures.counts.lost, 25U);
    EXPECT_TRUE(figures.pattern.has_value());
    EXPECT_NEAR(figures.rate.meanHz, 5974 / 59.99, 1e-6);
    EXPECT_NEAR(figures.rate.leastHz, 75.0, 1.0);
    EXPECT_NEAR(figures.rate.mostHz, 100.0, 1.0);
    EXPECT_GT(figures.rate.deviationHz, 2.0);
}

TEST(RangeFigures, AreOfTheRangeAlone) {
    const StreamAccounting stream = minute();
    const RangeFigures before = figuresOf(stream, TimeRange{kStart + 5 * kSecond, kStart + 15 * kSecond});
    EXPECT_EQ(before.counts.lost, 0U);
    EXPECT_EQ(before.counts.samples, 1000U);
    EXPECT_NEAR(before.rate.meanHz, 100.0, 1e-6);
    EXPECT_NEAR(before.rate.leastHz, 100.0, 1e-6);
    EXPECT_NEAR(before.rate.deviationHz, 0.0, 1e-6);
    EXPECT_NEAR(before.rate.bytesPerSecond, 76'000, 1e-3);
    EXPECT_NEAR(before.arrivals.meanMs, 10.0, 1e-9);
    EXPECT_FALSE(before.pattern.has_value());
    const RangeFigures bad = figuresOf(stream, TimeRange{kStart + 20 * kSecond, kStart + 21 * kSecond});
    EXPECT_EQ(bad.counts.lost, 25U);
    EXPECT_NEAR(bad.rate.meanHz, 75.0, 1e-6);
}

TEST(RangeFigures, KeepTheRateOfAStreamThatBeganOrEndedWithinTheRange) {
    const StreamAccounting stream = minute();
    const RangeFigures begun = figuresOf(stream, TimeRange{kStart - 30 * kSecond, kStart + 10 * kSecond});
    EXPECT_NEAR(begun.rate.meanHz, 100.0, 0.1);
    const RangeFigures ended = figuresOf(stream, TimeRange{kStart + 50 * kSecond, kStart + 90 * kSecond});
    EXPECT_NEAR(ended.rate.meanHz, 100.0, 0.1);
}

TEST(RangeFigures, AreZeroOfATimeWithoutTheStream) {
    const StreamAccounting stream = minute();
    const RangeFigures figures = figuresOf(stream, TimeRange{kStart - 30 * kSecond, kStart - 20 * kSecond});
    EXPECT_EQ(figures.counts.datagrams, 0U);
    EXPECT_EQ(figures.rate.meanHz, 0.0);
    EXPECT_EQ(figures.rate.mostHz, 0.0);
    const RangeFigures none = figuresOf(StreamAccounting(), std::nullopt);
    EXPECT_EQ(none.rate.meanHz, 0.0);
}

TEST(RangeFigures, OfTypesWithoutSamplesCountDatagrams) {
    StreamAccounting stream(12);
    for (std::uint32_t i = 0; i < 11; ++i) {
        send(stream, 0, kStart + i * kSecond);
    }
    EXPECT_NEAR(figuresOf(stream, std::nullopt).rate.meanHz, 1.0, 1e-9);
}

TEST(RangeParts, CoverTheRangeInWholeBuckets) {
    const TimeRange range{kStart + 30 * kMs, kStart + 61 * kSecond};
    const RangeParts parts = partsOf(range, 60, kSecond, 100 * kMs);
    EXPECT_EQ(parts.firstNs % (100 * kMs), 0);
    EXPECT_LE(parts.firstNs, range.fromNs);
    EXPECT_EQ(parts.widthNs % (100 * kMs), 0);
    EXPECT_LE(parts.count, 60U);
    EXPECT_GE(parts.beginOf(parts.count), range.toNs);
    EXPECT_EQ(partsOf({5, 5}, 60, kSecond, 100 * kMs).count, 0U);
}

TEST(RangeParts, HaveAllThatTheStreamHas) {
    const StreamAccounting stream = minute();
    const RangeParts parts =
        partsOf({stream.firstStampNs(), stream.lastStampNs() + 1}, 50, kSecond, stream.resolutionNs());
    std::array<RangePart, 50> counted{};
    addParts(stream, parts, counted);
    RangePart sum;
    for (const RangePart& part : counted) {
        sum += part;
    }
    EXPECT_EQ(sum.datagrams, 5975U);
    EXPECT_EQ(sum.samples, 5975U);
    EXPECT_EQ(sum.lost, 25U);
}

} // namespace

} // namespace posewire::model
