// SPDX-License-Identifier: MIT
#include "core/model/accounting/nominal_rate.h"

#include <gtest/gtest.h>

namespace posewire::model {
namespace {

TEST(NominalRate, IsUnknownBeforeHalfASecond) {
    NominalRate rate;
    for (std::uint32_t sample = 0; sample <= 100; ++sample) {
        rate.add(sample, 1000 + sample * 1000 / 240);
    }
    EXPECT_FALSE(rate.frameHz().has_value());
}

TEST(NominalRate, FindsWholeRatesInSpiteOfWholeMilliseconds) {
    for (const std::uint32_t hz : {24U, 60U, 100U, 120U, 240U}) {
        NominalRate rate;
        for (std::uint32_t sample = 0; sample <= 2 * hz; ++sample) {
            rate.add(sample, 5000 + sample * 1000 / hz);
        }
        ASSERT_TRUE(rate.frameHz().has_value());
        EXPECT_EQ(*rate.frameHz(), hz);
    }
}

TEST(NominalRate, TellsBroadcastRatesFromWholeOnes) {
    NominalRate rate;
    for (std::uint32_t sample = 0; sample <= 1200; ++sample) {
        rate.add(sample, static_cast<std::uint32_t>(sample * 1001.0 / 60.0));
    }
    EXPECT_NEAR(*rate.frameHz(), 59.94, 0.01);
}

TEST(NominalRate, KeepsTheRateOverLostSamples) {
    NominalRate rate;
    for (std::uint32_t sample = 0; sample <= 480; sample += sample % 7 + 1) {
        rate.add(sample, sample * 1000 / 240);
    }
    EXPECT_EQ(*rate.frameHz(), 240);
}

TEST(NominalRate, BeginsAnewAfterAJumpOfTheTimeCode) {
    NominalRate rate;
    for (std::uint32_t sample = 0; sample <= 480; ++sample) {
        rate.add(sample, sample * 1000 / 240);
    }
    rate.add(481, 900'000);
    EXPECT_FALSE(rate.frameHz().has_value());
    for (std::uint32_t sample = 482; sample <= 900; ++sample) {
        rate.add(sample, 900'000 + (sample - 481) * 1000 / 240);
    }
    EXPECT_EQ(*rate.frameHz(), 240);
}

TEST(NominalRate, SurvivesAFrozenTimeCode) {
    NominalRate rate;
    for (std::uint32_t sample = 0; sample <= 10'000; ++sample) {
        rate.add(sample, 0);
    }
    EXPECT_FALSE(rate.frameHz().has_value());
}

} // namespace
} // namespace posewire::model
