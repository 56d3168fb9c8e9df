// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/cli/program_run.h"
#include "tests/support/golden.h"
#include "tests/support/paths.h"

#include <gmock/gmock.h>

namespace posewire::cli::test {
namespace {

using posewire::test::golden;
using posewire::test::goldens;
using testing::HasSubstr;

/// decode --json | encode -
ProgramRun thereAndBack(const std::string& bytes) {
    return runProgram({"encode", "-"}, runProgram({"decode", "--json", "-"}, bytes).out);
}

TEST(EncodeCommand, GivesBackEveryGoldenBitForBit) {
    for (const auto& golden : goldens()) {
        const ProgramRun run = thereAndBack(asText(golden.bytes));
        EXPECT_EQ(run.status, 0) << golden.name << run.err;
        EXPECT_TRUE(run.out == asText(golden.bytes)) << golden.name;
    }
}

TEST(EncodeCommand, GivesBackAFileOfAllGoldensBitForBit) {
    std::string all;
    for (const auto& golden : goldens()) {
        all += asText(golden.bytes);
    }
    const ProgramRun run = thereAndBack(all);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(run.out == all);
}

TEST(EncodeCommand, GivesBackTheRecordedDatagramsBitForBit) {
    std::string all;
    for (const char* file : {"mxtp01.bin", "mxtp02.bin", "mxtp12.bin", "mxtp13.bin"}) {
        const std::string bytes = asText(posewire::test::capture(file));
        if (bytes.empty()) {
            GTEST_SKIP() << "NOT TESTED: the recorded datagrams are not at hand";
        }
        EXPECT_TRUE(thereAndBack(bytes).out == bytes) << file;
        all += bytes;
    }
    EXPECT_TRUE(thereAndBack(all).out == all);
}

TEST(EncodeCommand, WritesToAFile) {
    const std::string target = fileWith("before");
    const std::string line = textOfFile(posewire::test::sourcePath("tests/golden/25_time_code_bare.json"));
    const ProgramRun run = runProgram({"encode", fileWith(line), "-o", target, "--force"});
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.out, "");
    EXPECT_TRUE(textOfFile(target) == asText(golden("25_time_code_bare").bytes));
}

TEST(EncodeCommand, NamesTheLineAndThePlaceOfAFaultAndGoesOn) {
    const std::string good = textOfFile(posewire::test::sourcePath("tests/golden/25_time_code_bare.json"));
    const ProgramRun run = runProgram(
        {"encode", "-"}, good + "\n{\"type\":\"24\",\"body\":{\"position\":[1,2]}}\nhello\n" + good);
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(
        run.err,
        "posewire-cli encode: standard input: line 3: body.position: needs 3 numbers in brackets; the line "
        "is left out\n"
        "posewire-cli encode: standard input: line 4: is not a JSON object; the line is left out\n");
    const std::string one = asText(golden("25_time_code_bare").bytes);
    EXPECT_TRUE(run.out == one + one);
}

TEST(EncodeCommand, LeavesOutWhatStandsForNoDatagram) {
    const std::string one = asText(golden("24_centre_12_counted").bytes);
    const ProgramRun run = thereAndBack("garbage" + one);
    EXPECT_EQ(run.status, 1);
    EXPECT_TRUE(run.out == one);
    EXPECT_THAT(run.err, HasSubstr("1 line holds no datagram (an error, or skipped bytes) and is left out"));
}

} // namespace
} // namespace posewire::cli::test
