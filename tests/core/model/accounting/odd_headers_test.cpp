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
    EXPECT_TRUE(stream.isUnframed());
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
    EXPECT_FALSE(stream.isUnframed());
    EXPECT_EQ(stream.counts().incomplete, 39U);
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
    EXPECT_TRUE(stream.isUncounted() && stream.isUnframed());
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
