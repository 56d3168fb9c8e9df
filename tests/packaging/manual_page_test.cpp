// SPDX-License-Identifier: MIT
#include "packaging/manual/pages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace posewire::manual {
namespace {

using testing::HasSubstr;
using testing::Not;
using usage::Option;
using usage::Program;

constexpr std::string_view kFrame = ".TH X 1 \"@DATE@\" \"@VERSION@\"\n@SYNOPSIS@\n@OPTIONS@\n@COMMANDS@\n";
const PageFacts kFacts{"1.2.3", "2026-01-31"};

Option option(std::vector<std::string> names, const std::string& form, const std::string& text) {
    Option made;
    made.names = std::move(names);
    made.form = form;
    made.text = text;
    return made;
}

/// A program with one command and these options of it.
std::string pageWith(std::vector<Option> options) {
    const Program program{"tool", "Does things.", {}, {{"run", "run it", std::move(options)}}};
    const auto page = manualPage(program, kFrame, kFacts);
    EXPECT_TRUE(page) << page.error();
    return page.value_or("");
}

TEST(ManualPage, NamesVersionAndDate) {
    EXPECT_THAT(pageWith({}), testing::StartsWith(".TH X 1 \"2026-01-31\" \"1.2.3\"\n"));
}

TEST(ManualPage, RefusesAFrameThatLacksAPlaceForOptions) {
    const Program plain{"tool", "", {}, {}};
    const auto page = manualPage(plain, ".TH @DATE@ @VERSION@\n@SYNOPSIS@\n", kFacts);
    ASSERT_FALSE(page);
    EXPECT_EQ(page.error(), "no @OPTIONS@ in the frame");
    EXPECT_TRUE(manualPage(plain, ".TH @DATE@ @VERSION@\n@SYNOPSIS@\n@OPTIONS@\n", kFacts))
        << "a program without commands needs no place for them";
    const Program withCommand{"tool", "", {}, {{"run", "", {}}}};
    EXPECT_FALSE(manualPage(withCommand, ".TH @DATE@ @VERSION@\n@SYNOPSIS@\n@OPTIONS@\n", kFacts));
}

TEST(ManualPage, EntriesSayAllThatIsDeclared) {
    Option rate = option({"-r", "--rate"}, "HZ", "samples per second");
    rate.range = "1 to 1000";
    rate.usual = "240";
    rate.needs = {"--on"};
    rate.excludes = {"--off", "FILE"};
    EXPECT_THAT(pageWith({rate}),
                HasSubstr(".TP\n\\fB\\-r\\fR, \\fB\\-\\-rate\\fR \\fIHZ\\fR\n"
                          "Samples per second. From 1 to 1000. Default: \\fB240\\fR. Needs \\fB\\-\\-on\\fR. "
                          "Not together with \\fB\\-\\-off\\fR, \\fIFILE\\fR.\n"));
}

TEST(ManualPage, ChoicesAreBoldAndPlaceholdersItalic) {
    EXPECT_THAT(pageWith({option({"--layout"}, "Check|FILE", "")}), HasSubstr("\\fBCheck\\fR|\\fIFILE\\fR"));
}

TEST(ManualPage, ArgumentsComeFirstAndInTheSynopsis) {
    Option file = option({}, "FILE", "the file");
    file.isRequired = true;
    file.isRepeatable = true;
    Option output = option({"-o", "--output"}, "OUT", "where to");
    output.isRequired = true;
    const std::string page = pageWith({output, file});
    EXPECT_THAT(page, HasSubstr("\\fBtool run\\fR [\\fIOPTION\\fR]... \\fB\\-\\-output\\fR \\fIOUT\\fR "
                                "\\fIFILE\\fR...\n"));
    EXPECT_LT(page.find(".TP\n\\fIFILE\\fR"), page.find(".TP\n\\fB\\-o"));
}

TEST(ManualPage, HeadingsStandOnceAboveTheirOptions) {
    Option first = option({"--a"}, "", "a");
    Option second = option({"--b"}, "", "b");
    first.group = second.group = "Both";
    const std::string page = pageWith({first, second});
    EXPECT_THAT(page, HasSubstr(".PP\nBoth:\n.TP\n\\fB\\-\\-a"));
    EXPECT_EQ(page.find("Both:"), page.rfind("Both:"));
}

TEST(ManualPage, TextIsNeverTakenForARequestOfRoff) {
    const std::string page = pageWith({option({"--a"}, "", "'so a\\b"), option({"--b"}, "", ".so file")});
    EXPECT_THAT(page, HasSubstr("\\&'so a\\eb.\n"));
    EXPECT_THAT(page, HasSubstr("\\&.so file.\n"));
    EXPECT_THAT(page, Not(HasSubstr("\n.so")));
}

} // namespace
} // namespace posewire::manual
