// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/loop_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace posewire::net {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// What a relay with some targets asks, 240 datagrams a second; what comes back is for the tests to say.
class LoopWatchTest : public ::testing::Test {
protected:
    static constexpr log::SenderId kPerformer{1};
    static constexpr log::SenderId kOther{2};

    /// Contents differ in all bits, as hashes do.
    static std::uint64_t contentOf(std::uint64_t number) { return (number + 1) * 0x9e3779b97f4a7c15U; }

    LoopWatch::Route come(std::uint64_t number, log::SenderId from) {
        return watch.route(contentOf(number), from, now, targets);
    }
    void wait(log::Duration by) {
        now += by;
        const auto found = watch.takeLoops(now);
        loops.insert(loops.end(), found.begin(), found.end());
        if (!found.empty()) {
            targets -= found.size();
        }
    }
    /// Every datagram of a second that `back` says of comes back, once, from elsewhere.
    template <class Back>
    void pass(int seconds, const Back& back) {
        for (int i = 0; i < seconds * 240 && loops.empty(); ++i) {
            const LoopWatch::Route route = come(next, kPerformer);
            wait(milliseconds(2));
            if (back(route)) {
                returned += 1;
                relayedReturns += come(next, kOther).isWithheld ? 0 : 1;
            }
            wait(milliseconds(2));
            ++next;
        }
    }

    LoopWatch watch;
    log::Moment now{std::chrono::hours(1)};
    std::size_t targets = 1;
    std::uint64_t next = 0;
    std::uint64_t returned = 0;
    std::uint64_t relayedReturns = 0;
    std::vector<std::size_t> loops;
};

TEST_F(LoopWatchTest, ATargetThatSendsBackIsFoundWithinSeconds) {
    pass(5, [](const LoopWatch::Route& route) { return route.leadsTo(0); });
    EXPECT_THAT(loops, ElementsAre(0));
    EXPECT_LT(next, 480U);
    EXPECT_EQ(watch.lastReturner(), kOther);
    EXPECT_LE(relayedReturns, LoopWatch::kSuspicious) << "then no return is relayed any more";
}

TEST_F(LoopWatchTest, OfSeveralTargetsThoseThatSendBackAreFound) {
    targets = 4;
    pass(5, [](const LoopWatch::Route& route) { return route.leadsTo(1) || route.leadsTo(3); });
    EXPECT_THAT(loops, ElementsAre(1, 3));
}

TEST_F(LoopWatchTest, AStreamThatArrivesTwiceIsNoLoop) {
    pass(20, [](const LoopWatch::Route&) { return true; });
    EXPECT_THAT(loops, IsEmpty());
    EXPECT_GT(relayedReturns * 10, returned * 9) << "but for the time of one trial both are relayed";
}

TEST_F(LoopWatchTest, WhereStreamsArriveTwiceALoopIsFoundAllTheSame) {
    pass(5, [](const LoopWatch::Route&) { return true; });
    ASSERT_THAT(loops, IsEmpty());
    for (int i = 0; i < 2400 && loops.empty(); ++i) {
        const LoopWatch::Route route = come(next, kPerformer);
        bool isUnderWay = route.leadsTo(0);
        for (int round = 0; round < 10; ++round) {
            wait(milliseconds(1));
            if (isUnderWay) {
                isUnderWay = !come(next, kOther).isWithheld;
            }
        }
        ++next;
    }
    EXPECT_THAT(loops, ElementsAre(0));
}

TEST_F(LoopWatchTest, WhatASenderRepeatsItselfIsNoReturn) {
    for (int i = 0; i < 10'000; ++i) {
        const LoopWatch::Route route = come(static_cast<std::uint64_t>(i % 3), kPerformer);
        EXPECT_FALSE(route.isReturn || route.isWithheld);
        wait(milliseconds(4));
    }
    EXPECT_THAT(loops, IsEmpty());
}

TEST_F(LoopWatchTest, MetadataOfASenderThatChangesPortsIsRelayed) {
    for (std::uint32_t port = 0; port < 1000; ++port) { // once a second, and a pose stream beside it
        EXPECT_FALSE(come(0, log::SenderId{100 + port}).isWithheld);
        for (int i = 0; i < 50; ++i) {
            EXPECT_FALSE(come(++next, kPerformer).isWithheld);
            wait(milliseconds(20));
        }
    }
    EXPECT_THAT(loops, IsEmpty());
}

TEST_F(LoopWatchTest, ATrialEndsWithoutResultWhereNothingNewComes) {
    for (int i = 0; i < 100; ++i) {
        come(0, i % 2 == 0 ? kPerformer : kOther);
        wait(milliseconds(4));
    }
    EXPECT_TRUE(come(0, kOther).isWithheld);
    wait(std::chrono::seconds(11));
    wait(std::chrono::seconds(11));
    EXPECT_FALSE(come(1, kPerformer).isWithheld);
    EXPECT_THAT(loops, IsEmpty());
}

} // namespace
} // namespace posewire::net
