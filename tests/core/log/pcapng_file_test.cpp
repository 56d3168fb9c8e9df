// SPDX-License-Identifier: MIT
#include "tests/core/log/capture_fixture.h"
#include "tests/core/log/recording_fixture.h"

#include <gmock/gmock.h>

#include <random>

namespace posewire::log {
namespace {

using namespace std::chrono_literals;

constexpr std::uint16_t kRawIpInterface = 101;

enum : std::uint16_t { kEnd = 0, kComment = 1, kDropCount = 4, kResolution = 9, kOffset = 14 };

/// In either byte order, and blocks to build files of.
class PcapngFile : public testing::TestWithParam<bool> {
protected:
    [[nodiscard]] bool bigEndian() const { return GetParam(); }
    [[nodiscard]] ByteVector section() const { return sectionHeader(bigEndian()); }
    [[nodiscard]] ByteVector number(std::uint64_t value, int size) const {
        return CaptureBytes(bigEndian()).number(value, size).all();
    }
    [[nodiscard]] ByteVector option(std::uint16_t code, const ByteVector& value) const {
        return log::option(code, value, bigEndian());
    }
    [[nodiscard]] ByteVector interface(const ByteVector& options = {}, std::uint32_t snapLength = 0) const {
        return interfaceWith(kRawIpInterface, snapLength, options, bigEndian());
    }
    [[nodiscard]] ByteVector packet(std::uint64_t stamp, const ByteVector& options = {},
                                    std::uint32_t onInterface = 0) const {
        return enhancedPacket(onInterface, stamp, ipv4(udp(poseDatagram(1, 1))), bigEndian(), options);
    }
    /// Of the one packet of a file with that interface.
    [[nodiscard]] Stamp stampRead(std::uint64_t stamp, const ByteVector& interfaceOptions) const {
        const auto seen = recordedIn(joined({section(), interface(interfaceOptions), packet(stamp)}));
        EXPECT_EQ(seen.size(), 1U);
        return seen.empty() ? Stamp::min() : seen[0].stamp;
    }
};
INSTANTIATE_TEST_SUITE_P(ByteOrders, PcapngFile, testing::Bool());

/// if_tsresol: 10^-n seconds; without it microseconds.
TEST_P(PcapngFile, ReadsStampsInEveryDecimalResolution) {
    EXPECT_EQ(stampRead(1'700'000'000'123'456, {}), Stamp(1'700'000'000s + 123'456us));
    std::uint64_t perSecond = 1;
    for (std::uint8_t digits = 0; digits <= 9; ++digits, perSecond *= 10) {
        const std::uint64_t fraction = perSecond * 3 / 4;
        const std::uint64_t nanoseconds = fraction * (1'000'000'000 / perSecond);
        EXPECT_EQ(stampRead(1'700'000'000 * perSecond + fraction, option(kResolution, {std::byte{digits}})),
                  Stamp(1'700'000'000s + Duration(nanoseconds)))
            << int{digits};
    }
}

/// Finer than a nanosecond: the whole nanoseconds.
TEST_P(PcapngFile, CutsFinerStampsToNanoseconds) {
    std::mt19937 random(2);
    for (const auto& [digits, perNanosecond] :
         {std::pair{std::uint8_t{10}, std::uint64_t{10}}, {12, 1000}, {15, 1'000'000}, {18, 1'000'000'000}}) {
        std::vector<ByteVector> blocks{section(), interface(option(kResolution, {std::byte{digits}}))};
        std::vector<Stamp> stamps;
        for (int i = 0; i < 500; ++i) {
            const std::uint64_t nanoseconds = random() % 2'000'000'000;
            const std::uint64_t rest = i % 2 == 0 ? 0 : random() % perNanosecond;
            blocks.push_back(packet(nanoseconds * perNanosecond + rest));
            stamps.emplace_back(Duration(nanoseconds));
        }
        const auto seen = recordedIn(joined(blocks));
        ASSERT_EQ(seen.size(), stamps.size());
        for (std::size_t i = 0; i < seen.size(); ++i) {
            ASSERT_EQ(seen[i].stamp, stamps[i]) << int{digits};
        }
    }
}

/// With the top bit 2^-n seconds.
TEST_P(PcapngFile, ReadsStampsInBinaryResolutions) {
    for (const unsigned bits : {0U, 1U, 8U, 10U, 20U, 30U, 32U}) {
        const auto resolution = option(kResolution, {static_cast<std::byte>(0x80U | bits)});
        const std::uint64_t half = bits == 0 ? 0 : std::uint64_t{1} << (bits - 1);
        EXPECT_EQ(stampRead((std::uint64_t{1'000'000'000} << bits) + half, resolution),
                  Stamp(1'000'000'000s + (bits == 0 ? 0ms : 500ms)))
            << bits;
    }
}

/// if_tsoffset: seconds to be added, with a sign.
TEST_P(PcapngFile, AddsTheOffsetOfTheInterface) {
    for (const std::int64_t seconds :
         {std::int64_t{0}, std::int64_t{1'700'000'000}, std::int64_t{-3600}, std::int64_t{-1'700'000'000}}) {
        const auto offset = option(kOffset, number(static_cast<std::uint64_t>(seconds), 8));
        EXPECT_EQ(stampRead(5'000'007, offset), Stamp(std::chrono::seconds(5 + seconds) + 7us));
        EXPECT_EQ(stampRead(5'000'000'009, joined({offset, option(kResolution, {std::byte{9}})})),
                  Stamp(std::chrono::seconds(5 + seconds) + 9ns));
    }
}

/// Only those that can be subtracted from each other, and from now.
TEST_P(PcapngFile, TakesStampsOfCenturiesAndNoneThatNoDurationReaches) {
    const auto at = [&](std::int64_t seconds) {
        return stampRead(0, option(kOffset, number(static_cast<std::uint64_t>(seconds), 8)));
    };
    for (const std::int64_t seconds : std::initializer_list<std::int64_t>{-7'258'118'400, -2'208'988'800, -1,
                                                                          4'294'967'296, 9'151'488'000}) {
        EXPECT_EQ(at(seconds), Stamp(std::chrono::seconds(seconds))) << seconds;
    }
    for (const std::int64_t seconds : {-7'258'118'401, 9'151'488'001, 32'503'680'000}) {
        EXPECT_EQ(at(seconds), stampOf(-1)) << seconds << ": it has none";
    }
    const auto early = option(kOffset, number(static_cast<std::uint64_t>(-5'000'000'000), 8));
    const auto seen =
        recordedIn(joined({section(), interface(early), interface(), packet(0, {}, 0), packet(0, {}, 1)}));
    ASSERT_EQ(seen.size(), 2U);
    EXPECT_EQ(seen[0].stamp, Stamp(std::chrono::seconds(-5'000'000'000)));
    EXPECT_EQ(seen[1].stamp, stampOf(-1)) << "158 years later";
}

/// No stamp and no offset of a damaged file ends the program; the packet is there.
TEST_P(PcapngFile, SurvivesStampsThatNoClockShows) {
    for (const std::uint64_t offset : {0x7fffffffffffffffU, 0x8000000000000000U, 0xffffffffffffffffU}) {
        for (const std::uint64_t stamp : {std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1} << 63}) {
            for (const unsigned resolution : {0x00U, 0x06U, 0x09U, 0x13U, 0x7fU, 0x80U, 0xc0U, 0xffU}) {
                const auto options = joined({option(kOffset, number(offset, 8)),
                                             option(kResolution, {static_cast<std::byte>(resolution)})});
                EXPECT_EQ(recordedIn(joined({section(), interface(options), packet(stamp)})).size(), 1U);
            }
        }
    }
}

TEST_P(PcapngFile, PassesOverOptionsItDoesNotKnow) {
    const auto nanoseconds = option(kResolution, {std::byte{9}});
    const auto name = option(2, textBytes("eth0"));
    const auto filter = option(11, textBytes("\0udp"));
    const auto end = option(kEnd, {});
    EXPECT_EQ(stampRead(7, joined({name, filter, nanoseconds, end})), Stamp(7ns));
    EXPECT_EQ(stampRead(7, joined({nanoseconds, name})), Stamp(7ns)) << "the end may be left out";
    EXPECT_EQ(stampRead(7, joined({end, nanoseconds})), Stamp(7us)) << "what is behind the end is none";
    EXPECT_EQ(stampRead(7, joined({option(kResolution, {}), end})), Stamp(7us)) << "no value";
    EXPECT_EQ(stampRead(7, joined({option(kOffset, number(1, 4)), end})), Stamp(7us)) << "too short";
}

TEST_P(PcapngFile, StopsAtAnOptionThatRunsPastTheBlock) {
    const auto nanoseconds = option(kResolution, {std::byte{9}});
    ByteVector tooLong = option(2, textBytes("eth0"));
    tooLong[bigEndian() ? 3 : 2] = std::byte{200};
    EXPECT_EQ(stampRead(7, joined({nanoseconds, tooLong})), Stamp(7ns));
    EXPECT_EQ(stampRead(7, joined({tooLong, nanoseconds})), Stamp(7us));
}

TEST_P(PcapngFile, ReadsTheCommentsOfAPacket) {
    const auto comments =
        joined({option(kComment, textBytes("one")), option(kComment, textBytes("")), option(2, number(0, 4)),
                option(kComment, textBytes("\u00e9t\u00e9")), option(kEnd, {})});
    const auto seen = recordedIn(joined({section(), interface(), packet(1, comments), packet(2)}));
    ASSERT_EQ(seen.size(), 2U);
    EXPECT_EQ(seen[0].comments, (std::vector<std::string>{"one", "", "\u00e9t\u00e9"}));
    EXPECT_TRUE(seen[1].comments.empty()) << "those of one packet are not the next one's";
}

/// epb_dropcount: packets lost between the packet before and this one.
TEST_P(PcapngFile, AddsUpTheDropsUpToTheNextDatagram) {
    const auto drops = [&](std::uint64_t count) { return option(kDropCount, number(count, 8)); };
    const ByteVector other =
        enhancedPacket(0, 1, ipv4(udp(textBytes("who is there?"), 5353, 5353)), bigEndian(), drops(5));
    const auto seen = recordedIn(joined({section(), interface(), packet(1, drops(3)), packet(2), other, other,
                                         packet(3, drops(1)), packet(4, drops(0x1'0000'0000)), packet(5)}));
    ASSERT_EQ(seen.size(), 5U);
    EXPECT_EQ(seen[0].kernelDropsBefore, 3U);
    EXPECT_EQ(seen[1].kernelDropsBefore, 0U);
    EXPECT_EQ(seen[2].kernelDropsBefore, 11U);
    EXPECT_EQ(seen[3].kernelDropsBefore, 0xffffffffU) << "the most that a packet can tell";
    EXPECT_EQ(seen[4].kernelDropsBefore, 0U);
}

TEST_P(PcapngFile, CountsInterfacesWithinTheirSection) {
    const auto nanoseconds = option(kResolution, {std::byte{9}});
    const auto seen =
        recordedIn(joined({section(), interface(nanoseconds), interface(), packet(9, {}, 1), packet(9, {}, 0),
                           packet(9, {}, 2), // there is no such interface
                           section(), packet(9, {}, 0), interface(), packet(9, {}, 0), packet(9, {}, 1)}));
    ASSERT_EQ(seen.size(), 3U);
    EXPECT_EQ(seen[0].stamp, Stamp(9us));
    EXPECT_EQ(seen[1].stamp, Stamp(9ns));
    EXPECT_EQ(seen[2].stamp, Stamp(9us));
}

TEST_P(PcapngFile, KeepsTheNumberOfAnInterfaceThatIsTooShort) {
    const ByteVector tooShort = block(1, number(kRawIpInterface, 2), bigEndian());
    const auto seen = recordedIn(joined({section(), tooShort, interface(), packet(9, {}, 1)}));
    EXPECT_EQ(seen.size(), 1U);
}

TEST_P(PcapngFile, PassesOverBlocksItDoesNotKnow) {
    std::vector<ByteVector> blocks{section()};
    for (const std::uint32_t type : {2U, 4U, 5U, 10U, 0x0badU, 0x40000badU, 0x80000000U, 0xffffffffU}) {
        blocks.push_back(block(type, {}, bigEndian()));
        blocks.push_back(block(type, textBytes("Posewire: TCP, any bytes at all"), bigEndian()));
    }
    blocks.push_back(interface());
    blocks.insert(blocks.end(), blocks.begin() + 1, blocks.end() - 1);
    blocks.push_back(packet(1));
    EXPECT_EQ(recordedIn(joined(blocks)).size(), 1U);
}

/// A simple packet has no length of its own: it ends with the packet, the snap length or the block.
TEST_P(PcapngFile, EndsASimplePacketWhereItWasCaptured) {
    const ByteVector whole = ipv4(udp(poseDatagram(1, 1)));
    for (const std::uint32_t snapLength : {0U, 50U, 51U, 52U, 53U, 65'535U}) {
        const std::size_t captured =
            snapLength == 0 ? whole.size() : std::min<std::size_t>(snapLength, whole.size());
        const ByteVector cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(captured));
        const auto seen = recordedIn(joined({section(), interface({}, snapLength), interface({}, 1),
                                             simplePacket(whole.size(), cut, bigEndian())}));
        ASSERT_EQ(seen.size(), 1U) << snapLength;
        EXPECT_EQ(seen[0].bytes.size(), captured - 28) << snapLength;
        EXPECT_EQ(seen[0].stamp, stampOf(-1)) << "it has none";
    }
}

TEST_P(PcapngFile, PassesOverASimplePacketWithoutAnInterface) {
    const ByteVector whole = ipv4(udp(poseDatagram(1, 1)));
    EXPECT_TRUE(recordedIn(joined({section(), simplePacket(whole.size(), whole, bigEndian())})).empty());
}

/// What is longer than its block says ends with the block.
TEST_P(PcapngFile, EndsAnEnhancedPacketWithItsBlock) {
    ByteVector damaged = packet(1);
    const ByteVector huge = number(0x7fffffff, 4);
    std::copy(huge.begin(), huge.end(), damaged.begin() + 8 + 12);
    const auto seen = recordedIn(joined({section(), interface(), damaged, packet(2)}));
    ASSERT_EQ(seen.size(), 2U);
    EXPECT_EQ(seen[0].bytes, poseDatagram(1, 1));
    EXPECT_EQ(seen[1].bytes, poseDatagram(1, 1));
}

TEST_P(PcapngFile, NamesABlockOfImpossibleLength) {
    const ByteVector start = joined({section(), interface()});
    for (const std::uint32_t length : {0U, 8U, 11U, 13U, 14U, 15U, 0x01000004U, 0xfffffffcU}) {
        const ByteVector bad = joined({number(6, 4), number(length, 4), ByteVector(64)});
        const ByteVector file = joined({start, packet(1), bad});
        BytesSource source(file);
        int count = 0;
        const auto result = readFile(source, [&](const FileRecord&) { ++count; });
        ASSERT_FALSE(result) << length;
        EXPECT_THAT(result.error().text, testing::HasSubstr("a block of impossible length"));
        EXPECT_EQ(count, 1) << "what comes before it was read";
    }
}

TEST_P(PcapngFile, NamesASectionWithoutAByteOrder) {
    ByteVector bad = section();
    bad[8] = std::byte{0};
    const ByteVector file = joined({section(), interface(), packet(1), bad});
    BytesSource source(file);
    const auto result = readFile(source, [](const FileRecord&) {});
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().text, testing::HasSubstr("no byte order"));
}

TEST_P(PcapngFile, KeepsWhatCameBeforeAFailureOfTheDevice) {
    const ByteVector start = joined({section(), interface()});
    const ByteVector one = packet(1);
    const ByteVector file = joined({start, one, one});
    for (std::size_t size = 0; size <= file.size(); ++size) {
        BytesSource source(std::span<const std::byte>(file).first(size), true);
        std::size_t count = 0;
        const auto result = readFile(source, [&](const FileRecord&) { ++count; });
        ASSERT_FALSE(result) << size;
        EXPECT_EQ(result.error().text, "memory: the device is gone");
        EXPECT_EQ(count, size < start.size() ? 0 : (size - start.size()) / one.size()) << size;
    }
}

} // namespace
} // namespace posewire::log
