// SPDX-License-Identifier: MIT
#include "core/log/reassembly.h"

#include "tests/core/log/capture_fixture.h"
#include "tests/core/log/recording_fixture.h"

#include <gmock/gmock.h>

namespace posewire::log {
namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kWithoutLink = 101;

ByteVector pose(std::uint32_t sample) {
    return poseDatagram(sample, 2);
}

class ConnectionsTest : public testing::Test {
protected:
    void add(const ByteVector& packet) {
        m_reassembly.add({kWithoutLink, packet, 0, m_stamp});
        m_stamp += 1ms;
    }
    /// What came out since the last call: datagrams, and how much was skipped.
    std::vector<ByteVector> taken() { return std::exchange(m_seen, {}); }
    void finish() { m_reassembly.finish(); }

    std::size_t m_skipped = 0;

private:
    std::vector<ByteVector> m_seen;
    FileVisitor m_visit = [this](const FileRecord& record) {
        if (record.flags.skipped) {
            m_skipped += record.bytes.size();
        } else {
            m_seen.emplace_back(record.bytes.begin(), record.bytes.end());
        }
    };
    Reassembly m_reassembly{m_visit};
    WallTime m_stamp{};
};

using Datagrams = std::vector<ByteVector>;

TEST_F(ConnectionsTest, EndWithAFinOrAReset) {
    for (const unsigned end : {kFin, kReset, kFin | kReset}) {
        add(tcp(100, {}, kSyn));
        add(tcp(101, slice(pose(1), 0, 50)));
        EXPECT_TRUE(taken().empty());
        add(tcp(151, {}, end));
        EXPECT_EQ(taken(), Datagrams{slice(pose(1), 0, 50)}) << "cut off by the end";
    }
}

TEST_F(ConnectionsTest, GiveTheBytesThatComeWithTheirEnd) {
    add(tcp(100, {}, kSyn));
    add(tcp(101, slice(pose(1), 0, 50)));
    add(tcp(151, slice(pose(1), 50, 100), kFin));
    EXPECT_EQ(taken(), Datagrams{pose(1)});
}

/// TCP fast open (RFC 7413): the first bytes come with the SYN, which counts for one.
TEST_F(ConnectionsTest, GiveTheBytesThatComeWithTheirBeginning) {
    add(tcp(0xffffffff, pose(1), kSyn));
    add(tcp(88, pose(2)));
    EXPECT_EQ(taken(), (Datagrams{pose(1), pose(2)}));
}

TEST_F(ConnectionsTest, WaitForWhatIsMissingBeforeTheirEnd) {
    add(tcp(100, {}, kSyn));
    add(tcp(101 + 88, {}, kFin));
    add(tcp(101, pose(1)));
    EXPECT_EQ(taken(), Datagrams{pose(1)});
    finish();
    EXPECT_TRUE(taken().empty());
}

TEST_F(ConnectionsTest, AreNotEndedByAResetFarAhead) {
    add(tcp(101, slice(pose(1), 0, 50)));
    add(tcp(5000, {}, kReset));
    add(tcp(151, slice(pose(1), 50, 100)));
    EXPECT_EQ(taken(), Datagrams{pose(1)});
}

/// The answers of the receiver go the other way: a connection has two directions with numbers of their own.
TEST_F(ConnectionsTest, HaveTwoDirections) {
    add(tcp(100, {}, kSyn));
    add(tcp(5000, {}, kSyn, 9763, 40001));
    add(tcp(101, slice(pose(1), 0, 40)));
    add(tcp(5001, textBytes("an answer"), 0, 9763, 40001));
    add(tcp(141, slice(pose(1), 40, 100)));
    add(tcp(5010, pose(9), 0, 9763, 40001));
    EXPECT_EQ(taken(), (Datagrams{pose(1), pose(9)}));
    EXPECT_EQ(m_skipped, 0U);
}

TEST_F(ConnectionsTest, AreToldApartByEachAddressAndPort) {
    const auto from = [](unsigned address, std::uint32_t sequence, const ByteVector& content) {
        ByteVector packet = tcp(sequence, content);
        packet[15] = static_cast<std::byte>(address);
        return packet;
    };
    add(from(10, 1, slice(pose(1), 0, 40)));
    add(from(11, 1, slice(pose(2), 0, 50)));
    add(tcp(1, slice(pose(3), 0, 60), 0, 40002));
    add(from(11, 51, slice(pose(2), 50, 100)));
    add(from(10, 41, slice(pose(1), 40, 100)));
    add(tcp(61, slice(pose(3), 60, 100), 0, 40002));
    EXPECT_EQ(taken(), (Datagrams{pose(2), pose(1), pose(3)}));
}

TEST_F(ConnectionsTest, PassOverHeadersThatAreNone) {
    for (const unsigned words : {0U, 1U, 4U, 15U}) {
        ByteVector packet = tcp(1, {});
        packet[20 + 12] = static_cast<std::byte>(words << 4);
        add(packet);
    }
    const ByteVector packet = tcp(1, {});
    for (std::size_t size = 20; size < 40; ++size) {
        add(slice(packet, 0, size));
    }
    finish();
    EXPECT_TRUE(taken().empty());
}

/// The options of the header (time stamps, RFC 7323) are no data.
TEST_F(ConnectionsTest, PassOverTheOptionsOfTheHeader) {
    for (const std::size_t words : {1U, 3U, 10U}) {
        ByteVector content = joined({ByteVector(4 * words, std::byte{1}), pose(1)});
        ByteVector packet = tcp(1, content);
        packet[20 + 12] = static_cast<std::byte>((5 + words) << 4);
        add(packet);
        EXPECT_EQ(taken(), Datagrams{pose(1)}) << words;
        add(tcp(89, {}, kReset));
    }
}

TEST_F(ConnectionsTest, ArePutTogetherFromIpFragmentsToo) {
    const ByteVector packet = tcp(1, joined({pose(1), pose(2)}));
    const ByteVector segment(packet.begin() + 20, packet.end());
    add(ipv4(slice(segment, 96, 200), 96 / 8, 6));
    add(ipv4(slice(segment, 0, 96), 0x2000, 6));
    EXPECT_EQ(taken(), (Datagrams{pose(1), pose(2)}));
}

/// An upload to another service is followed only from a segment that begins a datagram.
TEST_F(ConnectionsTest, AreIgnoredWhereNothingPointsToMxtp) {
    add(tcp(1, {}, kSyn, 50'000, 443));
    add(tcp(2, textBytes("hello MXTP02"), 0, 50'000, 443));
    add(tcp(2, {}, 0, 50'000, 9763)); // no more than an acknowledgement
    finish();
    EXPECT_TRUE(taken().empty());
    EXPECT_EQ(m_skipped, 0U);
}

} // namespace
} // namespace posewire::log
