// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/standard_streams.h"

#include <gtest/gtest.h>

#include <array>

namespace posewire::system {
namespace {

TEST(StandardStreams, HaveASizeWhereThereIsNoTerminalToo) {
    const TerminalSize size = terminalSize();
    EXPECT_GT(size.rows, 1U);
    EXPECT_GT(size.columns, 1U);
}

TEST(StandardStreams, AreNoTerminalWhereTheyAreClosed) {
    EXPECT_FALSE(isTerminal(9'999));
}

/// Those of this program: on Windows the system is asked, not main().
TEST(Arguments, BeginWithTheProgram) {
    std::string name = "app_system_test";
    std::array<char*, 1> arguments{name.data()};
    const std::vector<std::string> texts = argumentsOf(1, arguments.data());
    ASSERT_FALSE(texts.empty());
    EXPECT_NE(texts.front().find("app_system_test"), std::string::npos);
}

} // namespace
} // namespace posewire::system
