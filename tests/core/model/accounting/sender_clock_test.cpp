// SPDX-License-Identifier: MIT
#include "core/model/accounting/sender_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

constexpr log::Stamp sentAt(log::Duration time) {
    return log::Stamp(time);
}

/// J(i) = J(i-1) + (|D(i-1,i)| - J(i-1)) / 16 with D the difference of transit times (RFC 3550 §6.4.1).
double referenceJitter(const std::vector<SenderClock::Sample>& samples) {
    double jitter = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double received = log::millisecondsOf(samples[i].stamp - samples[i - 1].stamp);
        const double sent = static_cast<std::int32_t>(samples[i].timeCode - samples[i - 1].timeCode);
        jitter += (std::abs(received - sent) - jitter) / 16;
    }
    return jitter;
}

/// 100 samples a second, each up to 8 ms under way.
std::vector<SenderClock::Sample> jitteryStream(std::uint32_t firstTimeCode, std::size_t count) {
    std::mt19937 random(21);
    std::vector<SenderClock::Sample> samples;
    for (std::size_t i = 0; i < count; ++i) {
        const auto number = static_cast<std::uint32_t>(i);
        const log::Duration delay = std::chrono::microseconds(random() % 8'000);
        samples.push_back({sentAt(10s + number * 10ms + delay), 500 + number, firstTimeCode + number * 10});
    }
    return samples;
}

SenderClock clockOf(const std::vector<SenderClock::Sample>& samples) {
    SenderClock clock;
    for (const SenderClock::Sample& sample : samples) {
        clock.add(sample);
    }
    return clock;
}

TEST(SenderClock, HasTheJitterOfRfc3550) {
    const auto samples = jitteryStream(36'000'000, 500);
    const SenderClock clock = clockOf(samples);
    EXPECT_TRUE(clock.isFromTimeCode());
    EXPECT_NEAR(clock.jitterMs(), referenceJitter(samples), 1e-9);
    EXPECT_GT(clock.jitterMs(), 1);
}

TEST(SenderClock, HasNoneOfASingleSampleOrOfASteadyStream) {
    SenderClock clock;
    EXPECT_EQ(clock.jitterMs(), 0);
    clock.add({sentAt(1s), 7, 100});
    EXPECT_EQ(clock.jitterMs(), 0);
    EXPECT_FALSE(clock.isFromTimeCode()) << "one sample does not show it";
    for (std::uint32_t i = 1; i < 200; ++i) {
        clock.add({sentAt(1s + i * 10ms), 7 + i, 100 + i * 10});
    }
    EXPECT_NEAR(clock.jitterMs(), 0, 1e-9);
    EXPECT_NEAR(clock.differenceMs(), 0, 1e-9);
}

TEST(SenderClock, PassesTheWrapAroundOfTheTimeCode) {
    const auto plain = clockOf(jitteryStream(1'000, 500));
    const auto wrapped = clockOf(jitteryStream(0xfffffc00U, 500));
    EXPECT_DOUBLE_EQ(wrapped.jitterMs(), plain.jitterMs());
    EXPECT_DOUBLE_EQ(wrapped.differenceMs(), plain.differenceMs());
    EXPECT_EQ(wrapped.generation(), 0U);
}

TEST(SenderClock, HasNoJitterOfATimeCodeThatStoodStill) {
    SenderClock clock;
    for (std::uint32_t i = 0; i < 400; ++i) {
        const std::uint32_t code = i >= 200 && i < 250 ? 2'000 : 10 * i;
        clock.add({sentAt(1s + i * 10ms), i, code});
        EXPECT_NEAR(clock.jitterMs(), 0, 1e-9) << "sample " << i;
    }
    EXPECT_TRUE(clock.isFromTimeCode());
}

TEST(SenderClock, TakesTheCounterWhereTheTimeCodeIsFrozen) {
    auto samples = jitteryStream(1'000, 500);
    for (SenderClock::Sample& sample : samples) {
        sample.timeCode = 77;
    }
    const SenderClock clock = clockOf(samples);
    EXPECT_FALSE(clock.isFromTimeCode());
    // The counter times its own period is the same clock, once the period is known.
    EXPECT_NEAR(clock.jitterMs(), referenceJitter(jitteryStream(1'000, 500)), 0.1);
}

TEST(SenderClock, TakesTheCounterWhereTheTimeCodeRunsBackwards) {
    auto samples = jitteryStream(1'000'000, 100);
    for (SenderClock::Sample& sample : samples) {
        sample.timeCode = 2'000'000 - sample.timeCode;
    }
    EXPECT_FALSE(clockOf(samples).isFromTimeCode());
}

TEST(SenderClock, BeginsAnotherGenerationWhereTheTimeCodeJumpsByMoreThanAMinute) {
    for (const std::int32_t jumpMs : {60'000, -60'000, 60'001, -60'001, 3'600'000}) {
        SenderClock clock;
        clock.add({sentAt(10s), 1, 5'000'000});
        clock.add({sentAt(10s), 2, 5'000'000 + static_cast<std::uint32_t>(jumpMs)});
        EXPECT_EQ(clock.generation(), std::abs(jumpMs) > 60'000 ? 1U : 0U) << jumpMs;
    }
}

TEST(SenderClock, BeginsAnotherGenerationWhereTheTimeCodeJumpsByHalfOfAllThereAre) {
    SenderClock clock;
    clock.add({sentAt(10s), 1, 0});
    clock.add({sentAt(10s), 2, 0x80000000U}); // its difference has no opposite of 32 bits
    EXPECT_EQ(clock.generation(), 1U);
}

TEST(SenderClock, KeepsItsJitterThroughAJumpOfTheTimeCode) {
    auto samples = jitteryStream(5'000'000, 400);
    SenderClock clock = clockOf(samples);
    const double before = clock.jitterMs();
    clock.add({sentAt(15s), 10'000, 90'000'000});
    EXPECT_EQ(clock.jitterMs(), before);
    EXPECT_EQ(clock.differenceMs(), 0);
    clock.add({sentAt(15'010ms), 10'001, 90'000'010});
    EXPECT_NEAR(clock.jitterMs(), before * 15 / 16, 1e-9);
}

TEST(SenderClock, OneCorruptTimeCodeIsNoJitter) {
    const auto clean = jitteryStream(5'000'000, 400);
    const double jitter = clockOf(clean).jitterMs();
    for (const std::uint32_t off : {1U << 10U, 1U << 15U, 1U << 30U}) {
        auto samples = clean;
        samples[390].timeCode ^= off;
        EXPECT_NEAR(clockOf(samples).jitterMs(), jitter, 0.5) << off;
    }
}

TEST(SenderClock, FollowsATimeCodeThatHasJumpedOnceASecondSampleSaysSo) {
    SenderClock clock = clockOf(jitteryStream(5'000'000, 400));
    const double before = clock.jitterMs();
    const auto last = jitteryStream(5'000'000, 400).back();
    for (std::uint32_t i = 1; i <= 3; ++i) {
        clock.add({last.stamp + i * 10ms, last.sample + i, last.timeCode + 2'000 + 10 * i});
    }
    EXPECT_LE(clock.jitterMs(), before + 1);
    EXPECT_EQ(clock.generation(), 1U);
}

TEST(SenderClock, ForgetsTheDifferenceAtARestart) {
    SenderClock clock;
    clock.add({sentAt(1s), 1, 0});
    clock.add({sentAt(2s), 2, 990});
    EXPECT_NEAR(clock.differenceMs(), 10, 1e-9);
    clock.restart();
    EXPECT_EQ(clock.differenceMs(), 0);
    EXPECT_EQ(clock.generation(), 1U);
    clock.add({sentAt(3s), 1, 12'345});
    clock.add({sentAt(4s), 2, 13'350});
    EXPECT_NEAR(clock.differenceMs(), -5, 1e-9);
}

TEST(SenderClock, TakesASampleThatComesAgainForNoEvidence) {
    SenderClock clock;
    clock.add({sentAt(1s), 5, 50});
    clock.add({sentAt(1s + 1ms), 5, 50});
    EXPECT_FALSE(clock.isFromTimeCode());
    clock.add({sentAt(1s + 10ms), 6, 60});
    EXPECT_TRUE(clock.isFromTimeCode());
}

/// Differences of a clock that gains `ppm` and whose samples are up to 20 ms under way.
ClockSkew fitted(double ppm, log::Duration span, log::Duration apart) {
    std::mt19937 random(3);
    ClockFit fit(span);
    for (log::Duration time{}; time <= span; time += apart) {
        const double delayMs = random() % 4 == 0 ? 0.0 : static_cast<double>(random() % 20'000) / 1'000;
        fit.add(sentAt(50s + time), 123.0 + delayMs - ppm * 1e-3 * log::secondsOf(time));
    }
    return fit.skew();
}

TEST(ClockFit, FindsTheSkewBelowTheDelays) {
    for (const double ppm : {-400.0, -20.0, 0.0, 50.0, 1'000.0}) {
        const ClockSkew skew = fitted(ppm, 120s, 10ms);
        EXPECT_NEAR(skew.skewPpm, ppm, 5) << ppm;
        EXPECT_NEAR(skew.driftMs, ppm * 0.12, 1) << ppm;
    }
}

TEST(ClockFit, SaysNothingOfTheFirstSeconds) {
    // Eight parts of 250 ms sentAt least.
    EXPECT_EQ(fitted(500, 1'500ms, 10ms).skewPpm, 0);
    EXPECT_EQ(fitted(500, 1'500ms, 10ms).driftMs, 0);
    EXPECT_NEAR(fitted(500, 2'490ms, 10ms).skewPpm, 500, 1);
}

/// Ten seconds of samples that are all held up, by up to 300 ms.
ClockSkew fittedThroughUnrest(double ppm) {
    std::mt19937 random(5);
    ClockFit fit(10s);
    for (log::Duration time{}; time <= 10s; time += 100ms) {
        const double delayMs = static_cast<double>(random() % 300);
        fit.add(sentAt(50s + time), delayMs - ppm * 1e-3 * log::secondsOf(time));
    }
    return fit.skew();
}

TEST(ClockFit, SaysNothingWhileItsErrorIsMoreThanClocksDiffer) {
    for (const double ppm : {-20.0, 0.0, 50.0}) {
        const ClockSkew skew = fittedThroughUnrest(ppm);
        EXPECT_EQ(skew.skewPpm, 0) << ppm;
        EXPECT_EQ(skew.driftMs, 0) << ppm;
    }
    // Whoever plays at half the speed is told so all the same.
    EXPECT_NEAR(fittedThroughUnrest(-500'000).skewPpm, -500'000, 25'000);
}

TEST(ClockFit, TakesNoLessWorkAtTheEndForADriftOfClocks) {
    for (const log::Duration span : {10s, 60s}) {
        ClockFit fit(span);
        for (log::Duration time{}; time <= span; time += 10ms) {
            fit.add(sentAt(50s + time), 0.04 * log::secondsOf(time) / log::secondsOf(span)); // 40 µs in all
        }
        EXPECT_EQ(fit.skew().skewPpm, 0);
        EXPECT_NEAR(fit.skew().errorPpm, 50 / log::secondsOf(span), 0.5);
    }
    EXPECT_NE(fitted(20, 60s, 10ms).skewPpm, 0) << "clocks that differ as clocks do";
}

TEST(TimeCodeStep, IsThatOfTheClockAtMidnightToo) {
    constexpr std::uint32_t day = 86'400'000;
    EXPECT_EQ(timeCodeStep(1'000, 1'017), 17);
    EXPECT_EQ(timeCodeStep(1'017, 1'000), -17);
    EXPECT_EQ(timeCodeStep(day - 1, 16), 17);
    EXPECT_EQ(timeCodeStep(day - 10'000, 20'000), 30'000);
    EXPECT_EQ(timeCodeStep(UINT32_MAX, 16), 17) << "as the counter of milliseconds that it may be";
    EXPECT_EQ(timeCodeStep(day + 1'000, day - 3'600'000), -3'601'000) << "a jump";
    EXPECT_EQ(timeCodeStep(2 * day, day), -static_cast<std::int32_t>(day)) << "no time of day";
}

TEST(ClockFit, SaysNothingWithoutTime) {
    EXPECT_EQ(ClockFit(10s).skew().skewPpm, 0);
    ClockFit one(10s);
    one.add(sentAt(1s), 5);
    EXPECT_EQ(one.skew().skewPpm, 0);
    ClockFit still(10s);
    for (int i = 0; i < 100; ++i) {
        still.add(sentAt(1s), i);
    }
    EXPECT_EQ(still.skew().skewPpm, 0);
    EXPECT_EQ(still.skew().driftMs, 0);
}

} // namespace
} // namespace posewire::model
