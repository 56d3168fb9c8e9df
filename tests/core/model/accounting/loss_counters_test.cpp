// SPDX-License-Identifier: MIT
#include "core/model/accounting/stream_accounting.h"
#include "core/model/accounting/stream_counts.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <set>
#include <tuple>
#include <vector>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

constexpr log::Stamp readAt(log::Duration time) {
    return log::Stamp(time);
}

/// Bursts of a sequence of samples, true for one that arrived: from a loss to a loss with fewer than 16
/// received in a row between, and more than one loss (RFC 3611 §4.7.2).
BurstCounts referenceBursts(const std::vector<bool>& arrived) {
    BurstCounts sum;
    for (std::size_t i = 0; i < arrived.size();) {
        if (arrived[i]) {
            ++i;
            continue;
        }
        std::size_t last = i;
        std::uint64_t lost = 0;
        std::uint64_t receivedInARow = 0;
        std::size_t k = i;
        for (; k < arrived.size() && receivedInARow < 16; ++k) {
            receivedInARow = arrived[k] ? receivedInARow + 1 : 0;
            lost += arrived[k] ? 0 : 1;
            last = arrived[k] ? last : k;
        }
        if (lost > 1) {
            ++sum.bursts;
            sum.lost += lost;
            sum.samples += last - i + 1;
        }
        i = last + 1;
    }
    return sum;
}

void take(const std::optional<LossBursts::Burst>& burst, BurstCounts& sum) {
    if (burst) {
        ++sum.bursts;
        sum.lost += burst->lost;
        sum.samples += burst->samples;
    }
}

BurstCounts burstsOf(const std::vector<bool>& arrived) {
    LossBursts bursts;
    BurstCounts sum;
    std::uint64_t lost = 0;
    for (const bool hasArrived : arrived) {
        lost += hasArrived ? 0 : 1;
        if (hasArrived) {
            take(bursts.add(lost, {}), sum);
            lost = 0;
        }
    }
    take(bursts.endRun(), sum);
    return sum;
}

TEST(LossBursts, AreThoseOfThePlainDefinitionOnRandomStreams) {
    std::mt19937 random(31);
    std::uint64_t found = 0;
    for (int round = 0; round < 300; ++round) {
        const std::uint32_t lossPercent = 1 + static_cast<std::uint32_t>(random() % 30);
        std::vector<bool> arrived(1 + random() % 600);
        for (std::size_t i = 0; i < arrived.size(); ++i) {
            arrived[i] = random() % 100 >= lossPercent;
        }
        arrived.back() = true; // what is lost after the last sample is not known
        const BurstCounts expected = referenceBursts(arrived);
        const BurstCounts bursts = burstsOf(arrived);
        ASSERT_EQ(bursts.bursts, expected.bursts) << round;
        ASSERT_EQ(bursts.lost, expected.lost) << round;
        ASSERT_EQ(bursts.samples, expected.samples) << round;
        found += bursts.bursts;
    }
    EXPECT_GT(found, 500U);
}

TEST(LossBursts, EndWithSixteenReceivedInARow) {
    for (const std::size_t between : {15U, 16U}) {
        std::vector<bool> arrived{true, false};
        arrived.insert(arrived.end(), between, true);
        arrived.push_back(false);
        arrived.push_back(true);
        const BurstCounts bursts = burstsOf(arrived);
        EXPECT_EQ(bursts.bursts, between == 15 ? 1U : 0U) << "two single losses are no burst";
        EXPECT_EQ(bursts.samples, between == 15 ? 17U : 0U);
    }
}

TEST(LossBursts, DoNotReachOverTheEndOfARun) {
    LossBursts bursts;
    EXPECT_FALSE(bursts.add(3, readAt(1s)));
    const auto over = bursts.endRun();
    ASSERT_TRUE(over.has_value());
    EXPECT_EQ(over->lost, 3U);
    EXPECT_EQ(over->end, readAt(1s));
    EXPECT_FALSE(bursts.add(1, readAt(2s)));
    EXPECT_FALSE(bursts.endRun()) << "one alone, in a run of its own";
}

TEST(MessageRounds, CountEveryOrderOfAllPartsWhole) {
    for (const auto& order : {std::vector{0, 1, 2, 3}, {3, 2, 1, 0}, {2, 0, 3, 1}, {1, 3, 0, 2}}) {
        MessageRounds rounds;
        log::Stamp stamp = readAt(1s);
        for (const int part : order) {
            rounds.add(stamp += 1ms, static_cast<std::uint8_t>(part), part == 3,
                       static_cast<std::size_t>(part));
        }
        EXPECT_EQ(rounds.incomplete(), 0U);
        EXPECT_FALSE(rounds.isPartial());
    }
}

TEST(MessageRounds, BelongTogetherWithinAQuarterOfASecondInEitherDirection) {
    for (const auto& [apart, isTogether] : {std::pair<log::Duration, bool>{250ms, true},
                                            {-250ms, true},
                                            {250ms + 1ns, false},
                                            {-250ms - 1ns, false}}) {
        MessageRounds rounds;
        rounds.add(readAt(10s), 0, false, 0);
        EXPECT_EQ(rounds.add(readAt(10s) + apart, 1, true, 1),
                  isTogether ? MessageRounds::Place::GoesOn : MessageRounds::Place::Begins)
            << apart.count();
        EXPECT_EQ(rounds.incomplete(), isTogether ? 0U : 2U) << apart.count();
    }
}

TEST(MessageRounds, KnowNoWholeMessageWithoutItsLastPart) {
    MessageRounds rounds;
    rounds.add(readAt(1s), 0, false, 0);
    rounds.add(readAt(1s), 1, false, 1);
    EXPECT_TRUE(rounds.isPartial());
    EXPECT_EQ(rounds.incomplete(), 1U);
    rounds.add(readAt(1s), 2, true, 2);
    EXPECT_FALSE(rounds.isPartial());
    EXPECT_EQ(rounds.incomplete(), 0U);
}

TEST(MessageRounds, TellThePartsOfBothHalvesOfTheIndexApart) {
    // Indices have 7 bits: 0 and 64 are different parts, and 128 of them make the longest message.
    MessageRounds rounds;
    for (unsigned part = 0; part < 128; ++part) {
        EXPECT_EQ(rounds.add(readAt(1s), static_cast<std::uint8_t>(part), part == 127, part),
                  part == 0 ? MessageRounds::Place::Begins : MessageRounds::Place::GoesOn)
            << part;
        EXPECT_EQ(rounds.incomplete(), part == 127 ? 0U : 1U);
    }
}

TEST(MessageRounds, KnowARepeatedPartByItsBytesForAQuarterOfASecond) {
    for (const auto& [later, digest, place] : {std::tuple<log::Duration, std::size_t, MessageRounds::Place>{
                                                   300us, 7, MessageRounds::Place::Repeats},
                                               {250ms, 7, MessageRounds::Place::Repeats},
                                               {251ms, 7, MessageRounds::Place::Begins},
                                               {20ms, 8, MessageRounds::Place::Begins}}) {
        MessageRounds rounds;
        rounds.add(readAt(1s), 0, false, 7);
        rounds.add(readAt(1s), 1, true, 1);
        EXPECT_EQ(rounds.add(readAt(1s) + later, 0, false, digest), place) << later.count();
        EXPECT_EQ(rounds.incomplete(), place == MessageRounds::Place::Repeats ? 0U : 1U);
    }
}

TEST(MessageRounds, CountRandomMessagesAsAPlainListDoes) {
    std::mt19937 random(8);
    for (int round = 0; round < 50; ++round) {
        MessageRounds rounds;
        std::uint64_t incomplete = 0;
        log::Stamp stamp = readAt(1s);
        for (int message = 0; message < 40; ++message) {
            stamp += 1s;
            const auto parts = 1 + static_cast<unsigned>(random() % 6);
            std::set<unsigned> arrived;
            for (unsigned part = 0; part < parts; ++part) {
                if (random() % 5 != 0) {
                    arrived.insert(part);
                    rounds.add(stamp, static_cast<std::uint8_t>(part), part + 1 == parts, random());
                }
            }
            incomplete += !arrived.empty() && arrived.size() < parts ? 1 : 0;
        }
        ASSERT_EQ(rounds.incomplete(), incomplete);
    }
}

} // namespace
} // namespace posewire::model
