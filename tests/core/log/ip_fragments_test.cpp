// SPDX-License-Identifier: MIT
#include "core/log/reassembly.h"

#include "tests/core/log/datagram_fixture.h"
#include "tests/core/log/log_fixture.h"

#include <gmock/gmock.h>

#include <random>

namespace posewire::log {
namespace {

using namespace std::chrono_literals;

struct Whole {
    ByteVector bytes;
    std::uint32_t identity;
    std::uint64_t fileOffset;
    std::optional<WallTime> stamp;
};

class IpFragmentsTest : public testing::Test {
protected:
    /// Bytes `from` to before `to` of the packet `content`, one a millisecond.
    void add(const ByteVector& content, std::size_t from, std::size_t to, std::uint32_t identity = 1) {
        IpPacket packet = headersOf(identity);
        packet.fragmentOffset = static_cast<std::uint32_t>(from);
        packet.hasMoreFragments = to < content.size();
        packet.bytes = std::span(content).subspan(from, to - from);
        add(packet);
    }
    void add(IpPacket packet) {
        packet.offset = m_fileOffset;
        packet.time = m_stamp;
        m_fragments.add(packet);
        m_fileOffset += 10'000;
        m_stamp += 1ms;
    }
    void finish() { m_fragments.finish(); }
    void pass(Duration time) { m_stamp += time; }
    static IpPacket headersOf(std::uint32_t identity) {
        IpPacket packet;
        packet.protocol = kUdp;
        packet.identity = identity;
        return packet;
    }
    std::vector<Whole> m_seen;

private:
    IpFragments m_fragments{[this](const IpPacket& whole) {
        m_seen.push_back(
            {{whole.bytes.begin(), whole.bytes.end()}, whole.identity, whole.offset, whole.time});
    }};
    std::uint64_t m_fileOffset = 0;
    WallTime m_stamp{};
};

ByteVector beginningOf(const ByteVector& content, std::size_t size) {
    return {content.begin(), content.begin() + static_cast<std::ptrdiff_t>(size)};
}

/// RFC 791 section 3.2: a packet is whole when every byte up to the end of the last fragment is there.
TEST_F(IpFragmentsTest, AreWholeExactlyWhenEveryByteIsThere) {
    std::mt19937 random(6);
    for (int round = 0; round < 300; ++round) {
        m_seen.clear();
        const auto identity = static_cast<std::uint32_t>(round);
        const ByteVector content = pattern(8 * (1 + random() % 40) + random() % 8, random());
        std::vector<bool> isThere(content.size(), false);
        bool hasLast = false;
        for (int i = 0; i < 400 && m_seen.empty(); ++i) {
            const std::size_t from = random() % (content.size() / 8 + 1) * 8;
            const std::size_t to = std::min(content.size(), from + 8 * (1 + random() % 12));
            if (from == to) {
                continue;
            }
            std::fill(isThere.begin() + static_cast<std::ptrdiff_t>(from),
                      isThere.begin() + static_cast<std::ptrdiff_t>(to), true);
            hasLast = hasLast || to == content.size();
            add(content, from, to, identity);
            const bool isWhole = hasLast && std::ranges::find(isThere, false) == isThere.end();
            ASSERT_EQ(m_seen.size(), isWhole ? 1U : 0U) << "round " << round << " after " << i;
        }
        ASSERT_EQ(m_seen.size(), 1U);
        EXPECT_EQ(m_seen[0].bytes, content);
        EXPECT_EQ(m_seen[0].identity, identity);
    }
}

/// RFC 4963: identifications come round while a packet of which a fragment was lost still waits for it.
TEST_F(IpFragmentsTest, OfPacketsOfOneIdentificationAreNotMixedAfterAWhile) {
    const ByteVector lost = pattern(64, 1);
    const ByteVector later = pattern(64, 2);
    add(lost, 0, 32);
    pass(900ms);
    add(lost, 32, 48); // goes on
    pass(1'100ms);
    add(later, 0, 32);
    add(later, 32, 64);
    ASSERT_EQ(m_seen.size(), 2U);
    EXPECT_EQ(m_seen[0].bytes, beginningOf(lost, 48));
    EXPECT_EQ(m_seen[1].bytes, later);
}

/// A router on another path may cut the same packet into larger pieces.
TEST_F(IpFragmentsTest, TakeTheLongerOfTwoThatBeginAtTheSamePlace) {
    const ByteVector content = pattern(3000, 1);
    add(content, 0, 600);
    add(content, 0, 1480);
    add(content, 1480, 3000);
    ASSERT_EQ(m_seen.size(), 1U);
    EXPECT_EQ(m_seen[0].bytes, content);
    add(content, 1480, 3000, 2);
    add(content, 0, 1480, 2);
    ASSERT_EQ(m_seen.size(), 2U);
    EXPECT_EQ(m_seen[1].bytes, content);
}

TEST_F(IpFragmentsTest, KeepTheBytesThatCameFirstWhereTwoDiffer) {
    const ByteVector first = pattern(1600, 1);
    const ByteVector other = pattern(1600, 2);
    add(first, 0, 800);
    add(other, 0, 800);
    add(first, 800, 1600);
    ASSERT_EQ(m_seen.size(), 1U);
    EXPECT_EQ(m_seen[0].bytes, first);
}

TEST_F(IpFragmentsTest, ReportWhereTheBeginningIsAndWhenTheLastCame) {
    const ByteVector content = pattern(2400, 1);
    add(content, 1600, 2400);
    add(content, 0, 800);
    add(content, 800, 1600);
    ASSERT_EQ(m_seen.size(), 1U);
    EXPECT_EQ(m_seen[0].fileOffset, 10'000U);
    EXPECT_EQ(m_seen[0].stamp, WallTime(2ms));
}

/// RFC 791: packets are told apart by identification, protocol, source and destination.
TEST_F(IpFragmentsTest, BelongTogetherByIdentityProtocolAndAddresses) {
    const ByteVector content = pattern(1600, 1);
    std::vector<IpPacket> kinds(5, headersOf(7));
    kinds[1].identity = 8;
    kinds[2].protocol = kTcp;
    kinds[3].sender.bytes[3] = std::byte{9};
    kinds[4].target.bytes[3] = std::byte{9};
    for (const bool isLast : {false, true}) {
        for (IpPacket packet : kinds) {
            EXPECT_TRUE(m_seen.empty() || isLast);
            packet.fragmentOffset = isLast ? 800 : 0;
            packet.hasMoreFragments = !isLast;
            packet.bytes = std::span(content).subspan(isLast ? 800 : 0, 800);
            add(packet);
        }
    }
    EXPECT_EQ(m_seen.size(), kinds.size());
}

TEST_F(IpFragmentsTest, MayUseTheIdentityAgainOncePacketsAreWhole) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        const ByteVector content = pattern(1600, seed);
        add(content, 0, 800);
        add(content, 800, 1600);
        ASSERT_EQ(m_seen.size(), seed + 1);
        EXPECT_EQ(m_seen[seed].bytes, content);
    }
}

/// 65,535 bytes are the most that the length of an IP packet can say.
TEST_F(IpFragmentsTest, ReachTheEndOfThePacketAndNoFurther) {
    const ByteVector content = pattern(65'600, 1);
    IpPacket last = headersOf(1);
    last.fragmentOffset = 65'528;
    last.bytes = std::span(content).subspan(65'528, 8);
    add(last);
    finish();
    EXPECT_TRUE(m_seen.empty());
    add(content, 0, 65'528, 2);
    last.identity = 2;
    last.bytes = last.bytes.first(7);
    add(last);
    ASSERT_EQ(m_seen.size(), 1U);
    EXPECT_EQ(m_seen[0].bytes, beginningOf(content, 65'535));
}

TEST_F(IpFragmentsTest, AreNothingWithoutBytes) {
    const ByteVector content = pattern(800, 1);
    IpPacket empty = headersOf(1);
    empty.hasMoreFragments = true;
    add(empty);
    empty.hasMoreFragments = false;
    empty.fragmentOffset = 800;
    add(empty);
    add(content, 0, 400);
    finish();
    ASSERT_EQ(m_seen.size(), 1U);
    EXPECT_EQ(m_seen[0].bytes, beginningOf(content, 400));
}

TEST_F(IpFragmentsTest, GiveTheBeginningUpToTheFirstHole) {
    const ByteVector content = pattern(4000, 1);
    add(content, 3200, 4000);
    add(content, 800, 1600);
    add(content, 0, 1200);
    add(content, 2400, 3200);
    finish();
    ASSERT_EQ(m_seen.size(), 1U);
    EXPECT_EQ(m_seen[0].bytes, beginningOf(content, 1600));
    finish();
    EXPECT_EQ(m_seen.size(), 1U) << "given once";
}

TEST_F(IpFragmentsTest, GiveNothingOfAPacketWithoutItsBeginning) {
    const ByteVector content = pattern(2400, 1);
    add(content, 800, 1600);
    add(content, 1600, 2400);
    finish();
    EXPECT_TRUE(m_seen.empty());
}

TEST_F(IpFragmentsTest, ComeOutInTheOrderInWhichTheyBegan) {
    const ByteVector content = pattern(2400, 1);
    for (const std::uint32_t identity : {5U, 3U, 9U}) {
        add(content, 0, 800, identity);
    }
    add(content, 800, 1600, 9);
    add(content, 800, 1600, 5);
    finish();
    ASSERT_EQ(m_seen.size(), 3U);
    EXPECT_EQ(m_seen[0].identity, 5U);
    EXPECT_EQ(m_seen[1].identity, 3U);
    EXPECT_EQ(m_seen[2].identity, 9U);
}

TEST_F(IpFragmentsTest, GiveUpTheOldestOfTooManyPackets) {
    const ByteVector content = pattern(1600, 1);
    constexpr auto most = static_cast<std::uint32_t>(IpFragments::kMostPending);
    for (std::uint32_t identity = 0; identity < most; ++identity) {
        add(content, identity == 1 ? 800 : 0, identity == 1 ? 1600 : 800, identity);
    }
    EXPECT_TRUE(m_seen.empty());
    add(content, 0, 800, most);
    ASSERT_EQ(m_seen.size(), 1U);
    EXPECT_EQ(m_seen[0].identity, 0U);
    EXPECT_EQ(m_seen[0].bytes, beginningOf(content, 800));
    add(content, 0, 800, most + 1);
    EXPECT_EQ(m_seen.size(), 1U) << "the second has no beginning to be given";
    add(content, 800, 1600, 2);
    ASSERT_EQ(m_seen.size(), 2U);
    EXPECT_EQ(m_seen[1].bytes, content);
}

/// An attacker's pieces, each a little further, stay within twice the largest packet.
TEST_F(IpFragmentsTest, KeepBoundedMemoryOfPiecesThatOverlapWithoutEnd) {
    const ByteVector content = pattern(40'000, 1);
    for (std::size_t from = 8; from <= 16'000; from += 8) {
        add(content, from, from + 20'000);
    }
    add(content, 0, 12'000);
    finish();
    EXPECT_TRUE(m_seen.empty()) << "no room was left for the beginning";
}

} // namespace
} // namespace posewire::log
