// SPDX-License-Identifier: MIT
#include "tests/core/model/accounting/accounting_fixture.h"

#include <algorithm>

/// Senders that do not fill in the counters of the header as they should.
namespace posewire::model {
namespace {

TEST_F(Accounting, TakesSamplesWithoutALastFlagForWholeIfNoSecondDatagramEverComes) {
    for (std::uint32_t sample = 1; sample <= 3; ++sample) {
        send(sample, 0);
    }
    EXPECT_EQ(stream.counts().incomplete, 3U) << "more of them may come";
    const auto verdicts = send(4, 0);
    EXPECT_EQ(std::ranges::count_if(verdicts, &Verdict::isCompleting), 4);
    EXPECT_TRUE(stream.framing().isUnmarked());
    for (std::uint32_t sample = 5; sample <= 100; ++sample) {
        send(sample, 0);
    }
    for (const StreamCounts& counts : {stream.counts(), stream.countsBetween(at(0s), at(1h))}) {
        EXPECT_EQ(counts.samples, 100U);
        EXPECT_EQ(counts.incomplete, 0U);
        EXPECT_EQ(counts.lost, 0U);
    }
}

TEST_F(Accounting, WaitsForTheRestOfSamplesThatHaveEverComeInParts) {
    send(1, 0);
    send(1, 0x81);
    for (std::uint32_t sample = 2; sample <= 40; ++sample) {
        send(sample, 0);
    }
    EXPECT_FALSE(stream.framing().isUnmarked());
    EXPECT_EQ(stream.counts().incomplete, 39U);
}

TEST_F(Accounting, TakesSamplesForWholeThatAreNotMarkedAnyMore) {
    sendSteady(1, 100);
    for (std::uint32_t sample = 101; sample <= 107; ++sample) {
        send(sample, 0);
    }
    EXPECT_FALSE(stream.framing().isUnmarked()) << "a few may be damaged";
    EXPECT_EQ(stream.counts().incomplete, 7U);
    for (std::uint32_t sample = 108; sample <= 200; ++sample) {
        send(sample, 0);
    }
    EXPECT_TRUE(stream.framing().isUnmarked());
    EXPECT_EQ(stream.counts().samples, 200U);
    EXPECT_EQ(stream.counts().incomplete, 0U);
    sendSteady(201, 210);
    EXPECT_FALSE(stream.framing().isUnmarked());
    EXPECT_EQ(stream.counts().samples, 210U);
}

TEST_F(Accounting, FindsThePartThatIsNeverSent) {
    for (std::uint32_t sample = 1; sample <= 90; ++sample) {
        send(sample, 0);
        send(sample, 1);
        if (sample <= 20 || sample > 60) {
            send(sample, 0x82);
        }
        EXPECT_EQ(stream.framing().isShort(), sample > 32 && sample <= 61) << sample;
    }
    for (std::uint32_t sample = 1; sample <= 90; ++sample) {
        EXPECT_EQ(stream.framing().isShort(sample), sample > 20 && sample <= 60) << sample;
    }
    EXPECT_EQ(stream.counts().incomplete, 40U);
    for (std::uint32_t sample = 91; sample <= 1000; ++sample) { // one of two is lost by chance
        send(sample, 0);
        send(sample, 1);
        if (sample % 8 != 0 && sample % 8 > 3) {
            send(sample, 0x82);
        }
        EXPECT_FALSE(stream.framing().isShort());
    }
}

TEST_F(Accounting, CountsDatagramsWhereTheCounterStands) {
    for (std::uint32_t content = 1; content <= 50; ++content) {
        sendWith(content, 7);
        EXPECT_EQ(stream.isUncounted(), content >= 3) << "a second one may be a damaged copy";
    }
    EXPECT_EQ(sendWith(50, 7).back().isDuplicate, true) << "the same once more";
    EXPECT_EQ(stream.counts().samples, 50U);
    EXPECT_EQ(stream.counts().duplicates, 1U);
    sendAll({8, 9, 10}); // it counts again
    EXPECT_FALSE(stream.isUncounted());
    for (std::uint32_t content = 100; content < 120; ++content) {
        sendWith(content, 11);
    }
    EXPECT_TRUE(stream.isUncounted());
    for (const StreamCounts& counts : {stream.counts(), stream.countsBetween(at(0s), at(1h))}) {
        EXPECT_EQ(counts.samples, 73U);
        EXPECT_EQ(counts.duplicates, 1U);
        EXPECT_EQ(counts.lost + counts.incomplete + counts.restarts, 0U);
    }
}

TEST_F(Accounting, CountsWhatNeitherCountsNorMarksTheLast) {
    for (std::uint32_t content = 1; content <= 50; ++content) {
        sendWith(content, 0, 0);
    }
    EXPECT_TRUE(stream.isUncounted() && stream.framing().isUnmarked());
    EXPECT_EQ(stream.counts().samples, 50U);
    EXPECT_EQ(stream.counts().incomplete + stream.counts().duplicates, 0U);
}

TEST_F(Accounting, TakesADamagedCopyForADuplicateOnceTheNextHasCome) {
    sendSteady(1, 10);
    EXPECT_TRUE(sendWith(99, 10).empty());
    EXPECT_TRUE(stream.isInDoubt());
    EXPECT_EQ(stream.counts().duplicates, 1U) << "as it would be if nothing followed";
    const auto verdicts = send(11);
    ASSERT_EQ(verdicts.size(), 2U);
    EXPECT_TRUE(verdicts[0].isDuplicate);
    sendWith(99, 11);
    EXPECT_EQ(stream.conclude().size(), 1U);
    EXPECT_EQ(stream.counts().duplicates, 2U);
    EXPECT_EQ(stream.counts().samples, 11U);
}

} // namespace
} // namespace posewire::model
