// SPDX-License-Identifier: MIT
#include "core/model/stream_statistics.h"

#include <gtest/gtest.h>

namespace posewire::model {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

StreamStatistics steady(int count, double rateHz, std::uint32_t step = 1) {
    StreamStatistics statistics;
    for (int i = 0; i < count; ++i) {
        statistics.add(static_cast<std::int64_t>(i * 1e9 / rateHz), 760, static_cast<std::uint32_t>(i) * step,
                       true);
    }
    return statistics;
}

TEST(StreamStatistics, IsSilentBeforeTheSecondSample) {
    StreamStatistics statistics;
    EXPECT_EQ(statistics.rateHz(), 0);
    statistics.add(5, 760, 1, true);
    EXPECT_EQ(statistics.rateHz(), 0);
    EXPECT_EQ(statistics.spacing().most, 0);
    EXPECT_EQ(statistics.bytesPerSecond(), 0);
}

TEST(StreamStatistics, MeasuresRateAndBandwidthFromStamps) {
    const StreamStatistics statistics = steady(2'000, 240);
    EXPECT_NEAR(statistics.rateHz(), 240, 0.01);
    EXPECT_NEAR(statistics.bytesPerSecond(), 240 * 760, 10);
    EXPECT_NEAR(statistics.spacing().deviation, 0, 2);
    EXPECT_EQ(statistics.datagrams(), 2'000U);
}

TEST(StreamStatistics, FollowsASlowStream) {
    EXPECT_NEAR(steady(5, 0.2).rateHz(), 0.2, 1e-6);
}

TEST(StreamStatistics, CountsDatagramsOfOneSampleAsOneSample) {
    StreamStatistics statistics;
    for (std::uint32_t sample = 0; sample < 10; ++sample) {
        statistics.add(sample * kSecond, 100, sample, true);
        statistics.add(sample * kSecond + 5, 100, sample, false);
    }
    EXPECT_NEAR(statistics.rateHz(), 1, 1e-6);
    EXPECT_EQ(statistics.datagrams(), 20U);
}

TEST(StreamStatistics, TakesASteadySpacingOfTheCounterForTheStep) {
    const StreamStatistics statistics = steady(100, 60, 4);
    EXPECT_EQ(statistics.step(), 4U);
    EXPECT_EQ(statistics.gaps(), 0U);
}

TEST(StreamStatistics, CountsAGapWhereTheCounterJumps) {
    StreamStatistics statistics = steady(100, 60, 1);
    statistics.add(2 * kSecond, 760, 105, true);
    EXPECT_EQ(statistics.gaps(), 1U);
    EXPECT_EQ(statistics.step(), 1U);
}

TEST(StreamStatistics, HasNoStepWhereSpacingIsIrregular) {
    StreamStatistics statistics;
    constexpr std::uint32_t moves[] = {2, 4, 3, 1};
    std::uint32_t sample = 0;
    for (int i = 0; i < 100; ++i) {
        statistics.add(i * kSecond, 760, sample, true);
        sample += moves[i % 4];
    }
    EXPECT_EQ(statistics.step(), 0U);
    EXPECT_EQ(statistics.gaps(), 0U);
}

TEST(StreamStatistics, DoesNotMindTheCounterWrappingAround) {
    StreamStatistics statistics;
    for (std::uint32_t i = 0; i < 100; ++i) {
        statistics.add(i * kSecond, 760, 0xffffffc0U + i, true);
    }
    EXPECT_EQ(statistics.gaps(), 0U);
}

} // namespace
} // namespace posewire::model
