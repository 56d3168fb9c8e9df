// SPDX-License-Identifier: MIT
#include "core/wire/byte_order.h"
#include "tests/core/wire/generated_datagrams.h"

#include <gtest/gtest.h>

#include <cmath>

namespace posewire::wire {
namespace {

using test::generatedDatagram;

/// Bytes of an item by the specification and, for types 05 and 23, real senders; 0 where it varies.
std::size_t itemSize(std::uint8_t type, Form form) {
    switch (type) {
    case 1:
        return 28;
    case 2:
    case 5:
        return 32;
    case 3:
    case 4:
        return 16;
    case 10:
        return 52;
    case 20:
        return 20;
    case 21:
        return 40;
    case 22:
        return 44;
    case 23:
        return form == Form::Short ? 44 : 68;
    default:
        return 0;
    }
}

class RoundTripLimits : public testing::TestWithParam<std::uint8_t> {
protected:
    [[nodiscard]] std::uint8_t type() const { return GetParam(); }
    [[nodiscard]] std::vector<Form> forms() const {
        const Form other = test::otherForm(type());
        return other == Form::Standard ? std::vector{Form::Standard} : std::vector{Form::Standard, other};
    }
    std::mt19937 m_random{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(AllTypes, RoundTripLimits, testing::ValuesIn(test::kAllTypes));

TEST_P(RoundTripLimits, HoldForEveryNumberOfItems) {
    for (const Form form : forms()) {
        for (std::size_t items = 0; items <= kMaxItems; ++items) {
            const HeaderEra era = items % 2 == 0 ? HeaderEra::Counted : HeaderEra::Reserved;
            const Datagram sent = generatedDatagram({m_random, true, items}, type(), form, era);
            const auto bytes = encode(sent);
            ASSERT_TRUE(bytes) << errorText(bytes.error());
            if (itemSize(type(), form) != 0) {
                ASSERT_EQ(bytes->size(), kHeaderSize + items * itemSize(type(), form));
                ASSERT_EQ(std::to_integer<std::size_t>((*bytes)[11]), items);
            }
            const auto read = decode(*bytes);
            ASSERT_TRUE(read) << items << ": " << errorText(read.error());
            ASSERT_EQ(encode(*read), bytes) << items;
            // The two forms of an empty list of trackers look the same.
            ASSERT_TRUE(read->body == sent.body || (type() == 23 && items == 0)) << items;
        }
    }
}

TEST_P(RoundTripLimits, HoldIntoAValueThatHadMoreItems) {
    Datagram reused;
    for (const std::size_t items : {67U, 0U, 255U, 1U, 23U}) {
        const Datagram sent =
            generatedDatagram({m_random, true, items}, type(), Form::Standard, HeaderEra::Counted);
        ASSERT_TRUE(decodeInto(encode(sent).value(), reused));
        EXPECT_TRUE(reused.body == sent.body) << items;
        EXPECT_EQ(reused.header, sent.header) << items;
    }
}

TEST_P(RoundTripLimits, EndAt255Items) {
    const Datagram most =
        generatedDatagram({m_random, true, kMaxItems + 1}, type(), Form::Standard, HeaderEra::Counted);
    const bool hasItems = itemSize(type(), Form::Standard) != 0 || type() == 11 || type() == 13;
    const auto bytes = encode(most);
    EXPECT_EQ(bytes.has_value(), !hasItems);
    if (!bytes) {
        EXPECT_EQ(bytes.error().code, ErrorCode::CountTooLarge);
        EXPECT_EQ(bytes.error().type, type());
    }
}

/// Every payload size that is announced is held to, one byte less is too few.
TEST_P(RoundTripLimits, AnnounceTheSizeToTheByte) {
    for (const Form form : forms()) {
        const Datagram sent = generatedDatagram({m_random, true, 5}, type(), form, HeaderEra::Counted);
        auto bytes = encode(sent).value();
        ASSERT_EQ(load16(bytes.data() + 22), bytes.size() - kHeaderSize);
        bytes.pop_back();
        const auto cut = decode(bytes);
        ASSERT_FALSE(cut);
        EXPECT_EQ(cut.error().code, ErrorCode::PayloadTruncated);
        EXPECT_EQ(cut.error().need, bytes.size() + 1);
        EXPECT_EQ(cut.error().have, bytes.size());
    }
}

TEST(RoundTripOfFloats, KeepsTheBitsOfEveryKindOfNumber) {
    constexpr std::array<std::uint32_t, 12> kinds{
        0x00000000, 0x80000000, // zeros
        0x00000001, 0x807fffff, // denormals
        0x00800000, 0x7f7fffff, // the smallest and the largest normal number
        0x7f800000, 0xff800000, // infinities
        0x7fc00000, 0xffc12345, // quiet NaN with and without payload
        0x7f800001, 0xffbfffff, // signalling NaN
    };
    for (const std::uint32_t bits : kinds) {
        Datagram sent;
        const float value = std::bit_cast<float>(bits);
        sent.body = PointPositions{{{257, {value, 1.0F, value}}}};
        completeHeader(sent, HeaderEra::Counted);
        const auto bytes = encode(sent).value();
        EXPECT_EQ(load32(bytes.data() + 28), bits);
        EXPECT_EQ(load32(bytes.data() + 36), bits);
        const auto read = decode(bytes);
        ASSERT_TRUE(read);
        const Vec3& position = std::get<PointPositions>(read->body).points[0].position;
        EXPECT_EQ(std::bit_cast<std::uint32_t>(position[0]), bits);
        const bool isOdd = !std::isfinite(value);
        EXPECT_EQ(read->notices,
                  isOdd ? (std::vector{Notice{NoticeCode::NotFinite, 24, 2}}) : std::vector<Notice>{});
    }
}

std::string textOf(std::size_t length) {
    std::string text = "name:";
    while (text.size() < length) {
        text += static_cast<char>('a' + text.size() % 26);
    }
    return text.substr(0, length);
}

TEST(RoundTripOfTexts, HoldsForEveryLengthThatADatagramCanHold) {
    std::vector<std::size_t> lengths{255, 256, 257, 65'000, kMaxDatagramSize - kHeaderSize - 4};
    for (std::size_t length = 0; length < 70; ++length) {
        lengths.push_back(length);
    }
    for (const std::size_t length : lengths) {
        for (const HeaderEra era : {HeaderEra::Counted, HeaderEra::Reserved}) {
            Datagram sent;
            sent.body = MetaData{true, textOf(length)};
            completeHeader(sent, era);
            const auto bytes = encode(sent).value();
            ASSERT_EQ(load32(bytes.data() + kHeaderSize), length);
            const auto read = decode(bytes);
            ASSERT_TRUE(read) << length << ": " << errorText(read.error());
            EXPECT_TRUE(read->body == sent.body) << length;
        }
    }
}

TEST(RoundTripOfTexts, EndsWhereTheDatagramIsFull) {
    Datagram datagram;
    datagram.body = MetaData{true, textOf(kMaxDatagramSize - kHeaderSize - 3)};
    EXPECT_EQ(encode(datagram).error(),
              (WireError{ErrorCode::TooLong, 0, 0, kMaxDatagramSize + 1, kMaxDatagramSize}));
    datagram.body = MetaData{false, textOf(kMaxDatagramSize - kHeaderSize)};
    EXPECT_TRUE(encode(datagram));
    datagram.body = MetaData{false, textOf(kMaxDatagramSize - kHeaderSize + 1)};
    EXPECT_FALSE(encode(datagram));
}

TEST(RoundTripOfTexts, HoldsForTheShortestAndLongestOfEachLengthOfUtf8) {
    for (const std::string& text : {std::string(1, '\0'), std::string("\x7f"), std::string("\u0080"),
                                    std::string("\u07ff"), std::string("\u0800"), std::string("\uffff"),
                                    std::string("\U00010000"), std::string("\U0010ffff")}) {
        Datagram sent;
        sent.body = NullPose{{{text, {1, 2, 3}}}, {{1, 2, text + text, 3, {4, 5, 6}}}};
        completeHeader(sent, HeaderEra::Counted);
        const auto read = decode(encode(sent).value());
        ASSERT_TRUE(read);
        EXPECT_TRUE(read->body == sent.body);
    }
}

TEST(RoundTripOfNullPoses, HoldsForTheLongestListsThatFit) {
    Datagram sent;
    NullPose pose;
    pose.segments.resize(kMaxNullPoseSegments);
    pose.points.resize((kMaxDatagramSize - kHeaderSize - 8 - 16 * kMaxNullPoseSegments) / 24);
    ASSERT_LT(pose.points.size(), kMaxNullPosePoints);
    sent.body = pose;
    completeHeader(sent, HeaderEra::Counted);
    const auto read = decode(encode(sent).value());
    ASSERT_TRUE(read) << errorText(read.error());
    EXPECT_TRUE(read->body == sent.body);
    EXPECT_EQ(sent.header.items, 0);
    pose.points.emplace_back();
    sent.body = pose;
    EXPECT_EQ(encode(sent).error().code, ErrorCode::TooLong);
}

TEST(RoundTripOfProps, HoldsForNamesThatAreEmptyOrLong) {
    Datagram sent;
    sent.body = PropInformation{{{24, ""}, {25, std::string(60'000, 'x')}, {26, "\u00e9"}, {30, ""}}};
    completeHeader(sent, HeaderEra::Reserved);
    const auto read = decode(encode(sent).value());
    ASSERT_TRUE(read);
    EXPECT_TRUE(read->body == sent.body);
    EXPECT_TRUE(read->notices.empty());
}

TEST(RoundTripOfUnknownTypes, KeepsEveryByte) {
    for (const std::size_t size : {0U, 1U, 3U, 255U, 65'483U}) {
        for (const std::uint8_t type : std::initializer_list<std::uint8_t>{0, 6, 9, 14, 19, 26, 99}) {
            Datagram sent;
            sent.header.setType(type);
            RawBody raw{std::vector<std::byte>(size)};
            for (std::size_t i = 0; i < size; ++i) {
                raw.bytes[i] = static_cast<std::byte>(i * 37 + type);
            }
            sent.body = raw;
            completeHeader(sent, HeaderEra::Counted);
            const auto read = decode(encode(sent).value());
            ASSERT_TRUE(read);
            EXPECT_TRUE(read->body == sent.body);
            EXPECT_EQ(read->header, sent.header);
            EXPECT_EQ(read->notices, (std::vector{Notice{NoticeCode::UnknownType, 4, 1}}));
        }
    }
}

} // namespace
} // namespace posewire::wire
