// SPDX-License-Identifier: MIT
#include "core/log/log_reader.h"
#include "core/log/packet_log.h"

#include <gtest/gtest.h>

#include <vector>

namespace posewire::log {
namespace {

/// A log of two small chunks, each with room for a few hundred packets.
class LogFollowerTest : public testing::Test {
protected:
    void append(std::size_t count, std::uint32_t drops = 0) {
        const std::vector<std::byte> bytes(1'000);
        const SenderId sender = m_log.senders().intern({"10.0.0.2:40001", Transport::Udp, 9763});
        for (std::size_t i = 0; i < count; ++i) {
            m_log.writer().append(bytes, {.sender = sender, .kernelDropsBefore = drops});
        }
        m_log.writer().publish();
        m_appended += count;
    }
    /// Takes up to `most` packets; their numbers and gaps must fit together.
    std::uint64_t take(LogFollower& follower, std::uint64_t most = UINT64_MAX) {
        std::uint64_t count = 0;
        for (; count < most; ++count) {
            const auto packet = follower.next();
            if (!packet) {
                break;
            }
            EXPECT_EQ(packet->number, m_next + follower.takeOvertaken());
            m_next = packet->number + 1;
        }
        return count;
    }

    PacketLog m_log{{.memoryCap = 1, .chunkSize = std::size_t{256} << 10}};
    std::uint64_t m_appended = 0;
    std::uint64_t m_next = 0; ///< to be taken, if nothing is passed over
};

TEST_F(LogFollowerTest, TakesEveryPacketOnce) {
    LogFollower follower(m_log);
    append(100);
    follower.refresh();
    EXPECT_EQ(follower.lag(), 100U);
    EXPECT_EQ(take(follower, 40), 40U);
    EXPECT_EQ(follower.lag(), 60U);
    follower.refresh();
    EXPECT_EQ(take(follower), 60U);
    EXPECT_EQ(follower.overtaken(), 0U);
    EXPECT_EQ(follower.position(), 100U);
}

TEST_F(LogFollowerTest, CountsWhatTheLogDroppedBeforeItCame) {
    LogFollower follower(m_log);
    append(10'000);
    follower.refresh();
    const std::uint64_t taken = take(follower);
    EXPECT_GT(follower.overtaken(), 9'000U);
    EXPECT_EQ(taken + follower.overtaken(), m_appended);
}

TEST_F(LogFollowerTest, CountsWhatIsDroppedWhileItLooks) {
    LogFollower follower(m_log);
    append(400);
    follower.refresh();
    std::uint64_t taken = take(follower, 10);
    append(10'000); // its chunk is held; the rest of what it saw is gone
    taken += take(follower);
    follower.refresh();
    taken += take(follower);
    EXPECT_GT(follower.overtaken(), 0U);
    EXPECT_EQ(taken + follower.overtaken(), m_appended);
}

TEST_F(LogFollowerTest, KnowsWhatTheKernelDroppedAmongThePacketsThatAreGone) {
    LogFollower follower(m_log);
    append(10, 1);
    follower.refresh();
    take(follower, 4);
    EXPECT_EQ(follower.takeUnseen().datagrams, 0U);
    append(10'000, 3);
    follower.refresh();
    follower.next();
    const std::uint64_t unseen = 6 * 1 + (follower.overtaken() - 6) * 3;
    EXPECT_EQ(follower.takeUnseen().datagrams, unseen);
    EXPECT_EQ(follower.takeUnseen().datagrams, 0U);
    while (follower.next()) {
    }
    EXPECT_EQ(follower.takeUnseen().datagrams, 0U) << "each packet tells its own";
    append(10'000, 5);
    const std::uint64_t before = follower.overtaken();
    follower.refresh();
    follower.next();
    EXPECT_EQ(follower.takeUnseen().datagrams, (follower.overtaken() - before) * 5);
}

TEST_F(LogFollowerTest, ForgetsWhatWasDroppedBeforeItBegan) {
    append(10'000, 3);
    LogFollower oldest(m_log);
    LogFollower newest = LogFollower::fromNow(m_log);
    append(1, 2);
    for (LogFollower* follower : {&oldest, &newest}) {
        follower->refresh();
        while (follower->next()) {
        }
        EXPECT_EQ(follower->takeUnseen().datagrams, 0U);
    }
    append(10'000, 1);
    newest.refresh();
    newest.next();
    EXPECT_EQ(newest.takeUnseen().datagrams, newest.overtaken());
}

TEST_F(LogFollowerTest, CountsWhatItIsToldToPassOver) {
    LogFollower follower(m_log);
    append(100);
    follower.refresh();
    follower.skipTo(70);
    follower.skipTo(50); // it never goes back
    EXPECT_EQ(take(follower), 30U);
    EXPECT_EQ(follower.overtaken(), 70U);
}

TEST_F(LogFollowerTest, BeginsWhereItIsToldToWithoutCountingWhatWasBefore) {
    append(100);
    LogFollower follower(m_log, 60);
    m_next = 60;
    follower.refresh();
    EXPECT_EQ(take(follower), 40U);
    EXPECT_EQ(follower.overtaken(), 0U);
}

TEST_F(LogFollowerTest, FromAPacketOnItCountsWhatIsGoneOfThat) {
    append(10'000);
    const LogReader reader(m_log);
    LogFollower follower(m_log, 10);
    EXPECT_EQ(follower.position(), reader.begin());
    EXPECT_EQ(follower.overtaken(), reader.begin() - 10);
}

TEST_F(LogFollowerTest, FromNowOnItTakesNothingThatWasThere) {
    append(100);
    LogFollower follower = LogFollower::fromNow(m_log);
    append(5);
    follower.refresh();
    EXPECT_EQ(follower.next()->number, 100U);
    EXPECT_EQ(follower.lag(), 4U);
    EXPECT_EQ(follower.overtaken(), 0U);
}

TEST_F(LogFollowerTest, TakesNoneBeyondTheEndThatIsAskedFor) {
    LogFollower follower(m_log);
    append(10);
    follower.refresh();
    while (follower.next(3)) {
    }
    EXPECT_EQ(follower.position(), 3U);
}

} // namespace
} // namespace posewire::log
