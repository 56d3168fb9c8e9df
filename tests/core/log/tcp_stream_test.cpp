// SPDX-License-Identifier: MIT
#include "core/log/reassembly.h"

#include "tests/core/log/datagram_fixture.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

namespace posewire::log {
namespace {

using namespace std::chrono_literals;

struct SeenSegment {
    std::uint64_t offset;
    ByteVector bytes;
    bool isSkipped;
    std::optional<WallTime> stamp;
};

/// Poses with the samples 1 … count, 88 bytes each.
ByteVector poseStream(std::uint32_t count) {
    std::vector<ByteVector> all;
    for (std::uint32_t sample = 1; sample <= count; ++sample) {
        all.push_back(poseDatagram(sample, 2));
    }
    return joined(all);
}
constexpr std::uint32_t kPose = 88;

class TcpStreamTest : public testing::TestWithParam<std::uint32_t> {
protected:
    /// Bytes of `m_sent` in a frame of their own, whose place in the file is 1,000,000 + their own.
    void add(std::size_t from, std::size_t size) {
        size = std::min(size, m_sent.size() - from);
        addBytes(m_first + static_cast<std::uint32_t>(from), std::span(m_sent).subspan(from, size),
                 1'000'000 + from);
    }
    void addBytes(std::uint32_t sequence, std::span<const std::byte> bytes, std::uint64_t offset = 0) {
        m_stream.add({.sequence = sequence, .bytes = bytes, .offset = offset, .time = m_time});
        if (m_time) {
            *m_time += 1ms;
        }
    }
    void finish() { m_stream.finish(); }
    [[nodiscard]] std::vector<ByteVector> datagrams() const {
        std::vector<ByteVector> all;
        for (const SeenSegment& one : m_seen) {
            if (!one.isSkipped) {
                all.push_back(one.bytes);
            }
        }
        return all;
    }
    void expectPoses(std::uint32_t count) const {
        ASSERT_EQ(datagrams().size(), count);
        for (std::uint32_t i = 0; i < count; ++i) {
            EXPECT_EQ(datagrams()[i], poseDatagram(i + 1, 2)) << i;
        }
        EXPECT_EQ(m_seen.size(), count) << "nothing was skipped";
    }

    ByteVector m_sent = poseStream(20);
    std::uint32_t m_first = GetParam();
    std::optional<WallTime> m_time{WallTime()};
    std::vector<SeenSegment> m_seen;
    FileVisitor m_visit = [this](const FileRecord& record) {
        EXPECT_EQ(record.sender, (SenderInfo{"10.0.0.2:40001", Transport::Tcp, 9763}));
        m_seen.push_back(
            {record.offset, {record.bytes.begin(), record.bytes.end()}, record.flags.skipped, record.time});
    };
    TcpStream m_stream{{"10.0.0.2:40001", Transport::Tcp, 9763}, m_first, m_visit};
};
/// Sequence numbers wrap around within the stream, at its start, at its end, or turn negative as int32.
INSTANTIATE_TEST_SUITE_P(FirstSequence, TcpStreamTest,
                         testing::Values(0U, 1U, 0xffffffffU, 0U - 20 * kPose, 0U - 500, 0x80000000U - 700,
                                         0x7fffffffU));

TEST_P(TcpStreamTest, GivesEachDatagramWithItsLastByte) {
    for (std::size_t at = 0; at < m_sent.size(); at += 10) {
        add(at, 10);
        EXPECT_EQ(m_seen.size(), std::min(at + 10, m_sent.size()) / kPose);
        EXPECT_EQ(m_stream.expected(),
                  m_first + static_cast<std::uint32_t>(std::min(at + 10, m_sent.size())));
    }
    expectPoses(20);
}

TEST_P(TcpStreamTest, TakesEveryRetransmissionOnce) {
    for (std::size_t at = 0; at < m_sent.size(); at += 100) {
        add(at, 100);
        add(at, 100);
        add(at / 2, 100);
        add(0, at + 50);
    }
    finish();
    expectPoses(20);
}

TEST_P(TcpStreamTest, PutsAnyOrderWithinTheWindowRight) {
    std::mt19937 random(GetParam());
    for (int round = 0; round < 20; ++round) {
        TcpStream stream({"10.0.0.2:40001", Transport::Tcp, 9763}, m_first, m_visit);
        m_seen.clear();
        std::vector<std::pair<std::size_t, std::size_t>> segments;
        for (std::size_t at = 0; at < m_sent.size(); at += 70) {
            segments.emplace_back(at, std::min<std::size_t>(70 + random() % 200, m_sent.size() - at));
        }
        std::shuffle(segments.begin(), segments.end(), random);
        for (const auto& [at, size] : segments) {
            stream.add({.sequence = m_first + static_cast<std::uint32_t>(at),
                        .bytes = std::span(m_sent).subspan(at, size),
                        .offset = 1'000'000 + at});
        }
        stream.finish();
        expectPoses(20);
    }
}

/// A retransmission may hold more than was sent at first (RFC 9293 section 3.8.6): its end counts too.
TEST_P(TcpStreamTest, TakesTheLongerOfTwoSegmentsThatWait) {
    add(0, 50);
    add(100, 50);
    add(100, 300); // again, with what comes after it
    EXPECT_TRUE(m_seen.empty());
    add(50, 50);
    EXPECT_EQ(m_stream.expected(), m_first + 400);
    add(400, 5000);
    finish();
    expectPoses(20);
}

/// RFC 9293 section 3.8.4: a keep-alive repeats the byte before the next one, or has none.
TEST_P(TcpStreamTest, IgnoresKeepAlives) {
    const std::array<std::byte, 1> garbage{std::byte{0xff}};
    add(0, 100);
    addBytes(m_stream.expected() - 1, garbage);
    addBytes(m_stream.expected() - 1, {});
    addBytes(m_stream.expected(), {});
    add(100, 5000);
    finish();
    expectPoses(20);
}

TEST_P(TcpStreamTest, KeepsTheBytesThatCameFirst) {
    const ByteVector other(m_sent.size(), std::byte{0xee});
    add(0, 100);
    addBytes(m_first + 50, std::span(other).first(50));
    add(300, 100);
    addBytes(m_first + 300, std::span(other).first(100));
    add(100, 200);
    addBytes(m_first, std::span(other).first(400));
    add(400, 5000);
    finish();
    expectPoses(20);
}

TEST_P(TcpStreamTest, WaitsASecondForWhatIsMissingAndThenGoesOn) {
    add(0, kPose);
    add(3 * kPose, kPose); // two are missing
    EXPECT_EQ(m_seen.size(), 1U);
    *m_time = WallTime(1ms) + TcpStream::kLongestWait;
    add(4 * kPose, kPose);
    EXPECT_EQ(m_seen.size(), 1U) << "the second is not over";
    *m_time = WallTime(2ms) + TcpStream::kLongestWait;
    add(5 * kPose, kPose);
    EXPECT_EQ(datagrams(),
              (std::vector{poseDatagram(1, 2), poseDatagram(4, 2), poseDatagram(5, 2), poseDatagram(6, 2)}));
    add(kPose, 2 * kPose); // too late
    finish();
    EXPECT_EQ(m_seen.size(), 4U);
    EXPECT_EQ(m_stream.expected(), m_first + 6 * kPose);
}

TEST_P(TcpStreamTest, WaitsWithoutEndWhereFramesHaveNoStamp) {
    m_time.reset();
    add(kPose, 18 * kPose);
    EXPECT_TRUE(m_seen.empty());
    add(0, kPose);
    EXPECT_EQ(m_seen.size(), 19U);
    EXPECT_EQ(m_seen[18].stamp, std::nullopt);
}

TEST_P(TcpStreamTest, GivesWhatWaitsWhenItEnds) {
    add(0, 100);
    add(2 * kPose, kPose);
    add(4 * kPose, kPose);
    finish();
    ASSERT_EQ(datagrams().size(), 4U);
    EXPECT_EQ(datagrams()[1], ByteVector(m_sent.begin() + kPose, m_sent.begin() + 100)) << "cut off by a gap";
    EXPECT_EQ(datagrams()[2], poseDatagram(3, 2));
    EXPECT_EQ(datagrams()[3], poseDatagram(5, 2));
}

TEST_P(TcpStreamTest, PassesOverAGapAmidADatagram) {
    add(0, 100);
    add(2 * kPose + 30, 5000); // the rest of the third, then whole ones
    finish();
    std::size_t skipped = 0;
    for (const SeenSegment& one : m_seen) {
        skipped += one.isSkipped ? one.bytes.size() : 0;
    }
    EXPECT_EQ(skipped, kPose - 30);
    ASSERT_EQ(datagrams().size(), 2U + 17);
    EXPECT_EQ(datagrams().back(), poseDatagram(20, 2));
}

TEST_P(TcpStreamTest, ReportsTheStampOfTheFrameThatCompletedADatagram) {
    add(0, 50);         // at 0 ms
    add(100, 76);       // 1 ms: waits
    add(50, 50);        // 2 ms: completes the first, and the second that waited
    add(2 * kPose, 88); // 3 ms
    ASSERT_EQ(m_seen.size(), 3U);
    EXPECT_EQ(m_seen[0].stamp, WallTime(2ms));
    EXPECT_EQ(m_seen[1].stamp, WallTime(2ms));
    EXPECT_EQ(m_seen[2].stamp, WallTime(3ms));
}

TEST_P(TcpStreamTest, ReportsWhereInTheFileADatagramBegins) {
    std::mt19937 random(GetParam());
    for (std::size_t at = 0; at < m_sent.size();) {
        const std::size_t size = 1 + random() % 200;
        add(at, size);
        at += size;
    }
    ASSERT_EQ(m_seen.size(), 20U);
    for (std::size_t i = 0; i < m_seen.size(); ++i) {
        EXPECT_EQ(m_seen[i].offset, 1'000'000 + i * kPose);
    }
}

/// No window is wider than 2^30 bytes (RFC 7323): what is far away belongs to another connection.
TEST_P(TcpStreamTest, StartsAgainFarOutsideTheWindow) {
    add(0, kPose + 20);
    m_first += 0x40000000;
    add(0, kPose);
    EXPECT_EQ(m_stream.expected(), m_first + kPose);
    m_first -= 0x70000000;
    add(0, kPose);
    ASSERT_EQ(datagrams().size(), 4U);
    EXPECT_EQ(datagrams()[1].size(), 20U);
    EXPECT_EQ(datagrams()[2], poseDatagram(1, 2));
    EXPECT_EQ(datagrams()[3], poseDatagram(1, 2));
}

TEST_P(TcpStreamTest, StartsAgainWithAnotherSequenceNumber) {
    add(0, 50);
    add(2 * kPose, kPose);
    m_first += 12'345;
    m_stream.restart(m_first);
    EXPECT_EQ(m_stream.expected(), m_first);
    EXPECT_EQ(datagrams(),
              (std::vector{ByteVector(m_sent.begin(), m_sent.begin() + 50), poseDatagram(3, 2)}));
    m_seen.clear();
    add(0, 5000);
    finish();
    expectPoses(20);
}

/// What waits is bounded also where it comes in segments of one byte.
TEST_P(TcpStreamTest, BoundsWhatWaitsInSmallSegments) {
    const ByteVector bytes(1, std::byte{1});
    std::size_t count = 0;
    while (m_seen.empty() && count < 100'000) {
        m_time = WallTime();
        addBytes(m_first + 10 + 2 * static_cast<std::uint32_t>(count++), bytes);
    }
    EXPECT_LE(count, TcpStream::kMostWaiting / 100);
    EXPECT_GT(count, 100U);
}

} // namespace
} // namespace posewire::log
