// SPDX-License-Identifier: MIT
#include "core/model/accounting/stream_figures.h"

#include "tests/core/model/accounting/arrivals.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace posewire::model {

namespace {

using namespace std::chrono_literals;

constexpr log::Stamp kStart(1'700'000'000s);
constexpr std::size_t kBytes = 760;

void send(StreamAccounting& stream, std::uint32_t sample, log::Stamp stamp) {
    wire::Header header;
    header.sampleCounter = sample;
    header.datagramCounter = 0x80;
    header.timeCode = sample * 10;
    addTo(stream, stamp, kBytes, header);
}

/// 100 samples a second for a minute; the samples between 20 s and 21 s in every fourth place are lost.
StreamAccounting minute() {
    StreamAccounting stream;
    for (std::uint32_t i = 0; i < 6000; ++i) {
        if (i / 100 != 20 || i % 4 != 0) {
            send(stream, i, kStart + i * 10ms);
        }
    }
    return stream;
}

TEST(RangeFigures, AreThoseOfTheAccountingWhereThereIsNoRange) {
    const StreamAccounting stream = minute();
    const RangeFigures figures = figuresOf(stream, std::nullopt);
    EXPECT_EQ(figures.counts, stream.counts());
    EXPECT_EQ(figures.counts.lost, 25U);
    EXPECT_EQ(figures.pattern.bursts, 1U);
    EXPECT_NEAR(figures.rate.meanHz, 5974 / 59.99, 1e-6);
    EXPECT_NEAR(figures.rate.leastHz, 75.0, 1.0);
    EXPECT_NEAR(figures.rate.mostHz, 100.0, 1.0);
    EXPECT_GT(figures.rate.deviationHz, 2.0);
}

TEST(RangeFigures, AreOfTheRangeAlone) {
    const StreamAccounting stream = minute();
    const RangeFigures before = figuresOf(stream, TimeRange{kStart + 5s, kStart + 15s});
    EXPECT_EQ(before.counts.lost, 0U);
    EXPECT_EQ(before.counts.samples, 1000U);
    EXPECT_NEAR(before.rate.meanHz, 100.0, 1e-6);
    EXPECT_NEAR(before.rate.leastHz, 100.0, 1e-6);
    EXPECT_NEAR(before.rate.deviationHz, 0.0, 1e-6);
    EXPECT_NEAR(before.rate.bytesPerSecond, 76'000, 1e-3);
    EXPECT_NEAR(before.arrivals.meanMs, 10.0, 1e-9);
    EXPECT_EQ(before.pattern.bursts, 0U);
    const RangeFigures bad = figuresOf(stream, TimeRange{kStart + 20s, kStart + 21s});
    EXPECT_EQ(bad.counts.lost, 25U);
    EXPECT_NEAR(bad.rate.meanHz, 75.0, 1e-6);
    EXPECT_EQ(bad.pattern.bursts, 1U);
    EXPECT_NEAR(bad.pattern.meanBurstSamples, 97, 1e-9);
    EXPECT_NEAR(bad.pattern.burstDensity, 25.0 / 97, 1e-9);
    EXPECT_NEAR(bad.pattern.gapDensity, 0, 1e-9);
}

/// 100 samples a second for a minute; losses 12 apart from 10 s to 12 s, and from 50 s to 51 s, too late to
/// be settled; one alone at 30 s; two malformed at 40 s; a sender's clock that goes 500 ppm faster after 30
/// s.
StreamAccounting troubledMinute() {
    StreamAccounting stream;
    for (std::uint32_t i = 0; i < 6000; ++i) {
        const bool isLost =
            (i >= 1000 && i < 1200 && i % 12 == 0) || i == 3000 || (i >= 5700 && i < 5800 && i % 12 == 0);
        const log::Stamp stamp = kStart + i * 10ms;
        if (i == 4000) {
            stream.addMalformed(stamp);
            stream.addMalformed(stamp);
        }
        if (!isLost) {
            wire::Header header;
            header.sampleCounter = i;
            header.timeCode = i * 10 + (i > 3000 ? (i - 3000) / 200 : 0); // 0.5 ms a second from 30 s on
            addTo(stream, stamp, 760, header);
        }
    }
    return stream;
}

TEST(RangeFigures, TellBurstsAndMalformedOfTheRangeAlone) {
    const StreamAccounting stream = troubledMinute();
    const auto in = [&stream](log::Duration from, log::Duration to) {
        return figuresOf(stream, TimeRange{kStart + from, kStart + to});
    };
    const RangeFigures all = figuresOf(stream, std::nullopt);
    EXPECT_EQ(all.pattern.bursts, 2U);
    EXPECT_EQ(all.malformed, 2U);
    EXPECT_NEAR(all.pattern.gapDensity, 1.0 / (6000 - 181 - 97), 1e-4) << "of the one alone";
    EXPECT_EQ(in(5s, 20s).pattern.bursts, 1U);
    EXPECT_NEAR(in(5s, 20s).pattern.burstDensity, 16.0 / 181, 1e-9);
    EXPECT_EQ(in(20s, 45s).pattern.bursts, 0U);
    EXPECT_NEAR(in(20s, 45s).pattern.gapDensity, 1.0 / 2500, 1e-9);
    EXPECT_EQ(in(45s, 60s).pattern.bursts, 1U);
    EXPECT_EQ(in(20s, 39s).malformed, 0U);
    EXPECT_EQ(in(39s, 41s).malformed, 2U);
}

TEST(RangeFigures, TellTheSkewOfTheRangeAlone) {
    const StreamAccounting stream = troubledMinute();
    const RangeFigures before = figuresOf(stream, TimeRange{kStart, kStart + 29s});
    EXPECT_NEAR(before.clock.skew.skewPpm, 0, 1);
    const RangeFigures after = figuresOf(stream, TimeRange{kStart + 31s, kStart + 60s});
    EXPECT_NEAR(after.clock.skew.skewPpm, 500, 25);
    EXPECT_NEAR(after.clock.skew.driftMs, 0.5 * 29, 1);
    const RangeFigures moment = figuresOf(stream, TimeRange{kStart + 31s, kStart + 32s});
    EXPECT_EQ(moment.clock.skew.skewPpm, 0) << "too short to tell";
}

TEST(RangeFigures, KeepTheRateOfAStreamThatBeganOrEndedWithinTheRange) {
    const StreamAccounting stream = minute();
    const RangeFigures begun = figuresOf(stream, TimeRange{kStart - 30s, kStart + 10s});
    EXPECT_NEAR(begun.rate.meanHz, 100.0, 0.1);
    const RangeFigures ended = figuresOf(stream, TimeRange{kStart + 50s, kStart + 90s});
    EXPECT_NEAR(ended.rate.meanHz, 100.0, 0.1);
}

TEST(RangeFigures, AreZeroOfATimeWithoutTheStream) {
    const StreamAccounting stream = minute();
    const RangeFigures figures = figuresOf(stream, TimeRange{kStart - 30s, kStart - 20s});
    EXPECT_EQ(figures.counts.datagrams, 0U);
    EXPECT_EQ(figures.rate.meanHz, 0.0);
    EXPECT_EQ(figures.rate.mostHz, 0.0);
    const RangeFigures none = figuresOf(StreamAccounting(), std::nullopt);
    EXPECT_EQ(none.rate.meanHz, 0.0);
}

TEST(RangeFigures, OfTypesWithoutSamplesCountDatagrams) {
    StreamAccounting stream(12);
    for (std::uint32_t i = 0; i < 11; ++i) {
        send(stream, 0, kStart + i * 1s);
    }
    EXPECT_NEAR(figuresOf(stream, std::nullopt).rate.meanHz, 1.0, 1e-9);
}

TEST(RangeParts, CoverTheRangeInWholeBuckets) {
    const TimeRange range{kStart + 30ms, kStart + 61s};
    const RangeParts parts = partsOf(range, 60, 1s, 100ms);
    EXPECT_EQ(parts.first.time_since_epoch() % 100ms, 0s);
    EXPECT_LE(parts.first, range.from);
    EXPECT_EQ(parts.width % 100ms, 0s);
    EXPECT_LE(parts.count, 60U);
    EXPECT_GE(parts.beginOf(parts.count), range.to);
    EXPECT_EQ(partsOf({log::Stamp(5ns), log::Stamp(5ns)}, 60, 1s, 100ms).count, 0U);
}

TEST(RangeParts, HaveAllThatTheStreamHas) {
    const StreamAccounting stream = minute();
    const RangeParts parts =
        partsOf({stream.firstStamp(), stream.lastStamp() + 1ns}, 50, 1s, stream.resolution());
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
