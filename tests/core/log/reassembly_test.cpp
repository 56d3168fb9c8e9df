// SPDX-License-Identifier: MIT
#include "core/log/reassembly.h"

#include "tests/core/log/capture_fixture.h"

#include <gmock/gmock.h>

#include <random>

namespace posewire::log {
namespace {

using namespace std::chrono_literals;

struct SeenDatagram {
    std::uint64_t offset;
    ByteVector bytes;
    bool isSkipped;
    std::optional<WallTime> stamp;
    std::string address;
    Transport transport;
};

/// A capture of raw IP packets, one a millisecond; its offsets count as if they stood one after another.
class Capture {
public:
    void add(const ByteVector& packet) {
        m_reassembly.add({101, packet, m_offset, m_stamp});
        m_offset += packet.size();
        m_stamp += 1ms;
    }
    void pass(Duration time) { m_stamp += time; }
    std::vector<SeenDatagram>& finish() {
        m_reassembly.finish();
        return m_seen;
    }
    [[nodiscard]] const std::vector<SeenDatagram>& seen() const { return m_seen; }
    [[nodiscard]] std::uint64_t offset() const { return m_offset; }
    [[nodiscard]] std::vector<ByteVector> datagrams() {
        std::vector<ByteVector> all;
        for (const SeenDatagram& one : finish()) {
            if (!one.isSkipped) {
                all.push_back(one.bytes);
            }
        }
        return all;
    }
    [[nodiscard]] std::size_t skippedBytes() const {
        std::size_t sum = 0;
        for (const SeenDatagram& one : m_seen) {
            sum += one.isSkipped ? one.bytes.size() : 0;
        }
        return sum;
    }

private:
    std::vector<SeenDatagram> m_seen;
    FileVisitor m_visit = [this](const FileRecord& record) {
        m_seen.push_back({record.offset,
                          {record.bytes.begin(), record.bytes.end()},
                          record.flags.skipped,
                          record.time,
                          record.sender->address,
                          record.sender->transport});
    };
    Reassembly m_reassembly{m_visit};
    std::uint64_t m_offset = 0;
    WallTime m_stamp{};
};

/// As IPv4 with the identity 1, or `identity`.
std::vector<ByteVector> fragmentsOf(const ByteVector& content, std::size_t size, std::uint16_t identity = 1) {
    std::vector<ByteVector> fragments;
    for (std::size_t at = 0; at < content.size(); at += size) {
        const bool isLast = at + size >= content.size();
        ByteVector packet =
            ipv4(slice(content, at, size), static_cast<std::uint16_t>(at / 8 | (isLast ? 0U : 0x2000U)));
        packet[4] = static_cast<std::byte>(identity >> 8);
        packet[5] = static_cast<std::byte>(identity & 0xff);
        fragments.push_back(packet);
    }
    return fragments;
}

/// A stream of poses with the samples 1 … count.
ByteVector posesUpTo(std::uint32_t count) {
    std::vector<ByteVector> all;
    for (std::uint32_t sample = 1; sample <= count; ++sample) {
        all.push_back(poseDatagram(sample, 2));
    }
    return joined(all);
}
std::vector<ByteVector> posesApart(std::uint32_t count) {
    std::vector<ByteVector> all;
    for (std::uint32_t sample = 1; sample <= count; ++sample) {
        all.push_back(poseDatagram(sample, 2));
    }
    return all;
}

TEST(Reassembly, PutsFragmentsTogetherInAnyOrder) {
    const ByteVector pose = poseDatagram(7, 67);
    const std::vector<ByteVector> fragments = fragmentsOf(udp(pose), 600);
    ASSERT_EQ(fragments.size(), 4U);
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    do {
        Capture capture;
        for (const std::size_t index : order) {
            capture.add(fragments[index]);
        }
        ASSERT_EQ(capture.seen().size(), 1U);
        EXPECT_EQ(capture.seen()[0].bytes, pose);
        EXPECT_EQ(capture.seen()[0].stamp, WallTime(3ms));
        EXPECT_EQ(capture.seen()[0].address, "10.0.0.2:40001");
    } while (std::ranges::next_permutation(order).found);
}

TEST(Reassembly, KeepsFragmentsOfPacketsApartAndTakesRepeatedOnesOnce) {
    const ByteVector first = poseDatagram(1, 67);
    const ByteVector second = poseDatagram(2, 67);
    const auto ones = fragmentsOf(udp(first), 1480, 1);
    const auto others = fragmentsOf(udp(second), 1480, 2);
    Capture capture;
    for (std::size_t i = 0; i < ones.size(); ++i) {
        capture.add(ones[i]);
        capture.add(others[i]);
        if (i == 0) {
            capture.add(ones[i]);
        }
    }
    EXPECT_EQ(capture.datagrams(), (std::vector{first, second}));
}

TEST(Reassembly, TakesForForeignWhatGoesWhereMxtpGoes) {
    const ByteVector pose = poseDatagram(7, 2);
    const ByteVector other = textBytes("{\"type\":\"transport\"}");
    Capture capture;
    capture.add(ipv4(udp(other, 5353, 5353))); // nobody's
    capture.add(ipv4(udp(other, 50'000, 9763)));
    capture.add(ipv4(udp(other, 50'000, 9999))); // nothing has come there yet
    capture.add(ipv4(udp(pose, 40'001, 9999)));
    capture.add(ipv4(udp(other, 50'000, 9999)));
    capture.add(ipv4(udp(other, 9999, 40'001))); // an answer
    capture.add(ipv4(udp({}, 40'001, 9999)));
    EXPECT_EQ(capture.datagrams(), (std::vector{other, pose, other, ByteVector{}}));
    EXPECT_EQ(capture.seen()[2].address, "10.0.0.2:50000");
}

TEST(Reassembly, PutsIpv6FragmentsTogether) {
    const ByteVector pose = poseDatagram(7, 67);
    const ByteVector content = udp(pose);
    Capture capture;
    for (std::size_t at = 0; at < content.size(); at += 1400) {
        const ByteVector part = slice(content, at, 1400);
        const std::size_t more = at + 1400 < content.size() ? 1 : 0;
        capture.add(CaptureBytes()
                        .number(0x60000000, 4)
                        .number(part.size() + 8, 2)
                        .number(44, 1)
                        .number(64, 1)
                        .zeros(15)
                        .number(2, 1)
                        .zeros(15)
                        .number(1, 1)
                        .number(17, 1)
                        .zeros(1)
                        .number(at | more, 2)
                        .number(0xabcdef01, 4)
                        .bytes(part)
                        .all());
    }
    ASSERT_EQ(capture.seen().size(), 1U);
    EXPECT_EQ(capture.seen()[0].bytes, pose);
    EXPECT_EQ(capture.seen()[0].address, "[::2]:40001");
}

TEST(Reassembly, GivesTheBeginningOfWhatStaysIncomplete) {
    const ByteVector pose = poseDatagram(7, 67);
    const auto fragments = fragmentsOf(udp(pose), 600);
    Capture capture;
    capture.add(fragments[3]);
    capture.add(fragments[0]);
    capture.add(fragments[1]);
    EXPECT_TRUE(capture.seen().empty());
    EXPECT_THAT(capture.datagrams(), testing::ElementsAre(slice(pose, 0, 1200 - 8)));
}

TEST(Reassembly, GivesUpTheOldestOfTooManyIncompletePackets) {
    Capture capture;
    const ByteVector content = udp(poseDatagram(7, 67));
    for (std::uint16_t identity = 0; identity < IpFragments::kMostPending + 3; ++identity) {
        capture.add(fragmentsOf(content, 1480, identity)[0]);
    }
    EXPECT_EQ(capture.seen().size(), 3U);
    capture.add(fragmentsOf(content, 1480, 2)[1]); // the first three were given up
    EXPECT_EQ(capture.seen().size(), 4U);
    EXPECT_LT(capture.seen()[3].bytes.size(), content.size() - 8);
    capture.add(fragmentsOf(content, 1480, 20)[1]);
    EXPECT_EQ(capture.seen()[4].bytes, poseDatagram(7, 67));
}

TEST(Reassembly, FollowsAStreamHoweverItIsCut) {
    const ByteVector bytes = posesUpTo(5);
    for (const std::size_t size : {1, 7, 88, 100, 1000}) {
        Capture capture;
        const std::uint32_t start = 0xffffff00; // wraps around amidst
        capture.add(tcp(start - 1, {}, kSyn));
        for (std::size_t at = 0; at < bytes.size(); at += size) {
            capture.add(tcp(start + static_cast<std::uint32_t>(at), slice(bytes, at, size)));
        }
        EXPECT_EQ(capture.seen().size(), 5U) << size; // before the stream has ended
        EXPECT_EQ(capture.datagrams(), posesApart(5)) << size;
    }
}

TEST(Reassembly, TellsWhereAndWhenADatagramOfAStreamWasCaptured) {
    const ByteVector bytes = posesUpTo(2);
    const std::size_t size = bytes.size() / 2;
    Capture capture;
    capture.add(tcp(100, slice(bytes, 0, size + 30)));
    capture.add(tcp(100 + static_cast<std::uint32_t>(size) + 30, slice(bytes, size + 30, size)));
    ASSERT_EQ(capture.seen().size(), 2U);
    EXPECT_EQ(capture.seen()[0].offset, 40U);
    EXPECT_EQ(capture.seen()[0].stamp, WallTime());
    EXPECT_EQ(capture.seen()[1].offset, 40U + size);
    EXPECT_EQ(capture.seen()[1].stamp, WallTime(1ms));
    EXPECT_EQ(capture.seen()[1].address, "10.0.0.2:40001");
    EXPECT_EQ(capture.seen()[1].transport, Transport::Tcp);
}

TEST(Reassembly, PutsSegmentsInOrderAndTakesRepeatedBytesOnce) {
    const ByteVector bytes = posesUpTo(20);
    std::mt19937 random(3);
    for (int round = 0; round < 50; ++round) {
        std::vector<std::pair<std::size_t, std::size_t>> parts;
        for (std::size_t at = 0; at < bytes.size();) {
            const std::size_t size = 1 + random() % 300;
            parts.emplace_back(at, size + random() % 50); // overlaps the next
            at += size;
        }
        parts.push_back(parts[random() % parts.size()]);
        std::shuffle(parts.begin() + 1, parts.end(), random);
        Capture capture;
        for (const auto& [at, size] : parts) {
            capture.add(tcp(5 + static_cast<std::uint32_t>(at), slice(bytes, at, size)));
        }
        EXPECT_EQ(capture.datagrams(), posesApart(20));
        EXPECT_EQ(capture.skippedBytes(), 0U);
    }
}

TEST(Reassembly, PassesOverWhatTheCaptureMissed) {
    const ByteVector bytes = posesUpTo(6); // 88 bytes each
    Capture capture;
    capture.add(tcp(0, slice(bytes, 0, 100)));
    capture.add(tcp(300, slice(bytes, 300, 100)));
    EXPECT_EQ(capture.seen().size(), 1U);
    capture.pass(TcpStream::kLongestWait);
    capture.add(tcp(400, slice(bytes, 400, 1000)));
    const auto poses = posesApart(6);
    EXPECT_EQ(capture.datagrams(), (std::vector{poses[0], slice(poses[1], 0, 12), poses[4], poses[5]}));
    EXPECT_EQ(capture.skippedBytes(), 52U); // the rest of the fourth
}

TEST(Reassembly, WaitsForAMissingSegmentWithBoundedMemory) {
    const ByteVector pose = poseDatagram(1, 2);
    Capture capture;
    capture.add(tcp(0, pose));
    std::uint32_t sequence = 2000;
    while (capture.seen().size() < 2 && sequence < 2'000'000) {
        capture.add(tcp(sequence, pose));
        capture.pass(-1ms);
        sequence += static_cast<std::uint32_t>(pose.size());
    }
    EXPECT_LT(sequence, 2000 + TcpStream::kMostWaiting);
    EXPECT_EQ(capture.finish().size(), 1 + (sequence - 2000) / pose.size());
}

TEST(Reassembly, FollowsConnectionsApartAndOneAfterAnother) {
    const auto poses = posesApart(4);
    Capture capture;
    capture.add(tcp(9, {}, kSyn, 50000));
    capture.add(tcp(700, {}, kSyn, 50001));
    capture.add(tcp(10, slice(poses[0], 0, 50), 0, 50000));
    capture.add(tcp(701, poses[1], 0, 50001));
    capture.add(tcp(60, slice(poses[0], 50, 50), kFin, 50000));
    capture.add(tcp(2'000'000'000, {}, kSyn, 50000));
    capture.add(tcp(2'000'000'001, poses[2], 0, 50000));
    capture.add(tcp(4'000'000'001, poses[3], 0, 50000)); // its beginning was not captured
    EXPECT_EQ(capture.datagrams(), (std::vector{poses[1], poses[0], poses[2], poses[3]}));
}

TEST(Reassembly, FindsStreamsOnOtherPortsByTheirFirstBytes) {
    const ByteVector bytes = posesUpTo(3);
    Capture capture;
    capture.add(tcp(1, textBytes("GET / HTTP/1.1 MXTP02"), 0, 80, 5000));
    capture.add(tcp(1, slice(bytes, 0, 100), 0, 4000, 5000));
    capture.add(tcp(101, slice(bytes, 100, 1000), 0, 4000, 5000));
    EXPECT_EQ(capture.datagrams(), posesApart(3));
    EXPECT_EQ(capture.skippedBytes(), 0U);
}

TEST(Reassembly, BeginsAmidstAStreamOnThePortOfMxtp) {
    const ByteVector bytes = posesUpTo(3);
    Capture capture;
    capture.add(tcp(30, slice(bytes, 30, 1000)));
    const auto poses = posesApart(3);
    EXPECT_EQ(capture.datagrams(), (std::vector{poses[1], poses[2]}));
    EXPECT_EQ(capture.skippedBytes(), 58U);
}

TEST(Reassembly, EndsTheStreamThatWasSilentLongestOfTooMany) {
    Capture capture;
    const ByteVector half = slice(poseDatagram(1, 2), 0, 50);
    for (std::uint16_t port = 0; port < Reassembly::kMostStreams + 2; ++port) {
        capture.add(tcp(0, half, 0, static_cast<std::uint16_t>(1000 + port)));
    }
    ASSERT_EQ(capture.seen().size(), 2U);
    EXPECT_EQ(capture.seen()[1].address, "10.0.0.2:1001");
}

TEST(Reassembly, SurvivesDamageAnywhere) {
    const ByteVector bytes = posesUpTo(4);
    std::vector<ByteVector> packets = fragmentsOf(udp(poseDatagram(1, 67)), 600);
    for (std::size_t at = 0; at < bytes.size(); at += 60) {
        packets.push_back(tcp(static_cast<std::uint32_t>(at), slice(bytes, at, 60)));
    }
    std::mt19937 random(1);
    for (int round = 0; round < 3000; ++round) {
        Capture capture;
        for (ByteVector packet : packets) {
            packet[random() % 44] = static_cast<std::byte>(random());
            capture.add(slice(packet, 0, packet.size() - random() % 3));
        }
        for (const SeenDatagram& one : capture.finish()) {
            EXPECT_LE(one.offset, capture.offset());
        }
    }
}

} // namespace
} // namespace posewire::log
