// SPDX-License-Identifier: MIT
#include "core/model/accounting/stream.h"

#include <gtest/gtest.h>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

void addSample(StreamStatistics& statistics, log::Stamp stamp) {
    statistics.add(stamp);
    statistics.addSample(stamp);
}

StreamStatistics steady(int count, double rateHz) {
    StreamStatistics statistics;
    for (int i = 0; i < count; ++i) {
        addSample(statistics, log::stampOf(static_cast<std::int64_t>(i * 1e9 / rateHz)));
    }
    return statistics;
}

TEST(StreamStatistics, IsSilentBeforeTheSecondSample) {
    StreamStatistics statistics;
    EXPECT_EQ(statistics.rateHz(), 0);
    addSample(statistics, log::Stamp(5ns));
    EXPECT_EQ(statistics.rateHz(), 0);
}

TEST(StreamStatistics, MeasuresTheRateFromStamps) {
    const StreamStatistics statistics = steady(2'000, 240);
    EXPECT_NEAR(statistics.rateHz(), 240, 0.01);
}

TEST(StreamStatistics, FollowsASlowStream) {
    EXPECT_NEAR(steady(5, 0.2).rateHz(), 0.2, 1e-6);
}

TEST(StreamStatistics, CountsDatagramsOfOneSampleAsOneSample) {
    StreamStatistics statistics;
    for (std::uint32_t sample = 0; sample < 10; ++sample) {
        addSample(statistics, log::Stamp(sample * 1s));
        statistics.add(log::Stamp(sample * 1s + 5ns));
    }
    EXPECT_NEAR(statistics.rateHz(), 1, 1e-6);
}

} // namespace
} // namespace posewire::model
