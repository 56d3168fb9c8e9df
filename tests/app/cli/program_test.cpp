// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/cli/program_run.h"

#include <gmock/gmock.h>

namespace posewire::cli::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// One line: what, where, what to do.
void expectOneClearLine(const ProgramRun& run) {
    EXPECT_THAT(run.err, StartsWith("posewire-cli"));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(run.err.empty() ? 'x' : run.err.back(), '\n');
}

TEST(Program, ShowsHelpWithoutADisplay) {
    const ProgramRun run = runProgram({"--help"});
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.err, "");
    for (const char* command :
         {"decode", "encode", "export", "query", "send", "monitor", "report", "reference"}) {
        EXPECT_THAT(run.out, HasSubstr(command));
        EXPECT_EQ(runProgram({command, "--help"}).status, 0);
        EXPECT_THAT(runProgram({command, "--help"}).out, HasSubstr(std::string("posewire-cli ") + command));
    }
}

TEST(Program, ShowsItsVersionWithoutADisplay) {
    const ProgramRun run = runProgram({"--version"});
    EXPECT_EQ(run.status, 0);
    EXPECT_TRUE(contains(run.out, R"(^posewire-cli \d+\.\d+\.\d+([~+]dev\S*)?\nQt \d+\.\d+\.\d+\n$)"))
        << run.out;
    EXPECT_EQ(runProgram({"-v"}).out, run.out);
    EXPECT_EQ(runProgram({"monitor", "-v"}).out, run.out);
}

TEST(Program, EndsWithStatusTwoOnWrongUsage) {
    const std::vector<std::vector<std::string>> wrong{{},
                                                      {"--foo"},
                                                      {"decoed"},
                                                      {"decode"},
                                                      {"decode", "--foo", "-"},
                                                      {"encode"},
                                                      {"encode", "a", "b"},
                                                      {"send", "--characters", "x"},
                                                      {"send", "--tcp", "--udp"},
                                                      {"send", "--types", "99"},
                                                      {"send", "--revision", "Q"},
                                                      {"send", "--motion", "fly"},
                                                      {"send", "--to", "a:b"},
                                                      {"send", "--to", "127.0.0.1:0", "--duration", "0.1"},
                                                      {"monitor", "--tcp", "127.0.0.1:0", "--duration", "1"},
                                                      {"send", "--loop"},
                                                      {"send", "--rate", "0"},
                                                      {"send", "--characters", "0"},
                                                      {"reference", "x"}};
    for (const auto& arguments : wrong) {
        const ProgramRun run = runProgram(arguments);
        EXPECT_EQ(run.status, 2) << testing::PrintToString(arguments);
        EXPECT_EQ(run.out, "") << testing::PrintToString(arguments);
        expectOneClearLine(run);
    }
}

TEST(Program, EndsWithStatusTwoWhereAFileCannotBeOpened) {
    const std::vector<std::vector<std::string>> wrong{
        {"decode", "/no/such/file"},
        {"decode", "/"},
        {"encode", "/no/such/file"},
        {"encode", "-", "-o", "/no/such/folder/file"},
        {"send", "--to", "127.0.0.1:9", "--file", "/no/such/file"}};
    for (const auto& arguments : wrong) {
        const ProgramRun run = runProgram(arguments);
        EXPECT_EQ(run.status, 2) << testing::PrintToString(arguments);
        expectOneClearLine(run);
    }
    EXPECT_THAT(runProgram({"decode", "/no/such/file"}).err, HasSubstr("/no/such/file: no such file"));
}

TEST(Program, NamesTheOptionThatItDoesNotKnow) {
    EXPECT_EQ(runProgram({"decode", "--jsno", "-"}).err,
              "posewire-cli decode: --jsno is not known here (did you mean --json?); see posewire-cli decode "
              "--help\n");
}

TEST(Program, SaysWhichNumbersAnOptionTakes) {
    const auto complaint = [](const std::vector<std::string>& arguments) {
        return runProgram(arguments).err;
    };
    EXPECT_EQ(complaint({"monitor", "--duration", "-3"}),
              "posewire-cli monitor: --duration: \"-3\" is not a number from 0 to 31536000; see posewire-cli "
              "monitor --help\n");
    EXPECT_THAT(complaint({"send", "--rate", "x"}),
                HasSubstr("--rate: \"x\" is not a number from 1 to 1000;"));
    EXPECT_THAT(complaint({"send", "--restart-at", ""}), HasSubstr("--restart-at: needs a value;"));
    EXPECT_THAT(complaint({"send", "--drop", "2"}), HasSubstr("--drop: \"2\" is not a number from 0 to 1;"));
    EXPECT_THAT(complaint({"send", "--senders", "99"}), HasSubstr("\"99\" is not a number from 1 to 16;"));
}

TEST(Program, ReadsNumbersInDecimalOnly) {
    for (const std::string number : {"0x1", "1e0", " 1", "+1", "1.0"}) {
        EXPECT_THAT(runProgram({"send", "--characters", number}).err,
                    HasSubstr("--characters: \"" + number + "\" is not a whole number from 1 to 32;"));
    }
    for (const std::string number : {"0x1", " 1", "+1", "1,5"}) {
        EXPECT_THAT(runProgram({"send", "--rate", number}).err,
                    HasSubstr("--rate: \"" + number + "\" is not a number from 1 to 1000;"));
    }
    EXPECT_THAT(runProgram({"send", "--characters", "040"}).err, HasSubstr("is not a number from 1 to 32;"))
        << "not 32 in octal";
}

TEST(Program, TakesNoNumberThatMakesNoSense) {
    const std::vector<std::vector<std::string>> options{
        {"monitor", "--duration"},   {"monitor", "--interval"}, {"monitor", "--max-loss"},
        {"monitor", "--max-jitter"}, {"monitor", "--max-gap"},  {"send", "--duration"},
        {"send", "--rate"},          {"send", "--delay"},       {"send", "--jitter"},
        {"send", "--drop"},          {"send", "--characters"},  {"send", "--senders"},
        {"send", "--restart-at"},    {"send", "--pause-at"},    {"send", "--seed"},
        {"send", "--first-sample"},  {"send", "--props"}};
    for (std::vector<std::string> arguments : options) {
        for (const char* number : {"nan", "inf", "-inf", "-1", "1e300", "-1e300"}) {
            std::vector<std::string> all = arguments;
            all.insert(all.end(), {std::string(number), "--to", "127.0.0.1:9"});
            all.resize(arguments[0] == "send" ? all.size() : 3);
            const ProgramRun run = runProgram(all);
            EXPECT_EQ(run.status, 2) << testing::PrintToString(all);
            expectOneClearLine(run);
        }
    }
    EXPECT_THAT(runProgram({"monitor", "--max-loss", "101"}).err,
                HasSubstr("is not a number from 0 to 100;"));
}

TEST(Program, PrintsTheProtocolReference) {
    const ProgramRun run = runProgram({"reference"});
    EXPECT_EQ(run.status, 0);
    EXPECT_THAT(run.out, StartsWith("# MXTP protocol reference\n"));
    EXPECT_THAT(run.out, HasSubstr("## 25 Time code"));
}

} // namespace
} // namespace posewire::cli::test
