// SPDX-License-Identifier: MIT
#include "core/log/tcp_framer.h"

#include "tests/core/log/datagram_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <ostream>
#include <random>

namespace posewire::log {
namespace {

constexpr auto kDatagram = TcpFramer::Kind::Datagram;
constexpr auto kSkipped = TcpFramer::Kind::Skipped;

struct Found {
    std::uint64_t offset;
    std::size_t size;
    TcpFramer::Kind kind;

    friend bool operator==(const Found&, const Found&) = default;
    friend std::ostream& operator<<(std::ostream& out, const Found& found) {
        return out << (found.kind == kDatagram ? "datagram " : "skipped ") << found.offset << '+'
                   << found.size;
    }
};

/// Feeds the stream in the given slices and checks that every piece shows the bytes of its place.
std::vector<Found> cut(const ByteVector& stream, const std::vector<std::size_t>& cuts) {
    std::vector<Found> found;
    const TcpFramer::Visitor visit = [&](const TcpFramer::Piece& piece) {
        found.push_back({piece.offset, piece.bytes.size(), piece.kind});
        ASSERT_LE(piece.offset + piece.bytes.size(), stream.size());
        ASSERT_EQ(std::memcmp(piece.bytes.data(), stream.data() + piece.offset, piece.bytes.size()), 0);
    };
    TcpFramer framer;
    std::size_t begin = 0;
    for (const std::size_t end : cuts) {
        framer.push(std::span(stream).subspan(begin, end - begin), visit);
        EXPECT_LE(framer.kept(), TcpFramer::kMostKept);
        begin = end;
    }
    framer.push(std::span(stream).subspan(begin), visit);
    framer.finish(visit);
    EXPECT_EQ(framer.kept(), 0U);
    return found;
}

std::vector<Found> cutWhole(const ByteVector& stream) {
    return cut(stream, {});
}

std::vector<Found> cutByBytes(const ByteVector& stream) {
    std::vector<std::size_t> cuts(stream.size());
    for (std::size_t i = 0; i < cuts.size(); ++i) {
        cuts[i] = i;
    }
    return cut(stream, cuts);
}

std::size_t skippedBytes(const std::vector<Found>& found) {
    std::size_t bytes = 0;
    for (const Found& piece : found) {
        bytes += piece.kind == kSkipped ? piece.size : 0;
    }
    return bytes;
}

ByteVector timeCode(std::uint32_t sample) {
    return bytesOfDatagram(wire::TimeCode{}, sample);
}

/// A bit of everything that can stand in a stream.
ByteVector mixedStream() {
    return joined({poseDatagram(1, 2), timeCode(1), textBytes("garbage MXTP and MXTP0 and MX"),
                   poseDatagram(2, 1), withPayloadSize(poseDatagram(3, 2), 999),
                   poseDatagram(4, 2, wire::HeaderEra::Reserved),
                   withPayloadSize(textBytes("MXTP99.........x0000......hello"), 0), timeCode(5),
                   textBytes(std::string("\0\xff", 2)), poseDatagram(6, 2), textBytes("MXTP02 cut off")});
}

TEST(TcpFramer, SplitsCoalescedDatagrams) {
    const auto found = cutWhole(joined({poseDatagram(1), timeCode(1), poseDatagram(2)}));
    EXPECT_EQ(found, (std::vector<Found>{{0, 760, kDatagram}, {760, 40, kDatagram}, {800, 760, kDatagram}}));
}

TEST(TcpFramer, FallsBackToComputedSizesWhereTheHeaderHasNone) {
    const auto stream = joined(
        {poseDatagram(1, 23, wire::HeaderEra::Reserved), poseDatagram(2, 5, wire::HeaderEra::Reserved)});
    EXPECT_EQ(cutWhole(stream), (std::vector<Found>{{0, 760, kDatagram}, {760, 184, kDatagram}}));
}

TEST(TcpFramer, GivesACleanDatagramOutWithItsLastByte) {
    TcpFramer framer;
    int count = 0;
    const TcpFramer::Visitor visit = [&](const TcpFramer::Piece&) { ++count; };
    const auto datagram = poseDatagram(1);
    framer.push(std::span(datagram).first(759), visit);
    EXPECT_EQ(count, 0);
    framer.push(std::span(datagram).last(1), visit);
    EXPECT_EQ(count, 1);
    EXPECT_EQ(framer.kept(), 0U);
}

TEST(TcpFramer, CountsGarbageBetweenDatagrams) {
    const auto found =
        cutWhole(joined({textBytes("abc"), poseDatagram(1, 1), textBytes("MXTPxy"), poseDatagram(2, 1)}));
    EXPECT_EQ(found, (std::vector<Found>{
                         {0, 3, kSkipped}, {3, 56, kDatagram}, {59, 6, kSkipped}, {65, 56, kDatagram}}));
}

TEST(TcpFramer, CountsSkippedBytesOverStreams) {
    TcpFramer framer;
    const TcpFramer::Visitor ignore = [](const TcpFramer::Piece&) {};
    for (int i = 0; i < 2; ++i) {
        framer.push(textBytes("nothing"), ignore);
        framer.finish(ignore);
    }
    EXPECT_EQ(framer.skippedBytes(), 14U);
}

TEST(TcpFramer, MarkInsideFloatDataIsNoDatagram) {
    auto datagram = poseDatagram(1, 4);
    std::memcpy(datagram.data() + 24 + 4, "MXTP", 4);
    std::memcpy(datagram.data() + 24 + 8, "02", 2);
    const auto found = cutWhole(joined({datagram, poseDatagram(2, 1)}));
    EXPECT_EQ(found, (std::vector<Found>{{0, 152, kDatagram}, {152, 56, kDatagram}}));
}

TEST(TcpFramer, MarkInsideFloatDataIsNoDatagramAlsoAfterGarbage) {
    // The stream is joined amidst a datagram that contains the mark: what follows the mark does not bear it
    // out.
    auto datagram = poseDatagram(1, 4);
    std::memcpy(datagram.data() + 40, "MXTP02", 6);
    datagram.erase(datagram.begin(), datagram.begin() + 30);
    const auto found = cutWhole(joined({datagram, poseDatagram(2, 1), poseDatagram(3, 1)}));
    ASSERT_GE(found.size(), 2U);
    EXPECT_EQ(found[found.size() - 2], (Found{122, 56, kDatagram}));
    EXPECT_EQ(found[found.size() - 1], (Found{178, 56, kDatagram}));
}

TEST(TcpFramer, WrongSizeCostsOneDatagram) {
    for (const int wrong : {1, 31, 33, 40, 70, 999, 40000, 65535}) {
        const auto stream = joined({poseDatagram(1, 1),
                                    withPayloadSize(poseDatagram(2, 1), static_cast<std::uint16_t>(wrong)),
                                    poseDatagram(3, 1), poseDatagram(4, 1)});
        const auto found = cutWhole(stream);
        ASSERT_GE(found.size(), 4U) << wrong;
        EXPECT_EQ(found[0], (Found{0, 56, kDatagram})) << wrong;
        EXPECT_EQ(found[1].offset, 56U) << wrong;
        EXPECT_EQ(found[found.size() - 2], (Found{112, 56, kDatagram})) << wrong;
        EXPECT_EQ(found[found.size() - 1], (Found{168, 56, kDatagram})) << wrong;
    }
}

TEST(TcpFramer, UnknownTypeWithoutSizeEndsWhereTheNextDatagramBegins) {
    auto unknown = poseDatagram(1, 3, wire::HeaderEra::Reserved);
    unknown[4] = std::byte{'9'};
    EXPECT_EQ(cutWhole(joined({unknown, poseDatagram(2, 1)})),
              (std::vector<Found>{{0, 120, kDatagram}, {120, 56, kDatagram}}));
    EXPECT_EQ(cutWhole(unknown), (std::vector<Found>{{0, 120, kDatagram}}));
}

TEST(TcpFramer, UnknownTypeWithSizeIsTakenWhereADatagramIsDue) {
    auto unknown = poseDatagram(1, 3);
    unknown[4] = std::byte{'9'};
    EXPECT_EQ(cutWhole(joined({poseDatagram(1, 1), unknown, textBytes("?"), unknown, poseDatagram(2, 1)})),
              (std::vector<Found>{{0, 56, kDatagram},
                                  {56, 120, kDatagram},
                                  {176, 1, kSkipped},
                                  {177, 120, kDatagram},
                                  {297, 56, kDatagram}}));
}

TEST(TcpFramer, RestIsADatagramIfItBeginsLikeOneElseSkipped) {
    auto half = poseDatagram(2);
    half.resize(300);
    EXPECT_EQ(cutWhole(joined({poseDatagram(1, 1), half})),
              (std::vector<Found>{{0, 56, kDatagram}, {56, 300, kDatagram}}));
    EXPECT_EQ(cutWhole(joined({poseDatagram(1, 1), textBytes("MXTP02")})),
              (std::vector<Found>{{0, 56, kDatagram}, {56, 6, kDatagram}}));
    EXPECT_EQ(cutWhole(joined({poseDatagram(1, 1), textBytes("MXTP0")})),
              (std::vector<Found>{{0, 56, kDatagram}, {56, 5, kSkipped}}));
    EXPECT_EQ(cutWhole(joined({poseDatagram(1, 1), textBytes("rest")})),
              (std::vector<Found>{{0, 56, kDatagram}, {56, 4, kSkipped}}));
}

TEST(TcpFramer, EmptyStreamHasNoPieces) {
    EXPECT_TRUE(cutWhole({}).empty());
}

TEST(TcpFramer, SlicingAtAnyPlaceChangesNothing) {
    const auto stream = mixedStream();
    const auto whole = cutWhole(stream);
    ASSERT_GT(skippedBytes(whole), 0U);
    for (std::size_t at = 0; at <= stream.size(); ++at) {
        ASSERT_EQ(cut(stream, {at}), whole) << "cut at " << at;
    }
    EXPECT_EQ(cutByBytes(stream), whole);
}

TEST(TcpFramer, TruncatingAtAnyPlaceLosesNoEarlierDatagram) {
    const auto stream = joined({poseDatagram(1, 1), textBytes("xx"), timeCode(1), poseDatagram(2, 1)});
    for (std::size_t size = 0; size <= stream.size(); ++size) {
        const ByteVector part(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(size));
        const auto found = cutWhole(part);
        EXPECT_EQ(found, cutByBytes(part)) << size;
        if (size >= 98) {
            EXPECT_EQ(found[2], (Found{58, 40, kDatagram})) << size;
        }
    }
}

TEST(TcpFramer, RandomStreamsDoNotDependOnSlicing) {
    std::mt19937 random(11);
    for (int round = 0; round < 300; ++round) {
        ByteVector stream = joined({mixedStream(), mixedStream()});
        for (std::uint32_t faults = random() % 8; faults > 0; --faults) {
            stream[random() % stream.size()] = static_cast<std::byte>(random());
        }
        stream.erase(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(random() % 200));
        const auto whole = cutWhole(stream);
        std::vector<std::size_t> cuts;
        for (std::size_t at = random() % 100; at < stream.size(); at += random() % 100) {
            cuts.push_back(at);
        }
        ASSERT_EQ(cut(stream, cuts), whole) << "round " << round;
        ASSERT_EQ(cutByBytes(stream), whole) << "round " << round;
    }
}

TEST(TcpFramer, LongGarbageNeedsNoMoreMemoryAndDoesNotDependOnSlicing) {
    ByteVector garbage(300'000, std::byte{'M'});
    const auto stream = joined({poseDatagram(1, 1), garbage, poseDatagram(2, 1)});
    const auto whole = cutWhole(stream);
    EXPECT_EQ(skippedBytes(whole), garbage.size());
    EXPECT_EQ(whole.back().kind, kDatagram);
    std::vector<std::size_t> cuts;
    for (std::size_t at = 0; at < stream.size(); at += 777) {
        cuts.push_back(at);
    }
    EXPECT_EQ(cut(stream, cuts), whole);
}

TEST(TcpFramer, EndlessDatagramWithoutSizeIsGivenUp) {
    auto unknown = poseDatagram(1, 1, wire::HeaderEra::Reserved);
    unknown[4] = std::byte{'9'};
    const auto stream = joined({unknown, ByteVector(200'000), poseDatagram(2, 1)});
    const auto whole = cutWhole(stream);
    EXPECT_EQ(whole.back(), (Found{stream.size() - 56, 56, kDatagram}));
    EXPECT_EQ(skippedBytes(whole), stream.size() - 56);
    std::vector<std::size_t> cuts;
    for (std::size_t at = 0; at < stream.size(); at += 1448) {
        cuts.push_back(at);
    }
    EXPECT_EQ(cut(stream, cuts), whole);
}

TEST(TcpFramer, LongestDatagramPasses) {
    wire::RawBody body{ByteVector(65'507 - 24, std::byte{7})};
    wire::Datagram datagram;
    datagram.header.setType(99);
    datagram.header.payloadSize = 65'507 - 24;
    datagram.body = body;
    const auto longest = wire::encode(datagram).value();
    const auto stream = joined({longest, poseDatagram(1, 1)});
    EXPECT_EQ(cutWhole(stream), (std::vector<Found>{{0, 65'507, kDatagram}, {65'507, 56, kDatagram}}));
}

} // namespace
} // namespace posewire::log
