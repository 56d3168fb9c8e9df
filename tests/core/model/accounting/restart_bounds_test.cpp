// SPDX-License-Identifier: MIT
#include "tests/core/model/accounting/accounting_fixture.h"

#include <string>
#include <vector>

/// The counter restarted where it jumped back by more than 100 or forward by more than 3,000 and the next
/// datagrams agree with the new place (RFC 3550, appendix A.1).
namespace posewire::model {
namespace {

constexpr std::uint32_t kBefore = 200; ///< samples sent before a jump, besides the first
constexpr std::uint32_t kAfter = 150;  ///< and after it, besides the one that jumps

/// A stream and where its counter is when it jumps.
struct Place {
    std::string name;
    std::uint32_t counter = 0;
    std::uint32_t step = 1;
};

class RestartBounds : public Accounting, public testing::WithParamInterface<Place> {
protected:
    /// The counter jumps by `distance` and counts on from there in the stream's own step.
    StreamCounts countsAfterJump(std::int32_t distance) {
        const auto [name, counter, step] = GetParam();
        stream = StreamAccounting();
        sendSteady(counter - kBefore * step, counter, step);
        const std::uint32_t next = counter + static_cast<std::uint32_t>(distance);
        sendSteady(next, next + kAfter * step, step);
        return stream.counts();
    }
    /// The nearest counter of the stream that is further away than a bound.
    [[nodiscard]] std::int32_t beyond(std::int32_t bound) const {
        const auto step = static_cast<std::int32_t>(GetParam().step);
        return bound / step * step + step;
    }
    [[nodiscard]] std::uint32_t steps(std::int32_t distance) const {
        return static_cast<std::uint32_t>(distance) / GetParam().step;
    }
};

TEST_P(RestartBounds, CountAJumpForwardByThreeThousandAsLost) {
    const StreamCounts counts = countsAfterJump(3'000);
    EXPECT_EQ(counts.restarts, 0U);
    EXPECT_EQ(counts.lost, steps(3'000) - 1);
    EXPECT_EQ(counts.longestGapSamples, counts.lost);
    EXPECT_EQ(counts.samples, kBefore + 1 + kAfter + 1);
    // (last - first) / step + 1 = samples + incomplete + lost
    const std::uint32_t moved = (counts.lastSample - counts.firstSample) / GetParam().step;
    EXPECT_EQ(counts.samples + counts.incomplete + counts.lost, moved + 1);
}

TEST_P(RestartBounds, TakeAJumpForwardByMoreForARestartWithoutLoss) {
    const StreamCounts counts = countsAfterJump(beyond(3'000));
    EXPECT_EQ(counts.restarts, 1U);
    EXPECT_EQ(counts.lost, 0U);
    EXPECT_EQ(counts.longestGapSamples, 0U);
    EXPECT_EQ(counts.samples, kBefore + 1 + kAfter + 1);
    EXPECT_EQ(counts.firstSample, GetParam().counter - kBefore * GetParam().step);
}

TEST_P(RestartBounds, TakeAJumpBackByAHundredForRepetition) {
    const StreamCounts counts = countsAfterJump(-100);
    EXPECT_EQ(counts.restarts, 0U);
    EXPECT_EQ(counts.duplicates, steps(100) + 1);
    EXPECT_EQ(counts.lost + counts.reordered, 0U);
    EXPECT_EQ(counts.samples, kBefore + 1 + kAfter - steps(100));
}

TEST_P(RestartBounds, TakeAJumpBackByMoreForARestartThatRepeatsNothing) {
    const StreamCounts counts = countsAfterJump(-beyond(100));
    EXPECT_EQ(counts.restarts, 1U);
    EXPECT_EQ(counts.duplicates + counts.reordered + counts.lost, 0U);
    EXPECT_EQ(counts.samples, kBefore + 1 + kAfter + 1);
    EXPECT_EQ(counts.step, GetParam().step);
}

TEST_P(RestartBounds, TakeOneDatagramFromElsewhereForNoRestart) {
    const auto [name, counter, step] = GetParam();
    for (const std::int32_t distance : {beyond(3'000), -beyond(100), 1'000'000'000, -1'000'000'000}) {
        SCOPED_TRACE(distance);
        stream = StreamAccounting();
        sendSteady(counter - kBefore * step, counter, step);
        send(counter + static_cast<std::uint32_t>(distance));
        sendSteady(counter + step, counter + kAfter * step, step);
        EXPECT_EQ(stream.counts().restarts, 0U);
        EXPECT_EQ(stream.counts().lost, 0U);
        EXPECT_EQ(stream.counts().samples, kBefore + 1 + kAfter);
        EXPECT_EQ(stream.counts().lastSample, counter + kAfter * step);
    }
}

TEST_P(RestartBounds, SettleAtTheSameWhereTheRestartIsLookedAtEarlyOrLate) {
    const auto [name, counter, step] = GetParam();
    sendSteady(counter - kBefore * step, counter, step);
    const std::uint32_t next = counter + static_cast<std::uint32_t>(beyond(3'000));
    send(next);
    EXPECT_EQ(stream.counts().restarts, 0U) << "one datagram agrees with nothing";
    for (std::uint32_t i = 1; i <= kAfter; ++i) {
        send(next + i * step);
        ASSERT_EQ(stream.counts().restarts, 1U) << i;
        ASSERT_EQ(stream.counts().samples, kBefore + 1 + i + 1) << i;
        ASSERT_EQ(stream.counts().lastSample, next + i * step) << i;
    }
    EXPECT_FALSE(stream.isInDoubt());
}

INSTANTIATE_TEST_SUITE_P(Streams, RestartBounds,
                         testing::Values(Place{"InTheMiddle", 1'000'000, 1}, Place{"EverySecond", 50'000, 2},
                                         Place{"EveryFifth", 70'000, 5}, Place{"JustBehindTheWrap", 40, 1},
                                         Place{"JustBeforeTheWrap", 0xfffffff0U, 1},
                                         Place{"AtTheWrap", 0xffffffffU, 1},
                                         Place{"EveryFourthBeforeTheWrap", 0xffffff00U, 4},
                                         Place{"AtTheSignBit", 0x80000000U, 1}),
                         [](const auto& instance) { return instance.param.name; });

TEST_F(Accounting, CountsEachRestartOfARowOnce) {
    std::uint64_t sent = 0;
    for (std::uint32_t take = 0; take < 6; ++take) {
        sendSteady(100'000 * (take % 2) + 1, 100'000 * (take % 2) + 300);
        sent += 300;
        EXPECT_EQ(stream.counts().restarts, take);
        EXPECT_EQ(stream.counts().samples, sent);
    }
    EXPECT_EQ(stream.counts().lost + stream.counts().duplicates, 0U);
    EXPECT_EQ(stream.counts().firstSample, 1U);
}

TEST_F(Accounting, CountsTheLossOfEachSideOfARestart) {
    sendSteady(9'000, 9'100);
    sendSteady(9'104, 9'200); // three are lost
    sendSteady(1, 100);
    sendSteady(106, 300); // five are lost
    const StreamCounts counts = stream.counts();
    EXPECT_EQ(counts.restarts, 1U);
    EXPECT_EQ(counts.lost, 8U);
    EXPECT_EQ(counts.longestGapSamples, 5U);
    EXPECT_EQ(counts.samples, 201U - 3 + 300 - 5);
    const StreamCounts range = stream.countsBetween({}, at(1'000s));
    EXPECT_EQ(range.lost, 8U);
    EXPECT_EQ(range.restarts, 1U);
}

TEST_F(Accounting, GivesARestartToAnotherStepNoLossEither) {
    sendSteady(40'000, 41'000, 4);
    sendSteady(1, 400);
    EXPECT_EQ(stream.counts().restarts, 1U);
    EXPECT_EQ(stream.counts().lost, 0U);
    EXPECT_EQ(stream.counts().step, 1U);
}

TEST_F(Accounting, HoldsManyStraysApartFromTheStream) {
    // Corrupt counters from five places in turn: each agrees with nothing that came before it.
    sendSteady(1, 300);
    std::uint32_t sample = 300;
    std::uint32_t strays = 0;
    for (std::uint32_t i = 0; i < 100; ++i) {
        send(++sample);
        send(sample + 500'000'000 * (i % 5 + 1));
        ++strays;
    }
    sendSteady(sample + 1, sample + 200);
    const StreamCounts counts = stream.counts();
    EXPECT_EQ(counts.samples, sample + 200);
    EXPECT_EQ(counts.datagrams, sample + 200 + strays);
    EXPECT_EQ(counts.lost, 0U);
    EXPECT_EQ(counts.restarts, 0U);
    EXPECT_FALSE(stream.isInDoubt());
}

TEST_F(Accounting, GivesUpPlacesThatNothingFollows) {
    // More places than are compared with one another, then one that is confirmed.
    sendSteady(1, 300);
    for (std::uint32_t i = 1; i <= 12; ++i) {
        send(i * 300'000'000);
    }
    sendSteady(2'000'000'000, 2'000'000'200);
    EXPECT_EQ(stream.counts().restarts, 1U);
    EXPECT_EQ(stream.counts().samples, 300U + 201U);
    EXPECT_EQ(stream.counts().lost, 0U);
    EXPECT_EQ(stream.counts().lastSample, 2'000'000'200U);
}

TEST_F(Accounting, DecidesInBoundedMemoryWhereNothingEverAgrees) {
    sendSteady(1, 300);
    std::uint32_t random = 7;
    for (std::uint32_t i = 0; i < 1'000; ++i) {
        random = random * 1'664'525 + 1'013'904'223;
        send(random | 0x40000000U);
    }
    sendSteady(301, 500);
    const StreamCounts counts = stream.counts();
    EXPECT_EQ(counts.datagrams, 1'500U);
    EXPECT_GE(counts.samples, 500U);
    EXPECT_EQ(counts.lastSample, 500U);
    EXPECT_FALSE(stream.isInDoubt());
}

TEST_F(Accounting, TellsTheVerdictOnEveryDatagramOnceAndInOrder) {
    std::vector<std::uint64_t> decided;
    const auto note = [&](std::span<const Verdict> verdicts) {
        for (const Verdict& verdict : verdicts) {
            decided.push_back(verdict.packet);
        }
    };
    std::uint32_t random = 3;
    std::uint32_t sample = 1'000;
    for (std::uint32_t i = 0; i < 3'000; ++i) {
        random = random * 1'664'525 + 1'013'904'223;
        const std::uint32_t kind = random >> 24;
        sample += kind < 4 ? 5'000U : 1U;
        note(send(kind > 250 ? random : sample - (kind > 240 ? 3 : 0)));
    }
    for (std::uint32_t i = 0; i < 200; ++i) {
        note(send(++sample));
    }
    ASSERT_EQ(decided.size(), 3'200U);
    for (std::size_t i = 0; i < decided.size(); ++i) {
        ASSERT_EQ(decided[i], i);
    }
}

} // namespace
} // namespace posewire::model
