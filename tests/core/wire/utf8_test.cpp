// SPDX-License-Identifier: MIT
#include "core/wire/text.h"

#include <gtest/gtest.h>

namespace posewire::wire {
namespace {

using namespace std::string_view_literals;

TEST(Utf8, AcceptsTheFirstAndLastOfEveryLength) {
    for (const std::string_view text :
         {""sv, "\0"sv, "\x7f"sv, "\xc2\x80"sv, "\xdf\xbf"sv, "\xe0\xa0\x80"sv, "\xed\x9f\xbf"sv,
          "\xee\x80\x80"sv, "\xef\xbf\xbf"sv, "\xf0\x90\x80\x80"sv, "\xf4\x8f\xbf\xbf"sv}) {
        EXPECT_EQ(firstInvalidUtf8(text), text.size());
    }
}

TEST(Utf8, RejectsOverlongFormsSurrogatesAndWhatIsBeyondUnicode) {
    for (const std::string_view text :
         {"\xc0\x80"sv, "\xc1\xbf"sv, "\xe0\x9f\xbf"sv, "\xf0\x8f\xbf\xbf"sv, "\xed\xa0\x80"sv,
          "\xed\xbf\xbf"sv, "\xf4\x90\x80\x80"sv, "\xf5\x80\x80\x80"sv, "\xff"sv, "\xfe"sv}) {
        EXPECT_EQ(firstInvalidUtf8(text), 0U);
        EXPECT_EQ(firstInvalidUtf8("ab" + std::string(text)), 2U);
    }
}

TEST(Utf8, RejectsSequencesThatEndEarly) {
    for (const std::string_view text : {"\x80"sv, "\xbf"sv, "\xc3"sv, "\xc3g"sv, "\xe2\x82"sv, "\xe2\x82g"sv,
                                        "\xf0\x9f\x98"sv, "\xf0\x9f\x98g"sv}) {
        EXPECT_EQ(firstInvalidUtf8(text), 0U);
        EXPECT_EQ(firstInvalidUtf8("\xc3\xa9" + std::string(text) + "z"), 2U);
    }
}

} // namespace
} // namespace posewire::wire
