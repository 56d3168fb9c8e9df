// SPDX-License-Identifier: MIT
#include "core/export/sheets.h"

#include <gtest/gtest.h>

#include <array>

namespace posewire::exporting {
namespace {

TEST(CsvLine, JoinsCellsAndEndsTheLine) {
    EXPECT_EQ(csvLine(std::array<std::string, 3>{"a", "", "b c"}), "a,,b c\r\n");
    EXPECT_EQ(csvLine({}), "\r\n");
}

TEST(CsvLine, QuotesWhatWouldSplitACellOrALine) {
    EXPECT_EQ(csvLine(std::array<std::string, 1>{"a,b"}), "\"a,b\"\r\n");
    EXPECT_EQ(csvLine(std::array<std::string, 1>{"a\nb"}), "\"a\nb\"\r\n");
    EXPECT_EQ(csvLine(std::array<std::string, 1>{"a\rb"}), "\"a\rb\"\r\n");
    EXPECT_EQ(csvLine(std::array<std::string, 1>{"say \"a\""}), "\"say \"\"a\"\"\"\r\n");
}

} // namespace
} // namespace posewire::exporting
