// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/input_output.h"
#include "tests/support/stream_source.h"

#include <gtest/gtest.h>

#include <sstream>

namespace posewire::cli {
namespace {

std::vector<std::string> linesOf(const std::string& text) {
    std::istringstream stream(text);
    const auto sender = posewire::test::readingFrom(stream, "test");
    LineReader reader(*sender);
    std::vector<std::string> lines;
    while (true) {
        const auto line = reader.next();
        if (!line || !*line) {
            return lines;
        }
        lines.emplace_back(**line);
        EXPECT_EQ(reader.lineNumber(), lines.size());
    }
}

TEST(LineReader, SplitsAtEveryLineEnd) {
    EXPECT_EQ(linesOf(""), (std::vector<std::string>{}));
    EXPECT_EQ(linesOf("a\n\nb\r\nc"), (std::vector<std::string>{"a", "", "b", "c"}));
    EXPECT_EQ(linesOf("a\n"), (std::vector<std::string>{"a"}));
}

TEST(LineReader, KeepsLinesWholeAcrossReads) {
    std::string text;
    std::vector<std::string> expected;
    for (std::size_t size = 0; size < 300'000; size += 65'535) {
        expected.emplace_back(size, 'x');
        text += expected.back() + "\n";
    }
    EXPECT_EQ(linesOf(text), expected);
}

TEST(LineReader, EndsWithAnErrorAtALineThatWouldNotEnd) {
    EXPECT_EQ(linesOf(std::string(LineReader::kLongestLine, 'x')).size(), 1U);
    std::istringstream stream("a\n" + std::string(LineReader::kLongestLine + 1, 'x'));
    const auto source = posewire::test::readingFrom(stream, "test");
    LineReader reader(*source);
    EXPECT_TRUE(reader.next());
    const auto line = reader.next();
    ASSERT_FALSE(line);
    EXPECT_EQ(line.error().text,
              "test: line 2 is longer than 4 MiB, the most that is read; is this JSON Lines of decode?");
}

} // namespace
} // namespace posewire::cli
