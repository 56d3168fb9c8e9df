// SPDX-License-Identifier: MIT
#include "core/filter/completion.h"
#include "core/filter/filter.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

// Filters written with nothing but the completions that are offered, as somebody does who knows no field.
namespace posewire::filter {
namespace {

/// Writes by choosing among the offers; where there is none a value is due, and it writes a number.
class Writer {
public:
    explicit Writer(std::uint32_t seed) : m_random(seed) {}

    /// A filter of at least that many words.
    std::string filter(std::size_t words) {
        m_text.clear();
        for (std::size_t i = 0; i < words || !Filter::compile(m_text); ++i) {
            if (i > words + kMostToFinish) {
                return m_text;
            }
            write();
        }
        return m_text;
    }

private:
    static constexpr std::size_t kMostToFinish = 40;

    void write() {
        const auto offers = completions(m_text, m_text.size());
        if (offers.empty()) {
            m_text += "7 ";
            return;
        }
        const Completion& offer = offers[m_random() % offers.size()];
        EXPECT_LE(offer.offset + offer.length, m_text.size());
        m_text.replace(offer.offset, offer.length, offer.text);
        // Brackets of a set need no space, and what is written after one is the next word.
        m_text += ' ';
    }

    std::mt19937 m_random;
    std::string m_text;
};

TEST(WrittenWithCompletions, EveryFilterCanBeFinishedAndCompiles) {
    std::set<std::string> written;
    for (std::uint32_t seed = 1; seed <= 400; ++seed) {
        const std::string text = Writer(seed).filter(3 + seed % 9);
        const auto filter = Filter::compile(text);
        EXPECT_TRUE(filter) << "seed " << seed << ": " << text << ": " << filter.error().text;
        written.insert(text);
    }
    EXPECT_GT(written.size(), 300U) << "the writer chooses too little";
}

TEST(WrittenWithCompletions, EachOfferOfAFieldIsAFieldAndFitsWhatIsWritten) {
    for (const std::string start :
         {"", "s", "pos", "tag", "header.", "segments.", "type == 2 && ", "!(", "a", "t"}) {
        for (const Completion& offer : completions(start, start.size())) {
            std::string text = start;
            text.replace(offer.offset, offer.length, offer.text);
            const bool isOpen = text.starts_with("!(");
            EXPECT_TRUE(Filter::compile(text + (isOpen ? ")" : ""))) << text;
            EXPECT_FALSE(offer.about.empty()) << text;
        }
    }
}

TEST(WrittenWithCompletions, OffersNothingTwice) {
    for (const std::string start :
         {"", "p", "segment == ", "type in {", "source ", "error == ", "tag.name == \"a\" "}) {
        std::set<std::string> seen;
        for (const Completion& offer : completions(start, start.size())) {
            EXPECT_TRUE(seen.insert(offer.text).second) << start << '|' << offer.text;
        }
        EXPECT_FALSE(seen.empty()) << start;
    }
}

TEST(WrittenWithCompletions, NoCursorAndNoTextIsTooOdd) {
    std::mt19937 random{7};
    constexpr std::string_view alphabet = "ab.{}()!&|<>=\"\\~ 0159xtype\n\xc3\xb6";
    for (std::size_t i = 0; i < 5'000; ++i) {
        std::string text;
        for (std::size_t length = random() % 24; length > 0; --length) {
            text += alphabet[random() % alphabet.size()];
        }
        const std::size_t cursor = random() % (text.size() + 4);
        for (const Completion& offer : completions(text, cursor)) {
            ASSERT_LE(offer.offset + offer.length, text.size()) << text;
            ASSERT_LE(offer.offset, std::min(cursor, text.size())) << text;
        }
    }
}

} // namespace
} // namespace posewire::filter
