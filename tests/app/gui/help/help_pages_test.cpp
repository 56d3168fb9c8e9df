// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/help/help_pages.h"

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

class HelpPagesTest : public testing::Test {
protected:
    [[nodiscard]] QString best(const QString& words) const {
        const std::vector<HelpHit> hits = pages.search(words);
        return hits.empty() ? QString() : hits.front().page->id;
    }
    const HelpPages pages{{}};
};

TEST_F(HelpPagesTest, FindsThePageThatIsAboutAWordFirst) {
    EXPECT_EQ(best("firewall"), "network");
    EXPECT_EQ(best("packets"), "packets");
    EXPECT_EQ(best("time code"), "timecode");
    EXPECT_EQ(best("unknown cause"), "causes");
    EXPECT_EQ(best("disk full"), "messages");
    EXPECT_EQ(best("glossary"), "glossary");
}

TEST_F(HelpPagesTest, WordsAreMeantByTheirBeginningsWhateverTheirCaseAndOrder) {
    EXPECT_EQ(best("FIREW"), "network");
    EXPECT_EQ(best("code time"), best("time code"));
    EXPECT_TRUE(pages.search("irewall").empty());
}

TEST_F(HelpPagesTest, OnlyPagesWithAllWordsAreFound) {
    EXPECT_FALSE(pages.search("firewall").empty());
    EXPECT_TRUE(pages.search("firewall zebra").empty());
    EXPECT_TRUE(pages.search("  ").empty());
    EXPECT_TRUE(pages.search("[a-z]").empty()) << "what is typed is no pattern";
}

TEST_F(HelpPagesTest, AnExcerptIsALineWithTheWord) {
    for (const HelpHit& hit : pages.search("jitter")) {
        EXPECT_FALSE(hit.excerpt.contains(u'\n'));
        EXPECT_LE(hit.excerpt.size(), 120);
        EXPECT_TRUE(hit.excerpt.contains("jitter", Qt::CaseInsensitive)) << hit.excerpt.toStdString();
    }
}

TEST_F(HelpPagesTest, APageIsMadeOfWhatTheProgramWrites) {
    const HelpPages made({{"shortcuts", "**all keys**"}});
    EXPECT_TRUE(made.find("shortcuts")->markdown.contains("**all keys**"));
    EXPECT_TRUE(made.find("shortcuts")->text.contains("all keys"));
}

TEST(PlaceOfLink, ResolvesLinksWithinTheGuide) {
    EXPECT_EQ(placeOfLink("packets.md#filter", "index"), "packets#filter");
    EXPECT_EQ(placeOfLink("packets.md", "index"), "packets");
    EXPECT_EQ(placeOfLink("#filter", "packets"), "packets#filter");
}

TEST(PlaceOfLink, LeadsNowhereElse) {
    for (const char* link :
         {"https://example.org/a.md", "file:///etc/passwd", "../secret.md", "pictures/a.png"}) {
        EXPECT_TRUE(placeOfLink(link, "index").isEmpty()) << link;
    }
}

} // namespace
} // namespace posewire::gui
