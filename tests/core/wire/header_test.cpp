// SPDX-License-Identifier: MIT
#include "core/wire/codec.h"
#include "core/wire/type_table.h"
#include "tests/support/golden.h"

#include <gtest/gtest.h>

namespace posewire::wire {
namespace {

Bytes asBytes(std::string_view text) {
    return std::as_bytes(std::span(text));
}

TEST(Header, ReadsEveryFieldFromItsPlace) {
    constexpr std::array<unsigned char, 24> sent{'M',  'X',  'T',  'P', '2',  '3',  0x01, 0x02,
                                                 0x03, 0x04, 0x85, 7,   0x05, 0x06, 0x07, 0x08,
                                                 9,    10,   11,   12,  0x0d, 0x0e, 0x0f, 0x10};
    const auto header = decodeHeader(std::as_bytes(std::span(sent)));
    ASSERT_TRUE(header);
    EXPECT_EQ(header->type(), 23);
    EXPECT_EQ(header->sampleCounter, 0x01020304U);
    EXPECT_EQ(header->datagramIndex(), 5);
    EXPECT_TRUE(header->isLast());
    EXPECT_EQ(header->items, 7);
    EXPECT_EQ(header->timeCode, 0x05060708U);
    EXPECT_EQ(header->character, 9);
    EXPECT_EQ(header->bodySegments, 10);
    EXPECT_EQ(header->props, 11);
    EXPECT_EQ(header->fingerSegments, 12);
    EXPECT_EQ(header->countedSegments(), 33U);
    EXPECT_EQ(header->reserved, 0x0d0e);
    EXPECT_EQ(header->payloadSize, 0x0f10);
}

TEST(Header, RejectsFewerThan24Bytes) {
    const auto header = decodeHeader(asBytes("MXTP02"));
    ASSERT_FALSE(header);
    EXPECT_EQ(header.error(), (WireError{ErrorCode::HeaderTruncated, 0, 6, 24, 6}));
}

TEST(Header, RejectsWhatIsNotMxtpAtItsFirstByte) {
    const auto header = decodeHeader(asBytes("{\"type\":\"transport\",\"value\":\"record\"}"));
    ASSERT_FALSE(header);
    EXPECT_EQ(header.error().code, ErrorCode::BadMagic);
    EXPECT_EQ(header.error().offset, 0U);
}

TEST(Header, RejectsATypeThatIsNotTwoDigits) {
    for (const std::string_view text : {"MXTP0x..................", "MXTP:0..................", "MXTP//"}) {
        const auto header = decodeHeader(asBytes(text));
        ASSERT_FALSE(header) << text;
        EXPECT_EQ(header.error().code, ErrorCode::BadType) << text;
        EXPECT_EQ(header.error().offset, 4U) << text;
    }
}

TEST(Header, NamesATypeThatIsSentAsANumber) {
    std::vector<std::byte> bytes = posewire::test::golden("02_quaternion_counted").bytes;
    bytes[4] = std::byte{0};
    bytes[5] = std::byte{3};
    EXPECT_TRUE(startsDatagram(bytes));
    const auto header = decodeHeader(bytes);
    ASSERT_FALSE(header);
    EXPECT_EQ(header.error(), (WireError{ErrorCode::TypeAsNumber, 0, 4, 0, 3}));
    EXPECT_EQ(errorText(header.error()), "type sent as a number: 0x00 0x03 for \"03\" (byte 4)");
}

TEST(Header, GivesANoticeWhereReservedBytesAreInUse) {
    auto bytes = posewire::test::golden("02_quaternion_counted").bytes;
    bytes[20] = std::byte{1};
    const auto datagram = decode(bytes);
    ASSERT_TRUE(datagram);
    EXPECT_EQ(datagram->notices, (std::vector{Notice{NoticeCode::ReservedUsed, 20, 1}}));
    EXPECT_EQ(*encode(*datagram), bytes);
}

TEST(Header, GivesANoticeWhereCountsAndItemsDisagree) {
    auto bytes = posewire::test::golden("02_quaternion_counted").bytes;
    bytes[18] = std::byte{2};
    const auto datagram = decode(bytes);
    ASSERT_TRUE(datagram);
    EXPECT_EQ(datagram->notices, (std::vector{Notice{NoticeCode::CountDisagrees, 11, 1}}));
}

TEST(Header, MakesNothingOfCountsInTypesThatCarryNoSegments) {
    for (const char* name : {"20_joints_counted", "23_trackers_68_counted", "12_metadata_counted"}) {
        const auto datagram = decode(posewire::test::golden(name).bytes);
        ASSERT_TRUE(datagram) << name;
        EXPECT_TRUE(datagram->notices.empty()) << name;
    }
}

/// Counters wrap around: the largest values are values like others.
TEST(Header, KeepsCountersUpToTheirLargestValue) {
    for (const std::uint32_t counter : {0U, 1U, 0x7fffffffU, 0x80000000U, 0xfffffffeU, 0xffffffffU}) {
        Datagram datagram;
        datagram.header.sampleCounter = counter;
        datagram.header.timeCode = ~counter;
        datagram.body = TimeCode{};
        completeHeader(datagram, HeaderEra::Counted);
        const auto read = decode(encode(datagram).value());
        ASSERT_TRUE(read);
        EXPECT_EQ(read->header.sampleCounter, counter);
        EXPECT_EQ(read->header.timeCode, ~counter);
    }
}

TEST(Header, DividesTheDatagramCounterIntoIndexAndMark) {
    Header header;
    for (unsigned counter = 0; counter < 256; ++counter) {
        header.datagramCounter = static_cast<std::uint8_t>(counter);
        EXPECT_EQ(header.datagramIndex(), counter % 128);
        EXPECT_EQ(header.isLast(), counter >= 128);
    }
}

TEST(Header, AddsUpCountsThatAByteCannotHold) {
    Header header;
    header.bodySegments = header.props = header.fingerSegments = 255;
    EXPECT_EQ(header.countedSegments(), 765U);
}

TEST(Header, LosesWhatItsEraDoesNotHave) {
    Datagram datagram;
    datagram.header.bodySegments = 23;
    datagram.header.props = 2;
    datagram.header.fingerSegments = 40;
    datagram.body = PoseEuler{std::vector<SegmentEuler>(65)};
    completeHeader(datagram, HeaderEra::Counted);
    EXPECT_EQ(datagram.header.payloadSize, 65 * 28);
    EXPECT_EQ(datagram.header.countedSegments(), 65U);
    completeHeader(datagram, HeaderEra::Reserved);
    EXPECT_EQ(datagram.header.payloadSize, 0);
    EXPECT_EQ(datagram.header.countedSegments(), 0U);
    EXPECT_EQ(datagram.header.items, 65);
    EXPECT_EQ(datagram.header.type(), 1);
}

/// A datagram of another program on the same port is told by its first bytes (JSON, FlatBuffers).
TEST(Header, TellsForeignBytesFromTheStartOfADatagram) {
    EXPECT_TRUE(startsWithMagic(asBytes("MXTP")));
    EXPECT_TRUE(startsWithMagic(asBytes("MXTP02")));
    EXPECT_FALSE(startsWithMagic(asBytes("MXT")));
    EXPECT_FALSE(startsWithMagic(asBytes("mxtp02")));
    EXPECT_FALSE(startsWithMagic({}));
    EXPECT_TRUE(startsDatagram(asBytes("MXTP00")));
    EXPECT_TRUE(startsDatagram(asBytes("MXTP99 and more")));
    for (const std::string_view text :
         {"", "MXTP", "MXTP0", "MXTP0/", "MXTP0:", "MXTP/0", "MXTPAB", "xMXTP02"}) {
        EXPECT_FALSE(startsDatagram(asBytes(text))) << text;
    }
}

TEST(Header, NamesTheFirstFaultOfCutOrForeignBytes) {
    const std::string_view whole = "MXTP0x";
    const auto codeOf = [](std::string_view text) { return decodeHeader(asBytes(text)).error().code; };
    for (std::size_t size = 0; size < 6; ++size) {
        EXPECT_EQ(codeOf(whole.substr(0, size)), ErrorCode::HeaderTruncated) << size;
    }
    EXPECT_EQ(codeOf(whole), ErrorCode::BadType);
    EXPECT_EQ(codeOf("N"), ErrorCode::BadMagic);
    EXPECT_EQ(codeOf("MXTQ"), ErrorCode::BadMagic);
    EXPECT_EQ(decodeHeader(asBytes("MX?")).error(), (WireError{ErrorCode::BadMagic, 0, 0, 4, 3}));
}

TEST(TypeTable, NamesTheFifteenTypes) {
    constexpr std::array types{1, 2, 3, 4, 5, 10, 11, 12, 13, 20, 21, 22, 23, 24, 25};
    ASSERT_EQ(typeTable().size(), types.size());
    for (std::size_t i = 0; i < types.size(); ++i) {
        EXPECT_EQ(typeTable()[i].type, types[i]);
        EXPECT_FALSE(typeTable()[i].name.empty());
    }
    EXPECT_EQ(findType(77), nullptr);
    EXPECT_EQ(typeTitle(2), "02 Pose, quaternion");
    EXPECT_EQ(typeTitle(77), "77 unknown type");
    EXPECT_FALSE(isSampled(12));
    EXPECT_TRUE(isSampled(2));
}

} // namespace
} // namespace posewire::wire
