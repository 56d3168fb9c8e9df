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
}

TEST(NoticeTable, HasANameAndATextOfItsOwnForEveryCode) {
    std::set<std::string> names;
    std::set<std::string> texts;
    for (std::size_t i = 0; i < kNoticeCodeCount; ++i) {
        const Notice notice{static_cast<NoticeCode>(i), 3, 4};
        names.insert(std::string(noticeName(notice.code)));
        texts.insert(noticeText(notice));
    }
    EXPECT_EQ(static_cast<std::size_t>(NoticeCode::NotATimeCode) + 1, kNoticeCodeCount);
    EXPECT_EQ(names.size(), kNoticeCodeCount);
    EXPECT_EQ(texts.size(), kNoticeCodeCount);
}

} // namespace
} // namespace posewire::wire
