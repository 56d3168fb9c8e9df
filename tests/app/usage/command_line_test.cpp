// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/usage/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace posewire::usage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A program whose command "write" has options that were called otherwise before.
class FormerSpelling : public testing::Test {
protected:
    struct Parsed {
        tl::expected<std::string, EarlyExit> command;
        std::string said; ///< on standard error
    };

    Parsed parse(std::vector<std::string> arguments) {
        m_output.clear();
        m_senders.clear();
        m_rate = 0;
        CommandLine line("tool", "Does things.", [] { return std::string("1.2.3"); });
        Arguments write = line.addCommand("write", "Write it");
        line.addCommand("read", "Read it");
        DeclaredOption file = write.flag("--on", "it is on");
        write.add("--rate HZ", m_rate, "how often").within(1.0, 10.0).needs(file).formerly("--speed");
        write.add("-o,--output FILE", m_output, "the file").required().formerly("--to");
        write.add("--sender HOST", m_senders, "who").formerly("--from").formerly("--host");
        m_usage = line.usage();
        arguments.insert(arguments.begin(), "tool");
        testing::internal::CaptureStderr();
        auto command = line.parse(arguments);
        return {std::move(command), testing::internal::GetCapturedStderr()};
    }

    /// Returns the complaint about these arguments.
    std::string mistakeIn(const std::vector<std::string>& arguments) {
        const Parsed parsed = parse(arguments);
        EXPECT_FALSE(parsed.command);
        return parsed.command ? std::string() : parsed.command.error().text;
    }

    std::string m_output;
    std::vector<std::string> m_senders;
    double m_rate = 0;
    Program m_usage;
};

TEST_F(FormerSpelling, GivesItsValueToTheOptionAndWarns) {
    const Parsed parsed = parse({"write", "--to", "x", "--rate=5", "--on"});
    ASSERT_TRUE(parsed.command) << parsed.command.error().text;
    EXPECT_EQ(*parsed.command, "write");
    EXPECT_EQ(m_output, "x");
    EXPECT_EQ(m_rate, 5);
    EXPECT_EQ(parsed.said, "tool write: --to is an old spelling of --output, accepted until version 1.0\n");
    EXPECT_EQ(parse({"write", "-o", "x"}).said, "");
}

TEST_F(FormerSpelling, IsRepeatableAsTheOptionIs) {
    const Parsed parsed = parse({"write", "-o", "x", "--from", "a", "--from=b"});
    EXPECT_THAT(m_senders, ElementsAre("a", "b"));
    EXPECT_EQ(std::count(parsed.said.begin(), parsed.said.end(), '\n'), 1) << parsed.said;
    EXPECT_FALSE(parse({"write", "--to", "x", "--to", "y"}).command) << "neither is --output";
}

TEST_F(FormerSpelling, IsCheckedAsTheOptionIs) {
    EXPECT_THAT(mistakeIn({"write", "--to", "x", "--speed", "5"}), HasSubstr("--rate requires --on"));
    EXPECT_THAT(mistakeIn({"write", "--to", "x", "--on", "--speed", "50"}),
                HasSubstr("--rate: \"50\" is not a number from 1 to 10"));
    EXPECT_THAT(mistakeIn({"write", "--to", ""}), HasSubstr("--output: needs a value"));
    EXPECT_THAT(mistakeIn({"write"}), HasSubstr("--output is required"));
}

TEST_F(FormerSpelling, IsAMistakeTogetherWithTheNewOne) {
    const std::string both = "tool write: --to is an old spelling of --output: give one of them; see tool "
                             "write --help\n";
    EXPECT_EQ(mistakeIn({"write", "--to", "x", "-o", "x"}), both);
    EXPECT_EQ(mistakeIn({"write", "-o", "x", "--to", "x"}), both);
    EXPECT_THAT(mistakeIn({"write", "-o", "x", "--from", "a", "--host", "b"}), HasSubstr("give one of them"));
}

TEST_F(FormerSpelling, IsNoValueAndNoArgumentOfAnother) {
    EXPECT_EQ(parse({"write", "-o", "--from"}).said, "");
    EXPECT_EQ(m_output, "--from");
}

TEST_F(FormerSpelling, IsInNoListOfOptions) {
    const Parsed help = parse({"write", "--help"});
    ASSERT_FALSE(help.command);
    EXPECT_THAT(help.command.error().text, HasSubstr("--output"));
    EXPECT_THAT(help.command.error().text, testing::Not(HasSubstr("--to")));
    for (const Option& option : m_usage.commands[0].options) {
        for (const char* former : {"--to", "--from", "--host", "--speed"}) {
            EXPECT_THAT(option.names, testing::Not(testing::Contains(former)));
        }
    }
    EXPECT_THAT(mistakeIn({"write", "-o", "x", "--tto", "y"}), testing::Not(HasSubstr("mean --to?")));
}

TEST_F(FormerSpelling, AMistypedWordIsAnsweredWithTheOneThatWasMeant) {
    EXPECT_EQ(mistakeIn({"wirte"}), "tool: wirte is not known here (did you mean write?); see tool --help\n");
    EXPECT_THAT(mistakeIn({"write", "-o", "x", "--sendr=a"}), HasSubstr("(did you mean --sender?)"));
    EXPECT_THAT(mistakeIn({"write", "-o", "x", "--verison"}), HasSubstr("(did you mean --version?)"));
    EXPECT_THAT(mistakeIn({"--verison"}), HasSubstr("(did you mean --version?)"));
}

TEST_F(FormerSpelling, CommandsHaveTheVersionToo) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"-v"}, {"--version"}, {"write", "-v"}, {"read", "--version"}}) {
        const Parsed parsed = parse(arguments);
        ASSERT_FALSE(parsed.command);
        EXPECT_EQ(parsed.command.error().status, 0);
        EXPECT_EQ(parsed.command.error().text, "1.2.3\n");
    }
}

} // namespace
} // namespace posewire::usage
