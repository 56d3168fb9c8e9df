// SPDX-License-Identifier: MIT
#include "core/wire/byte_order.h"
#include "core/wire/codec.h"
#include "core/wire/field_tree.h"
#include "tests/support/golden.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace posewire::wire {
namespace {

std::vector<std::byte> withWord(const std::string& name, std::size_t place, std::uint32_t word) {
    std::vector<std::byte> bytes = posewire::test::golden(name).bytes;
    store32(bytes.data() + place, word);
    return bytes;
}

WireError errorOf(const std::vector<std::byte>& bytes) {
    const auto datagram = decode(bytes);
    EXPECT_FALSE(datagram);
    return datagram ? WireError{} : datagram.error();
}

TEST(HostileInput, HugeCountsAllocateNothing) {
    for (const std::uint32_t count : {0xffffffffU, 0x7fffffffU, 0x10000U, 256U}) {
        Datagram datagram;
        ASSERT_FALSE(decodeInto(withWord("13_null_pose_reserved", 24, count), datagram));
        EXPECT_EQ(std::get<NullPose>(datagram.body).segments.capacity(), 0U);
        ASSERT_FALSE(decodeInto(withWord("13_null_pose_last", 28, count), datagram));
        EXPECT_EQ(std::get<NullPose>(datagram.body).points.capacity(), 0U);
    }
}

TEST(HostileInput, CountsBeyondTheRestOfTheDatagramNameWhatFits) {
    EXPECT_EQ(errorOf(withWord("13_null_pose_last", 24, 0xffffffffU)),
              (WireError{ErrorCode::CountTooLarge, 13, 24, 0xffffffffU, 0}));
    EXPECT_EQ(errorOf(withWord("13_null_pose_points", 28, 3)),
              (WireError{ErrorCode::CountTooLarge, 13, 28, 3, 2}));
}

TEST(HostileInput, ItemsThatAreNotThereAllocateNothing) {
    std::vector<std::byte> bytes = posewire::test::golden("02_quaternion_reserved").bytes;
    bytes[11] = std::byte{255};
    Datagram datagram;
    const auto result = decodeInto(bytes, datagram);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error(), (WireError{ErrorCode::ItemsTruncated, 2, 24 + 96, 252 * 32, 0}));
    EXPECT_EQ(std::get<PoseQuaternion>(datagram.body).segments.capacity(), 3U);
}

TEST(HostileInput, NamesThePlaceOfABadLength) {
    for (const std::uint32_t length : {0xffffffffU, 0x80000000U, 0x00ffffffU, 47U}) {
        const WireError error = errorOf(withWord("12_metadata_counted", 24, length));
        EXPECT_EQ(error.code, ErrorCode::BadLength);
        EXPECT_EQ(error.offset, 24U);
        EXPECT_EQ(error.have, 46U);
    }
    EXPECT_EQ(errorOf(withWord("13_null_pose_reserved", 28, 0x01000000U)).offset, 28U);
}

TEST(HostileInput, NamesThePlaceOfABadSequence) {
    std::vector<std::byte> bytes = posewire::test::golden("12_metadata_counted").bytes;
    bytes[28 + 5] = std::byte{0xc0};
    EXPECT_EQ(errorOf(bytes), (WireError{ErrorCode::BadSequence, 12, 28 + 5, 0, 0}));
}

TEST(HostileInput, WantsAnEndForZeroTerminatedNames) {
    std::vector<std::byte> bytes = posewire::test::golden("11_props_reserved").bytes;
    bytes.back() = std::byte{'x'};
    const WireError error = errorOf(bytes);
    EXPECT_EQ(error.code, ErrorCode::UnterminatedText);
    EXPECT_EQ(error.offset, 24U + 10 + 4);
}

TEST(HostileInput, GivesNoticesForOddValues) {
    EXPECT_EQ(decode(withWord("02_quaternion_counted", 24 + 32 + 4, 0x7fc00000U))->notices,
              (std::vector{Notice{NoticeCode::NotFinite, 24 + 32, 1}}));
    EXPECT_EQ(decode(withWord("02_quaternion_counted", 24 + 32 + 4, 0xff800000U))->notices,
              (std::vector{Notice{NoticeCode::NotFinite, 24 + 32, 1}}));
    EXPECT_EQ(decode(withWord("02_quaternion_counted", 24 + 16, 0x40000000U))->notices,
              (std::vector{Notice{NoticeCode::NotUnitQuaternion, 24, 1}}));
    EXPECT_EQ(decode(withWord("02_quaternion_counted", 24, 0))->notices,
              (std::vector{Notice{NoticeCode::SegmentOutOfRange, 24, 1}}));
    EXPECT_EQ(decode(withWord("02_quaternion_counted", 24, 68))->notices,
              (std::vector{Notice{NoticeCode::SegmentOutOfRange, 24, 1}}));
    EXPECT_EQ(decode(withWord("24_centre_36_counted", 28, 0x7f800001U))->notices,
              (std::vector{Notice{NoticeCode::NotFinite, 24, 1}}));
    EXPECT_EQ(decode(withWord("25_time_code_counted", 28, 0x61616161U))->notices,
              (std::vector{Notice{NoticeCode::NotATimeCode, 28, 1}}));
    for (const std::uint32_t digits : {0x32343a30U, 0x30303a36U, 0x39393a39U}) { // 24:0, 00:6, 99:9
        EXPECT_EQ(decode(withWord("25_time_code_counted", 28, digits))->notices,
                  (std::vector{Notice{NoticeCode::NotATimeCode, 28, 1}}));
    }
}

TEST(HostileInput, NoticesAColourThatIsNotSixHexadecimalDigits) {
    for (const std::string colour : {"#zz", "12345", "1234567", ""}) {
        Datagram datagram;
        datagram.body = MetaData{true, "name:A\ncolor:" + colour + "\n"};
        completeHeader(datagram, HeaderEra::Counted);
        EXPECT_EQ(decode(encode(datagram).value())->notices,
                  (std::vector{Notice{NoticeCode::BadColour, 24 + 4 + 13, 1}}));
    }
}

TEST(HostileInput, ReadsMoreThanTheSpecificationAllowsWithANotice) {
    const auto noticesOf = [](Body body, std::uint8_t props, HeaderEra era) {
        Datagram datagram;
        datagram.header.bodySegments = 23;
        datagram.header.props = props;
        datagram.body = std::move(body);
        completeHeader(datagram, era);
        return decode(encode(datagram).value())->notices;
    };
    const auto items = [](auto message, std::uint32_t count) {
        for (std::uint32_t id = 1; id <= count; ++id) {
            message.segments.push_back({id, {}, {1, 0, 0, 0}});
        }
        return message;
    };
    EXPECT_THAT(noticesOf(items(PoseQuaternion(), 27), 4, HeaderEra::Counted), testing::IsEmpty());
    EXPECT_THAT(noticesOf(items(PoseQuaternion(), 28), 5, HeaderEra::Counted),
                testing::ElementsAre(Notice{NoticeCode::TooManyProps, 18, 5}));
    EXPECT_THAT(noticesOf(items(PoseQuaternion(), 28), 0, HeaderEra::Reserved),
                testing::ElementsAre(Notice{NoticeCode::TooManyProps, 11, 5}));
    EXPECT_THAT(noticesOf(items(PoseQuaternion(), 63), 0, HeaderEra::Reserved), testing::IsEmpty());
    EXPECT_THAT(noticesOf(items(PoseUnity(), 24), 0, HeaderEra::Reserved),
                testing::ElementsAre(Notice{NoticeCode::TooManyItems, 11, 24}));
    PointPositions points;
    for (std::uint32_t id = 257; id < 257 + 64; ++id) {
        points.points.push_back({256 * (1 + id % 23) + 1, {}});
    }
    points.points.push_back({12345678, {}}); // a tag
    EXPECT_THAT(noticesOf(points, 0, HeaderEra::Reserved), testing::IsEmpty());
    points.points.push_back({257, {}});
    EXPECT_THAT(noticesOf(points, 0, HeaderEra::Reserved),
                testing::ElementsAre(Notice{NoticeCode::TooManyPoints, 11, 65}));
}

TEST(HostileInput, ReadsABareTextThatBeginsWithAnyCharacter) {
    for (const std::string text : {"\u00e9t\u00e9:1\n", "\U0001f600:2\n", "name:A\n"}) {
        Datagram datagram;
        datagram.body = MetaData{false, text};
        completeHeader(datagram, HeaderEra::Reserved);
        const auto decoded = decode(encode(datagram).value());
        ASSERT_TRUE(decoded) << text;
        EXPECT_TRUE(decoded->body == datagram.body) << text;
    }
}

TEST(HostileInput, NoticesATimeOfDayThatNoClockShows) {
    const auto noticesOf = [](std::string_view text) {
        Datagram datagram;
        TimeCode message;
        std::copy(text.begin(), text.end(), message.text.begin());
        datagram.body = message;
        completeHeader(datagram, HeaderEra::Counted);
        return decode(encode(datagram).value())->notices;
    };
    for (const char* text : {"99:99:99.999", "24:00:00.000", "12:60:00.000", "12:00:61.000"}) {
        EXPECT_EQ(noticesOf(text), (std::vector{Notice{NoticeCode::NotATimeCode, 28, 1}})) << text;
    }
    for (const char* text : {"00:00:00.000", "23:59:59.999", "23:59:60.000"}) {
        EXPECT_TRUE(noticesOf(text).empty()) << text;
    }
}

TEST(HostileInput, RefusesToWriteWhatDoesNotFit) {
    Datagram datagram;
    datagram.body = PoseQuaternion{std::vector<SegmentQuaternion>(256)};
    EXPECT_EQ(encode(datagram).error(), (WireError{ErrorCode::CountTooLarge, 0, 0, 256, 255}));
    datagram.body = NullPose{std::vector<NullPoseSegment>(kMaxNullPoseSegments + 1), {}};
    EXPECT_EQ(encode(datagram).error(),
              (WireError{ErrorCode::CountTooLarge, 0, 0, kMaxNullPoseSegments + 1, kMaxNullPoseSegments}));
    datagram.body = PropInformation{{{24, std::string("a\0b", 3)}}};
    EXPECT_EQ(errorText(encode(datagram).error()), "a string that ends at a zero has a zero inside");
    datagram.body = RawBody{std::vector<std::byte>(kMaxDatagramSize)};
    EXPECT_EQ(encode(datagram).error(),
              (WireError{ErrorCode::TooLong, 0, 0, kMaxDatagramSize + kHeaderSize, kMaxDatagramSize}));
}

TEST(HostileInput, SurvivesRandomBytesBehindAnyHeader) {
    std::mt19937 random(20261121);
    for (int round = 0; round < 20000; ++round) {
        std::vector<std::byte> bytes(24 + random() % 200);
        for (std::byte& byte : bytes) {
            byte = static_cast<std::byte>(random() % 4 == 0 ? random() : random() % 3);
        }
        const auto& header = posewire::test::goldens()[random() % posewire::test::goldens().size()].bytes;
        std::copy_n(header.begin(), random() % 2 == 0 ? 24 : 17, bytes.begin());
        const auto datagram = decode(bytes);
        const FieldTree tree = fieldTree(bytes);
        EXPECT_EQ(datagram.has_value(), !tree.fault.has_value());
        EXPECT_TRUE(datagram || datagram.error().offset <= bytes.size());
    }
}

} // namespace
} // namespace posewire::wire
