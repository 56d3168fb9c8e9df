// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/usage/usage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace posewire::usage {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Option withForm(const std::string& form) {
    Option option;
    option.names = {"--option"};
    option.form = form;
    return option;
}

TEST(Usage, OnlyAnOptionWithoutANameIsAnArgument) {
    Option option = withForm("FILE");
    EXPECT_FALSE(isArgument(option));
    option.names.clear();
    EXPECT_TRUE(isArgument(option));
}

TEST(Usage, ASwitchAndAValueInBracketsNeedNoValue) {
    EXPECT_FALSE(needsValue(withForm("")));
    EXPECT_FALSE(needsValue(withForm("[NUMBER]")));
    EXPECT_TRUE(needsValue(withForm("NUMBER")));
    EXPECT_TRUE(needsValue(withForm("[ADDRESS:]PORT")));
    EXPECT_TRUE(needsValue(withForm("S[:SAMPLE]")));
    EXPECT_TRUE(needsValue(withForm("[A]B[C]")));
}

TEST(Usage, ChoicesAreAlternativesThatStandForThemselves) {
    EXPECT_THAT(choicesOf(withForm("dark|light")), ElementsAre("dark", "light"));
    EXPECT_THAT(choicesOf(withForm("E|J")), ElementsAre("E", "J"));
    EXPECT_THAT(choicesOf(withForm("Check|FILE")), ElementsAre("Check"));
    EXPECT_THAT(choicesOf(withForm("HOST|NET")), IsEmpty());
    EXPECT_THAT(choicesOf(withForm("P")), IsEmpty()) << "one word is no choice";
    EXPECT_THAT(choicesOf(withForm("WxH")), IsEmpty());
}

TEST(Usage, AFileIsCalledFileWithOrWithoutASuffix) {
    EXPECT_TRUE(takesFile(withForm("FILE")));
    EXPECT_TRUE(takesFile(withForm("FILE.png")));
    EXPECT_TRUE(takesFile(withForm("Check|FILE")));
    EXPECT_FALSE(takesFile(withForm("PROFILE")));
    EXPECT_FALSE(takesFile(withForm("")));
}

TEST(Usage, TheNearestWordIsAThirdWrongAtMost) {
    const std::vector<std::string> known{"", "decode", "encode", "export", "monitor", "send", "--on"};
    EXPECT_EQ(nearest("moniter", known), "monitor");
    EXPECT_EQ(nearest("dceode", known), "decode");
    EXPECT_EQ(nearest("expor", known), "export") << "missing";
    EXPECT_EQ(nearest("sendd", known), "send") << "too many";
    EXPECT_EQ(nearest("decode", known), "decode");
    EXPECT_EQ(nearest("watch", known), "");
    EXPECT_EQ(nearest("-x", known), "");
    EXPECT_EQ(nearest("", {"x"}), "");
}

} // namespace
} // namespace posewire::usage
