// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/cli/program_run.h"
#include "tests/support/golden.h"

#include <gmock/gmock.h>

namespace posewire::cli::test {
namespace {

using posewire::test::golden;
using testing::HasSubstr;
using testing::StartsWith;

/// Types 24, 02 and 25.
std::string threeDatagrams() {
    return asText(golden("24_centre_12_counted").bytes) + asText(golden("02_quaternion_counted").bytes) +
           asText(golden("25_time_code_counted").bytes);
}

std::size_t lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(DecodeFilter, WritesOnlyWhatMatchesAndKeepsTheIndex) {
    const ProgramRun run =
        runProgram({"decode", "--json", "--filter", "type == 02", fileWith(threeDatagrams())});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(lines(run.out), 1);
    EXPECT_THAT(run.out, StartsWith(R"({"index":1,"offset":36,)"));
}

TEST(DecodeFilter, FiltersTheListingToo) {
    const ProgramRun run =
        runProgram({"decode", "--filter", "timeCode contains \":\"", fileWith(threeDatagrams())});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.out, StartsWith("#2  offset "));
}

TEST(DecodeFilter, FindsWhatBelongsToNoDatagram) {
    const std::string file = threeDatagrams() + std::string(500, 'x') + threeDatagrams();
    const ProgramRun run =
        runProgram({"decode", "--json", "--filter", "skipped && size == 500", fileWith(file)});
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(lines(run.out), 1);
    EXPECT_THAT(run.out, HasSubstr(R"("skipped":true)"));
}

TEST(DecodeFilter, ComparesWithThePacketsBefore) {
    const ProgramRun run = runProgram({"decode", "--json", "--filter", "duplicate && type != 24",
                                       fileWith(threeDatagrams() + threeDatagrams())});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(lines(run.out), 2);
    EXPECT_THAT(run.out, StartsWith(R"({"index":4,)"));
}

TEST(DecodeFilter, MarksWhatItDoesNotUnderstand) {
    const ProgramRun run =
        runProgram({"decode", "--filter", "gap && smaple == 1", fileWith(threeDatagrams())});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err, "posewire-cli decode: --filter: There is no field `smaple`; did you mean `sample`?\n"
                       "  gap && smaple == 1\n"
                       "         ^^^^^^\n");
}

TEST(DecodeFilter, HasItsLanguageDescribed) {
    const ProgramRun run = runProgram({"reference", "--filter"});
    EXPECT_EQ(run.status, 0);
    EXPECT_THAT(run.out, StartsWith("# Display filter\n"));
    EXPECT_THAT(run.out, HasSubstr("position"));
}

} // namespace
} // namespace posewire::cli::test
