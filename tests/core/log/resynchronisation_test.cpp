// SPDX-License-Identifier: MIT
#include "core/log/tcp_framer.h"

#include "tests/core/log/datagram_fixture.h"

#include <gtest/gtest.h>

#include <random>

namespace posewire::log {
namespace {

using Kind = TcpFramer::Kind;

/// One of each type, as new senders send it (`Counted`) or old ones.
std::vector<ByteVector> everyType(wire::HeaderEra era, std::uint32_t sample) {
    using namespace wire;
    const std::string time = "12:34:56.789";
    TimeCode timeCode;
    std::copy(time.begin(), time.end(), timeCode.text.begin());
    const std::vector<Body> bodies{
        PoseEuler{{{1, {1, 2, 3}, {4, 5, 6}}}},
        PoseQuaternion{{{1, {1, 2, 3}, {1, 0, 0, 0}}, {2, {1, 2, 3}, {0, 1, 0, 0}}}},
        PointPositions{{{257, {1, 2, 3}}}},
        TagPositions{{{1, {1, 2, 3}}, {2, {1, 2, 3}}}},
        PoseUnity{{{1, {1, 2, 3}, {1, 0, 0, 0}}}},
        ScaleInformation{{{1, {}, {1, 0, 0, 0, 1, 0, 0, 0, 1}}}},
        PropInformation{{{24, "Sword"}, {25, "Gun"}}},
        MetaData{true, "name:A\ncolor:ff0000\n"},
        NullPose{{{"Pelvis", {0, 0, 1}}}, {{1, 13, "pSacrum", 0, {1, 2, 3}}}},
        JointAngles{{{258, 513, {1, 2, 3}}}},
        LinearKinematics{{{1, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}}}},
        AngularKinematics{{{1, {1, 0, 0, 0}, {4, 5, 6}, {7, 8, 9}}}},
        TrackerKinematics{true, {{1, {1, 0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}}}},
        CentreOfMass{true, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}},
        timeCode,
    };
    std::vector<ByteVector> all;
    for (const Body& body : bodies) {
        all.push_back(bytesOfDatagram(body, sample, era));
    }
    return all;
}

struct Pieces {
    std::vector<ByteVector> datagrams;
    std::size_t skipped = 0;
};

/// Pushes a stream in slices of 1 to `most` bytes.
Pieces piecesOf(const ByteVector& stream, std::mt19937& random, std::size_t most) {
    Pieces pieces;
    std::uint64_t next = 0;
    const TcpFramer::Visitor visit = [&](const TcpFramer::Piece& piece) {
        EXPECT_EQ(piece.offset, next) << "every byte is in one piece";
        next += piece.bytes.size();
        if (piece.kind == Kind::Skipped) {
            pieces.skipped += piece.bytes.size();
        } else {
            pieces.datagrams.emplace_back(piece.bytes.begin(), piece.bytes.end());
        }
    };
    TcpFramer framer;
    for (std::size_t at = 0; at < stream.size();) {
        const std::size_t size = std::min(stream.size() - at, 1 + random() % most);
        framer.push(std::span(stream).subspan(at, size), visit);
        at += size;
    }
    framer.finish(visit);
    EXPECT_EQ(next, stream.size());
    EXPECT_EQ(framer.skippedBytes(), pieces.skipped);
    return pieces;
}

ByteVector garbage(std::mt19937& random, std::size_t size) {
    ByteVector bytes(size);
    for (std::byte& byte : bytes) {
        const auto value = static_cast<unsigned>(random() & 0xff);
        byte = static_cast<std::byte>(value == 'M' ? 0 : value); // begins no datagram by chance
    }
    return bytes;
}

TEST(Resynchronisation, FindsEveryDatagramOfAMixedStreamOfAllTypes) {
    std::mt19937 random(1);
    for (int round = 0; round < 60; ++round) {
        std::vector<ByteVector> sent;
        for (int i = 0; i < 30; ++i) {
            const auto era = random() % 2 == 0 ? wire::HeaderEra::Counted : wire::HeaderEra::Reserved;
            const auto types = everyType(era, static_cast<std::uint32_t>(i));
            sent.push_back(types[random() % types.size()]);
        }
        const Pieces pieces = piecesOf(joined(sent), random, 1 + random() % 300);
        ASSERT_EQ(pieces.datagrams, sent) << "round " << round;
        EXPECT_EQ(pieces.skipped, 0U);
    }
}

TEST(Resynchronisation, LosesNoDatagramBehindGarbage) {
    std::mt19937 random(2);
    for (int round = 0; round < 60; ++round) {
        std::vector<ByteVector> sent;
        std::vector<ByteVector> stream;
        std::size_t between = 0;
        for (int i = 0; i < 20; ++i) {
            const auto types = everyType(wire::HeaderEra::Counted, static_cast<std::uint32_t>(i));
            stream.push_back(garbage(random, random() % 60));
            between += stream.back().size();
            sent.push_back(types[random() % types.size()]);
            stream.push_back(sent.back());
        }
        const Pieces pieces = piecesOf(joined(stream), random, 200);
        ASSERT_EQ(pieces.datagrams, sent) << "round " << round;
        EXPECT_EQ(pieces.skipped, between);
    }
}

/// Whoever joins a stream amidst a datagram gets every one after it.
TEST(Resynchronisation, FindsTheNextDatagramFromAnyByteOfTheOneBefore) {
    std::mt19937 random(3);
    for (const wire::HeaderEra era : {wire::HeaderEra::Counted, wire::HeaderEra::Reserved}) {
        const auto types = everyType(era, 7);
        for (std::size_t i = 0; i + 1 < types.size(); ++i) {
            for (std::size_t at = 1; at < types[i].size(); ++at) {
                const ByteVector rest(types[i].begin() + static_cast<std::ptrdiff_t>(at), types[i].end());
                const Pieces pieces = piecesOf(joined({rest, types[i + 1], types[0]}), random, 1000);
                ASSERT_EQ(pieces.datagrams, (std::vector{types[i + 1], types[0]})) << i << " from " << at;
                ASSERT_EQ(pieces.skipped, rest.size());
            }
        }
    }
}

/// Bytes that were lost from a datagram cost that one, and at most the one after it.
TEST(Resynchronisation, LosesAtMostOneNeighbourWhereBytesAreMissing) {
    std::mt19937 random(4);
    const ByteVector first = poseDatagram(1, 4);
    const ByteVector damaged = poseDatagram(2, 4);
    const std::vector<ByteVector> after{poseDatagram(3, 4), poseDatagram(4, 4), poseDatagram(5, 4)};
    for (std::size_t lost = 1; lost < damaged.size(); ++lost) {
        ByteVector part(damaged.begin(), damaged.end() - static_cast<std::ptrdiff_t>(lost));
        const Pieces pieces = piecesOf(joined({first, part, joined(after)}), random, 500);
        ASSERT_GE(pieces.datagrams.size(), 3U) << lost;
        EXPECT_EQ(pieces.datagrams.front(), first) << lost;
        EXPECT_EQ(pieces.datagrams.back(), after[2]) << lost;
        EXPECT_EQ(pieces.datagrams[pieces.datagrams.size() - 2], after[1]) << lost;
    }
}

/// Marks that begin no datagram do not hide the one that follows.
TEST(Resynchronisation, IsNotMisledByMarksWithoutADatagram) {
    std::mt19937 random(5);
    const ByteVector pose = poseDatagram(1, 2);
    for (const char* misleading :
         {"M", "MX", "MXT", "MXTP", "MXTP0", "MXTP0x", "MXTPMXTP", "MMMMXTP", "MXMXTP", "MXTPMXTPMXTP0"}) {
        const Pieces pieces = piecesOf(joined({pose, textBytes(misleading), pose, pose}), random, 20);
        EXPECT_EQ(pieces.datagrams, (std::vector{pose, pose, pose})) << misleading;
        EXPECT_EQ(pieces.skipped, std::string_view(misleading).size()) << misleading;
    }
}

TEST(Resynchronisation, IsReadyForAnotherStreamAfterTheEnd) {
    TcpFramer framer;
    std::vector<std::uint64_t> offsets;
    const TcpFramer::Visitor visit = [&](const TcpFramer::Piece& piece) { offsets.push_back(piece.offset); };
    const ByteVector pose = poseDatagram(1, 2);
    const ByteVector half(pose.begin(), pose.begin() + 40);
    framer.push(half, visit);
    EXPECT_EQ(framer.kept(), 40U);
    framer.finish(visit);
    EXPECT_EQ(framer.kept(), 0U);
    framer.push(pose, visit);
    framer.finish(visit);
    EXPECT_EQ(offsets, (std::vector<std::uint64_t>{0, 0})) << "the rest of the first is none of the second";
}

/// Random bytes with marks strewn in: all bytes come out once, and memory is bounded.
TEST(Resynchronisation, AccountsForEveryByteOfHostileStreams) {
    std::mt19937 random(6);
    const auto types = everyType(wire::HeaderEra::Counted, 1);
    for (int round = 0; round < 100; ++round) {
        std::vector<ByteVector> parts;
        for (int i = 0; i < 20; ++i) {
            ByteVector part = types[random() % types.size()];
            part[random() % part.size()] = static_cast<std::byte>(random());
            part.resize(part.size() - random() % 20);
            parts.push_back(random() % 3 == 0 ? garbage(random, random() % 100) : part);
        }
        const ByteVector stream = joined(parts);
        std::mt19937 once(7);
        const Pieces whole = piecesOf(stream, once, stream.size());
        const Pieces sliced = piecesOf(stream, random, 50);
        ASSERT_EQ(whole.datagrams, sliced.datagrams) << "round " << round;
        ASSERT_EQ(whole.skipped, sliced.skipped);
    }
}

} // namespace
} // namespace posewire::log
