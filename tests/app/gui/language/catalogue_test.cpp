// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/text.h"
#include "app/gui/theme/language.h"
#include "core/words/say.h"

#include <gtest/gtest.h>

#include <QTranslator>

namespace posewire::gui {
namespace {

/// What the catalogue of English has for a text.
QString inEnglishCatalogue(const char* text, int number) {
    QTranslator english;
    EXPECT_TRUE(english.load("posewire_en", ":/translations"));
    return english.translate("posewire", text, nullptr, number);
}

TEST(Catalogue, HasTheSingularsOfTheWords) {
    ASSERT_TRUE(languages().contains("en"));
    for (const words::Wording& row : words::wordings()) {
        for (const words::Text& text :
             {row.headline, row.sentence, row.line, row.brief, row.cell, row.narrow, row.advice}) {
            if (text.one != nullptr) {
                EXPECT_EQ(inEnglishCatalogue(text.text, 1), text.one);
                EXPECT_EQ(inEnglishCatalogue(text.text, 2), text.text);
            }
        }
    }
}

TEST(Catalogue, HasPluralsOfTheWindow) {
    EXPECT_EQ(inEnglishCatalogue("%n ended senders", 1), "%n ended sender");
    EXPECT_EQ(inEnglishCatalogue("%n ended senders", 2), "%n ended senders");
    EXPECT_EQ(inEnglishCatalogue("tag not known (byte {offset}, {count} tags)", 1),
              "tag not known (byte {offset}, {count} tag)");
}

} // namespace
} // namespace posewire::gui
