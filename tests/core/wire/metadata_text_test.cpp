// SPDX-License-Identifier: MIT
#include "core/wire/text.h"

#include "core/wire/codec.h"

#include <gtest/gtest.h>

#include <random>

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
    datagram.body = MetaData{true, "name:x\nno colon\ncolor:e9e9e9\n\n"};
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

TEST(MetadataText, GivesBackAnyTagsThatAreWritten) {
    constexpr std::array<const char*, 7> pieces{"a", "Name", ":", " ", "\u00e9", "\r", "\U0001f600"};
    std::mt19937 random(3);
    for (int round = 0; round < 500; ++round) {
        std::vector<std::string> texts(2 * (random() % 6));
        for (std::size_t i = 0; i < texts.size(); ++i) {
            for (std::size_t n = random() % 5; n > 0; --n) {
                const char* piece = pieces[random() % pieces.size()];
                texts[i] += i % 2 == 0 && *piece == ':' ? "x" : piece; // only a value has colons
            }
        }
        std::vector<Tag> tags;
        std::string text;
        for (std::size_t i = 0; i < texts.size(); i += 2) {
            tags.push_back({texts[i], texts[i + 1]});
            text += texts[i] + ':' + texts[i + 1] + '\n';
        }
        const TagList parsed = parseTags(text);
        EXPECT_EQ(parsed.tags, tags);
        EXPECT_EQ(parsed.strayLines, 0U);
    }
}

/// A line is "tag:value" with a newline behind it; a reference that looks at each line by itself.
TEST(MetadataText, AgreesWithTheRuleForEveryShortText) {
    constexpr std::string_view alphabet = "a:\n";
    for (unsigned number = 0; number < 3 * 3 * 3 * 3 * 3 * 3; ++number) {
        for (std::size_t length = 0; length <= 6; ++length) {
            std::string text;
            for (unsigned rest = number; text.size() < length; rest /= 3) {
                text += alphabet[rest % 3];
            }
            unsigned tags = 0;
            unsigned stray = 0;
            std::size_t firstStray = std::string::npos;
            for (std::size_t at = 0; at < text.size();) {
                const std::size_t end = text.find('\n', at);
                const std::string line = text.substr(at, end - at);
                const bool hasColon = line.find(':') != std::string::npos;
                tags += hasColon ? 1 : 0;
                if (!hasColon || end == std::string::npos) {
                    firstStray = std::min(firstStray, at);
                    ++stray;
                }
                at = end == std::string::npos ? text.size() : end + 1;
            }
            const TagList list = parseTags(text);
            ASSERT_EQ(list.tags.size(), tags) << text;
            ASSERT_EQ(list.strayLines, stray) << text;
            ASSERT_TRUE(stray == 0 || list.firstStray == firstStray) << text;
        }
    }
}

/// Tags are compared as they are written: case counts.
TEST(MetadataText, KnowsTagsByTheirExactName) {
    EXPECT_EQ(knownTags().size(), 5U);
    for (const char* name : {"Name", "NAME", "name ", " name", "timeoffset", "na"}) {
        EXPECT_FALSE(isKnownTag(name)) << name;
    }
}

TEST(MetadataText, CountsPlacesFromTheTextWithOrWithoutALength) {
    for (const bool isPrefixed : {true, false}) {
        Datagram datagram;
        datagram.body = MetaData{isPrefixed, "name:x\nshoe:44\nhat"};
        completeHeader(datagram, HeaderEra::Counted);
        const auto decoded = decode(*encode(datagram));
        ASSERT_TRUE(decoded);
        const std::uint32_t start = isPrefixed ? 28 : 24;
        EXPECT_EQ(decoded->notices, (std::vector{Notice{NoticeCode::UnknownTag, start + 7, 1},
                                                 Notice{NoticeCode::LineWithoutTag, start + 15, 1}}));
    }
}

} // namespace
} // namespace posewire::wire
