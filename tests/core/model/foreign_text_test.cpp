// SPDX-License-Identifier: MIT
#include "core/model/foreign_text.h"

#include "core/wire/text.h"

#include <gtest/gtest.h>

#include <random>
#include <type_traits>

namespace posewire::model {
namespace {

using namespace std::string_literals;

TEST(ForeignText, ShowsPlainNamesAsTheyAre) {
    for (const char* name : {"", "Ana", "Zoë Ærø", "山田 太郎", "a & b <c> \"d\"", "🕺"}) {
        const ForeignText text(name);
        EXPECT_EQ(text.shown(), name);
        EXPECT_EQ(text.exact(), name);
        EXPECT_FALSE(text.hasForgettable());
    }
}

TEST(ForeignText, IsNoStringByItself) {
    static_assert(!std::is_convertible_v<ForeignText, std::string>);
    static_assert(!std::is_convertible_v<ForeignText, std::string_view>);
    static_assert(!std::is_constructible_v<std::string, ForeignText>);
}

TEST(ForeignText, ShowsControlsAsPictures) {
    EXPECT_EQ(ForeignText("a\x1b[2J\r\n\t\x7f"s).shown(), "a␛[2J␍␊␉␡");
    EXPECT_EQ(ForeignText("\0"s).shown(), "␀");
    EXPECT_EQ(ForeignText("\xc2\x9b"s).shown(), "⟨U+009B⟩");
}

TEST(ForeignText, ShowsWhatTurnsOrHidesTextAsItsCode) {
    EXPECT_EQ(ForeignText("gpj\u202eexe").shown(), "gpj⟨U+202E⟩exe");
    for (const char* unseen : {"\u202a", "\u202b", "\u202c", "\u202d", "\u2066", "\u2067",    "\u2068",
                               "\u2069", "\u200e", "\u200f", "\u061c", "\u200b", "\u200c",    "\u200d",
                               "\u2060", "\ufeff", "\u00ad", "\u2028", "\u2029", "\U000e0041"}) {
        EXPECT_TRUE(ForeignText(unseen).shown().starts_with("⟨U+")) << ForeignText(unseen).shown();
    }
}

TEST(ForeignText, ShowsBytesThatAreNoTextAsReplacements) {
    EXPECT_EQ(ForeignText("a\xff\xc3").shown(), "a\ufffd\ufffd");
    EXPECT_EQ(ForeignText("\xed\xa0\x80").shown(), "\ufffd\ufffd\ufffd") << "a surrogate";
}

TEST(ForeignText, IsClippedBetweenCharactersAndKeepsTheBytes) {
    const std::string whole(ForeignText::kMostBytes, 'x');
    EXPECT_EQ(ForeignText(whole).shown(), whole);
    std::string ahs;
    for (int i = 0; i < 30'000; ++i) {
        ahs += "ä";
    }
    const ForeignText text(ahs);
    EXPECT_LE(text.shown().size(), ForeignText::kMostBytes);
    EXPECT_GT(text.shown().size(), ForeignText::kMostBytes - 5);
    EXPECT_TRUE(text.shown().ends_with("ä…"));
    EXPECT_EQ(text.exact(), ahs);
    EXPECT_GT(text.memoryBytes(), ahs.size());
}

TEST(ForeignText, IsEqualWhereTheBytesAreAlsoWhereTheyWereForgotten) {
    const std::string one = std::string(300, 'x') + "1";
    const std::string two = std::string(300, 'x') + "2";
    ForeignText text(one);
    text.forgetExact();
    EXPECT_EQ(text, ForeignText(one));
    EXPECT_EQ(text, one);
    EXPECT_FALSE(text == two);
    EXPECT_FALSE(text == ForeignText(two));
    EXPECT_FALSE(text == text.shown()) << "what is shown was not sent";
    EXPECT_LT(text.memoryBytes(), 300U);
    EXPECT_FALSE(ForeignText("␀") == ForeignText("\0"s));
}

TEST(ForeignText, IsNoMarkupInHtml) {
    EXPECT_EQ(ForeignText("<img src=\"file:///etc/hostname\">&lt;'").html(),
              "&lt;img src=&quot;file:///etc/hostname&quot;&gt;&amp;lt;&#39;");
}

TEST(ForeignText, IsNoFormulaInATable) {
    for (const char* formula : {"=HYPERLINK(\"x\")", "+1", "-1", "@SUM(1)", "＝1", "＠SUM(1)"}) {
        EXPECT_EQ(ForeignText(formula).csv(), "'" + std::string(formula));
    }
    EXPECT_EQ(csvText("\t=1"), "'\t=1");
    EXPECT_EQ(csvText("\r=1"), "'\r=1");
    EXPECT_EQ(ForeignText("a=1").csv(), "a=1");
    EXPECT_EQ(ForeignText("").csv(), "");
}

TEST(ForeignText, ProposesAPlainFileName) {
    const auto nameOf = [](std::string_view text) { return ForeignText(text).fileName("character"); };
    EXPECT_EQ(nameOf("Ana"), "Ana");
    EXPECT_EQ(nameOf("../../x"), "_.._x");
    EXPECT_EQ(nameOf("/etc/passwd"), "_etc_passwd");
    EXPECT_EQ(nameOf("C:\\x|y*?\"<>"), "C__x_y_____");
    EXPECT_EQ(nameOf(".profile"), "profile");
    EXPECT_EQ(nameOf("a. "), "a");
    EXPECT_EQ(nameOf("CON"), "_CON");
    EXPECT_EQ(nameOf("lpt1.txt"), "_lpt1.txt");
    EXPECT_EQ(nameOf("console"), "console");
    EXPECT_EQ(nameOf("a\nb\u202e"), "a␊b⟨U+202E⟩");
    for (const char* nothing : {"", ".", "..", "   "}) {
        EXPECT_EQ(nameOf(nothing), "character");
    }
    std::string wide;
    for (int i = 0; i < 100; ++i) {
        wide += "山";
    }
    EXPECT_LE(nameOf(wide).size(), ForeignText::kMostFileNameBytes);
    EXPECT_EQ(wire::firstInvalidUtf8(nameOf(wide)), nameOf(wide).size());
}

TEST(ForeignText, IsSafeWhateverTheBytes) {
    std::mt19937 random(7);
    for (int round = 0; round < 2'000; ++round) {
        std::string bytes(random() % 400, ' ');
        for (char& byte : bytes) {
            byte = static_cast<char>(random() % 3 == 0 ? random() % 48 : random());
        }
        const ForeignText text(bytes);
        const std::string& shown = text.shown();
        EXPECT_EQ(wire::firstInvalidUtf8(shown), shown.size());
        EXPECT_LE(shown.size(), ForeignText::kMostBytes);
        EXPECT_EQ(ForeignText(shown).shown(), shown) << "nothing is left to be shown as a symbol";
        EXPECT_EQ(text.exact(), bytes);
        EXPECT_EQ(text.fileName("x").find_first_of("/\\"), std::string::npos);
        EXPECT_FALSE(text.fileName("x").empty());
    }
}

TEST(VisibleText, LeavesOurOwnLinesAsTheyAre) {
    EXPECT_EQ(visibleText("one\n\ttwo\x1b\u202e"), "one\n\ttwo␛⟨U+202E⟩");
    EXPECT_EQ(visibleText(std::string(1'000, 'x')).size(), 1'000U);
}

} // namespace
} // namespace posewire::model
