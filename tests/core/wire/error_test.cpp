// SPDX-License-Identifier: MIT
#include "core/wire/faults.h"

#include <gtest/gtest.h>

#include <set>

namespace posewire::wire {
namespace {

TEST(WireErrorTable, HasANameAndATextOfItsOwnForEveryCode) {
    std::set<std::string> names;
    std::set<std::string> texts;
    for (std::size_t i = 0; i < kErrorCodeCount; ++i) {
        const WireError error{static_cast<ErrorCode>(i), 2, 3, 4, 5};
        names.insert(std::string(errorName(error.code)));
        texts.insert(errorText(error));
        EXPECT_NE(errorText(error).find("byte 3"), std::string::npos);
    }
    EXPECT_EQ(names.size(), kErrorCodeCount);
    EXPECT_EQ(texts.size(), kErrorCodeCount);
    EXPECT_FALSE(names.contains(""));
}

TEST(WireErrorTable, IsInStepWithTheEnum) {
    EXPECT_EQ(static_cast<std::size_t>(ErrorCode::TooLong) + 1, kErrorCodeCount);
    EXPECT_EQ(errorName(ErrorCode::HeaderTruncated), "headerTruncated");
    EXPECT_EQ(errorName(ErrorCode::BadMagic), "badMagic");
    EXPECT_EQ(errorName(ErrorCode::BadType), "badType");
    EXPECT_EQ(errorName(ErrorCode::PayloadTruncated), "payloadTruncated");
    EXPECT_EQ(errorName(ErrorCode::ItemsTruncated), "itemsTruncated");
    EXPECT_EQ(errorName(ErrorCode::NoItems), "noItems");
    EXPECT_EQ(errorName(ErrorCode::FieldTruncated), "fieldTruncated");
    EXPECT_EQ(errorName(ErrorCode::BadLength), "badLength");
    EXPECT_EQ(errorName(ErrorCode::CountTooLarge), "countTooLarge");
    EXPECT_EQ(errorName(ErrorCode::BadSequence), "badSequence");
    EXPECT_EQ(errorName(ErrorCode::UnterminatedText), "unterminatedText");
    EXPECT_EQ(errorName(ErrorCode::TooLong), "tooLong");
}

TEST(WireErrorTable, SaysWhatWasNeededAndWhatWasThere) {
    EXPECT_EQ(errorText({ErrorCode::PayloadTruncated, 2, 500, 760, 500}),
              "shorter than its header announces (byte 500: needs 760 bytes, has 500)");
    EXPECT_EQ(errorText({ErrorCode::BadSequence, 12, 30, 0, 0}), "a string is not valid UTF-8 (byte 30)");
    EXPECT_EQ(errorText({ErrorCode::BadLength, 12, 24, 0xffffffff, 8}),
              "the length of a string is negative or leads past the end (byte 24: says -1 bytes, has 8)");
    EXPECT_EQ(errorText({ErrorCode::CountTooLarge, 13, 24, 300, 10}),
              "a count is larger than the format allows or the rest of the datagram can hold (byte 24: says "
              "300 items, has room for 10)");
    EXPECT_EQ(errorText({ErrorCode::TooLong, 12, 0, 65'508, 65'507}),
              "longer than a datagram can be (byte 0: needs 65508 bytes, has room for 65507)");
}

TEST(NoticeTable, HasANameAndATextOfItsOwnForEveryCode) {
    std::set<std::string> names;
    std::set<std::string> texts;
    for (std::size_t i = 0; i < kNoticeCodeCount; ++i) {
        const Notice notice{static_cast<NoticeCode>(i), 3, 4};
        names.insert(std::string(noticeName(notice.code)));
        texts.insert(noticeText(notice));
    }
    EXPECT_EQ(static_cast<std::size_t>(NoticeCode::TooManyPoints) + 1, kNoticeCodeCount);
    EXPECT_EQ(names.size(), kNoticeCodeCount);
    EXPECT_EQ(texts.size(), kNoticeCodeCount);
}

/// Filters and files know notices by these names.
TEST(NoticeTable, IsInStepWithTheEnum) {
    EXPECT_EQ(noticeName(NoticeCode::UnknownType), "unknownType");
    EXPECT_EQ(noticeName(NoticeCode::UnknownLayout), "unknownLayout");
    EXPECT_EQ(noticeName(NoticeCode::TrailingBytes), "trailingBytes");
    EXPECT_EQ(noticeName(NoticeCode::SizeDisagrees), "sizeDisagrees");
    EXPECT_EQ(noticeName(NoticeCode::CountDisagrees), "countDisagrees");
    EXPECT_EQ(noticeName(NoticeCode::ReservedUsed), "reservedUsed");
    EXPECT_EQ(noticeName(NoticeCode::NotFinite), "notFinite");
    EXPECT_EQ(noticeName(NoticeCode::NotUnitQuaternion), "notUnitQuaternion");
    EXPECT_EQ(noticeName(NoticeCode::SegmentOutOfRange), "segmentOutOfRange");
    EXPECT_EQ(noticeName(NoticeCode::UnknownTag), "unknownTag");
    EXPECT_EQ(noticeName(NoticeCode::LineWithoutTag), "lineWithoutTag");
    EXPECT_EQ(noticeName(NoticeCode::LengthDisagrees), "lengthDisagrees");
    EXPECT_EQ(noticeName(NoticeCode::NotATimeCode), "notATimeCode");
}

TEST(NoticeTable, CountsInTheSingularOrThePlural) {
    const auto endsWith = [](NoticeCode code, std::uint32_t count, const std::string& end) {
        const std::string text = noticeText({code, 7, count});
        return text.ends_with(" (byte 7, " + end + ")");
    };
    EXPECT_TRUE(endsWith(NoticeCode::TrailingBytes, 1, "1 byte"));
    EXPECT_TRUE(endsWith(NoticeCode::SizeDisagrees, 2, "2 bytes"));
    EXPECT_TRUE(endsWith(NoticeCode::NotFinite, 1, "1 value"));
    EXPECT_TRUE(endsWith(NoticeCode::NotUnitQuaternion, 23, "23 quaternions"));
    EXPECT_TRUE(endsWith(NoticeCode::SegmentOutOfRange, 1, "1 segment"));
    EXPECT_TRUE(endsWith(NoticeCode::UnknownTag, 0xffffffff, "4294967295 tags"));
    EXPECT_TRUE(noticeText({NoticeCode::NotATimeCode, 7, 1}).ends_with(" (byte 7)"));
    EXPECT_TRUE(noticeText({NoticeCode::UnknownType, 4, 1}).ends_with(" (byte 4)"));
}

} // namespace
} // namespace posewire::wire
