// SPDX-License-Identifier: MIT
#include "core/wire/text.h"

#include "core/wire/codec.h"

#include <gtest/gtest.h>

namespace posewire::wire {
namespace {

TEST(MetadataText, SplitsAtTheFirstColonOnly) {
    const TagList list = parseTags("name:a:b: c\ncolor:e96417\n");
    EXPECT_EQ(list.tags, (std::vector<Tag>{{"name", "a:b: c"}, {"color", "e96417"}}));
    EXPECT_EQ(list.strayLines, 0U);
}

TEST(MetadataText, KeepsOrderDoublesAndEmptyValues) {
    const TagList list = parseTags("b:\na:1\nb:2\n");
    EXPECT_EQ(list.tags, (std::vector<Tag>{{"b", ""}, {"a", "1"}, {"b", "2"}}));
}

TEST(MetadataText, CountsLinesThatAreNoTags) {
    EXPECT_EQ(parseTags("").strayLines, 0U);
    EXPECT_EQ(parseTags("\n").strayLines, 1U);
    EXPECT_EQ(parseTags("no colon\nname:x\n").strayLines, 1U);
    const TagList unfinished = parseTags("name:x\ncolor:e9");
    EXPECT_EQ(unfinished.strayLines, 1U);
    EXPECT_EQ(unfinished.tags.size(), 2U);
}

TEST(MetadataText, GivesANoticeWithThePlaceOfALineWithoutATag) {
    Datagram datagram;
    datagram.body = MetaData{true, "name:x\nno colon\ncolor:e9\n\n"};
    completeHeader(datagram, HeaderEra::Counted);
    const auto decoded = decode(*encode(datagram));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->notices, (std::vector{Notice{NoticeCode::LineWithoutTag, 24 + 4 + 7, 2}}));
    EXPECT_EQ(noticeText(decoded->notices[0]), "line that is not \"tag:value\" (byte 35, 2 lines)");
    EXPECT_EQ(noticeText({NoticeCode::LineWithoutTag, 28, 1}),
              "line that is not \"tag:value\" (byte 28, 1 line)");
}

TEST(MetadataText, KnowsTheTagsOfRealSenders) {
    for (const char* name : {"name", "xmid", "color", "count", "timeOffset"}) {
        EXPECT_TRUE(isKnownTag(name)) << name;
    }
    EXPECT_FALSE(isKnownTag("colour"));
    EXPECT_FALSE(isKnownTag(""));
}

TEST(MetadataText, GivesANoticeWithThePlaceOfAnUnknownTag) {
    Datagram datagram;
    datagram.body = MetaData{true, "name:x\nshoe:44\nhat:7\n"};
    completeHeader(datagram, HeaderEra::Counted);
    const auto decoded = decode(*encode(datagram));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->notices, (std::vector{Notice{NoticeCode::UnknownTag, 24 + 4 + 7, 2}}));
}

} // namespace
} // namespace posewire::wire
