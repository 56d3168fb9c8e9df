// SPDX-License-Identifier: MIT
#include "core/model/accounting/sample_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

namespace posewire::model {
namespace {

using Differences = std::vector<std::uint32_t>;

/// `count` differences of a value, appended.
void put(Differences& differences, std::size_t count, std::uint32_t value) {
    differences.insert(differences.end(), count, value);
}

Differences newest64(const Differences& differences) {
    const std::size_t kept = std::min<std::size_t>(differences.size(), 64);
    return {differences.end() - static_cast<std::ptrdiff_t>(kept), differences.end()};
}

std::size_t multiplesOf(std::uint32_t step, const Differences& differences) {
    return static_cast<std::size_t>(
        std::ranges::count_if(differences, [step](std::uint32_t value) { return value % step == 0; }));
}

/// The rule as the interfaces state it: the most frequent of the last 64; at least 40 % are equal to it and
/// at least 90 % multiples of it.
std::uint32_t referenceStep(const Differences& differences) {
    const Differences looked = newest64(differences);
    std::map<std::uint32_t, std::size_t> counts;
    for (const std::uint32_t value : looked) {
        ++counts[value];
    }
    std::uint32_t step = 0;
    std::size_t most = 0;
    for (const auto& [value, count] : counts) { // the smallest of equally frequent ones comes first
        if (count > most) {
            step = value;
            most = count;
        }
    }
    const bool isFound =
        most * 100 >= looked.size() * 40 && multiplesOf(step, looked) * 100 >= looked.size() * 90;
    return !looked.empty() && isFound ? step : 0;
}

/// It stays the step until its multiples fall below 60 % or its own share below 20 %.
bool referenceHolds(const Differences& differences, std::uint32_t step) {
    const Differences looked = newest64(differences);
    const auto own = static_cast<std::size_t>(std::ranges::count(looked, step));
    return own * 100 >= looked.size() * 20 && multiplesOf(step, looked) * 100 >= looked.size() * 60;
}

/// Differences as a lossy, a decimated, or an irregular sender makes them.
Differences randomDifferences(std::mt19937& random) {
    const auto below = [&random](std::uint32_t end) { return static_cast<std::uint32_t>(random() % end); };
    const std::uint32_t step = 1 + below(6);
    const std::uint32_t oddPercent = below(60);
    const std::uint32_t lostPercent = below(90);
    Differences differences(1 + below(130));
    for (std::uint32_t& difference : differences) {
        difference = step;
        while (below(100) < lostPercent) {
            difference += step;
        }
        if (below(100) < oddPercent) {
            difference = 1 + below(9);
        }
    }
    return differences;
}

TEST(FindStep, FollowsTheRuleOnRandomStreams) {
    std::mt19937 random(11);
    std::size_t regular = 0;
    for (int round = 0; round < 4'000; ++round) {
        const Differences differences = randomDifferences(random);
        const std::uint32_t expected = referenceStep(differences);
        ASSERT_EQ(findStep(differences), expected) << "round " << round;
        regular += expected != 0 ? 1 : 0;
    }
    EXPECT_GT(regular, 500U) << "else this says nothing of steps that are found";
    EXPECT_LT(regular, 3'500U);
}

TEST(HoldsStep, FollowsTheRuleOnRandomStreams) {
    std::mt19937 random(12);
    std::size_t held = 0;
    for (int round = 0; round < 4'000; ++round) {
        const Differences differences = randomDifferences(random);
        const auto step = static_cast<std::uint32_t>(1 + random() % 6);
        ASSERT_EQ(holdsStep(differences, step), referenceHolds(differences, step)) << "round " << round;
        held += holdsStep(differences, step) ? 1 : 0;
    }
    EXPECT_GT(held, 200U);
    EXPECT_LT(held, 3'800U);
}

TEST(FindStep, HasNoneWithoutDifferences) {
    EXPECT_EQ(findStep({}), 0U);
    EXPECT_EQ(nextStep({}, 0), 0U);
    const Differences one{7};
    EXPECT_EQ(findStep(one), 7U);
}

TEST(FindStep, TakesTheSmallestOfEquallyFrequentOnes) {
    Differences differences;
    for (int i = 0; i < 32; ++i) {
        differences.push_back(6);
        differences.push_back(3);
    }
    EXPECT_EQ(findStep(differences), 3U);
}

TEST(FindStep, LooksAtTheNewestSixtyFourOnly) {
    Differences differences;
    put(differences, 200, 7);
    put(differences, 64, 2);
    EXPECT_EQ(findStep(differences), 2U);
    std::rotate(differences.begin(), differences.end() - 64, differences.end());
    EXPECT_EQ(findStep(differences), 7U);
}

TEST(FindStep, NeedsFortyAndNinetyPercentExactly) {
    // 26 of 64 are 40.6 %, 25 are 39.1 %; 58 of 64 are 90.6 %, 57 are 89.1 %.
    for (const std::size_t equal : {25U, 26U}) {
        Differences differences;
        put(differences, equal, 2);
        put(differences, 20, 4);
        put(differences, 64 - 20 - equal, 6);
        EXPECT_EQ(findStep(differences), equal == 26 ? 2U : 0U) << equal;
    }
    for (const std::size_t multiples : {57U, 58U}) {
        Differences differences;
        put(differences, multiples, 2);
        put(differences, 64 - multiples, 3);
        EXPECT_EQ(findStep(differences), multiples == 58 ? 2U : 0U) << multiples;
    }
}

TEST(HoldsStep, NeedsTwentyAndSixtyPercentExactly) {
    // 13 of 64 are 20.3 %, 12 are 18.8 %; 39 of 64 are 60.9 %, 38 are 59.4 %.
    for (const std::size_t equal : {12U, 13U}) {
        Differences differences;
        put(differences, equal, 2);
        put(differences, 64 - equal, 4);
        EXPECT_EQ(holdsStep(differences, 2), equal == 13) << equal;
    }
    for (const std::size_t multiples : {38U, 39U}) {
        Differences differences;
        put(differences, multiples, 2);
        put(differences, 64 - multiples, 3);
        EXPECT_EQ(holdsStep(differences, 2), multiples == 39) << multiples;
    }
}

TEST(NextStep, HoldsOnOnlyOnceSixtyFourDifferencesAreKnown) {
    Differences few;
    put(few, 23, 1);
    put(few, 40, 2);
    EXPECT_EQ(nextStep(few, 1), 0U) << "63 differences decide afresh, and 63 % are multiples of 2";
    Differences held;
    put(held, 40, 2);
    put(held, 24, 1);
    EXPECT_EQ(nextStep(held, 1), 1U) << "24 of 64 are 1, which all are multiples of";
    EXPECT_EQ(nextStep(held, 0), 0U) << "62 % are multiples of 2";
}

TEST(NextStep, ComesBackToAStepAfterAnIrregularStretch) {
    Differences differences;
    put(differences, 64, 1);
    std::uint32_t step = nextStep(differences, 0);
    EXPECT_EQ(step, 1U);
    for (std::uint32_t i = 0; i < 64; ++i) {
        differences.push_back(2 + i % 3);
        step = nextStep(differences, step);
    }
    EXPECT_EQ(step, 0U);
    for (int i = 0; i < 64; ++i) {
        differences.push_back(1);
        step = nextStep(differences, step);
    }
    EXPECT_EQ(step, 1U);
}

TEST(PlaceOfChange, IsWhereOneStepFollowsTheOther) {
    for (const auto& [before, after] : {std::pair{1U, 2U}, {2U, 1U}, {4U, 3U}, {2U, 5U}}) {
        for (const std::size_t old : {1U, 20U, 64U, 100U}) {
            Differences differences;
            put(differences, old, before);
            put(differences, 128 - old, after);
            const std::size_t place = placeOfChange(differences, before, after);
            EXPECT_NEAR(static_cast<double>(place), static_cast<double>(old), 1.0)
                << before << " to " << after << " after " << old;
        }
    }
}

TEST(PlaceOfChange, IsNotMovedByASingleLoss) {
    Differences differences;
    put(differences, 50, 1);
    differences[20] = 3; // two samples were lost
    put(differences, 50, 2);
    differences[80] = 6;
    EXPECT_NEAR(static_cast<double>(placeOfChange(differences, 1, 2)), 50.0, 1.0);
}

TEST(PlaceOfChange, FindsTheEndOfAnIrregularStretch) {
    Differences differences;
    for (std::uint32_t i = 0; i < 60; ++i) {
        differences.push_back(2 + i % 3);
    }
    put(differences, 60, 1);
    EXPECT_NEAR(static_cast<double>(placeOfChange(differences, 0, 1)), 60.0, 2.0);
}

} // namespace
} // namespace posewire::model
