// SPDX-License-Identifier: MIT
#include "core/filter/filter.h"

#include <gmock/gmock.h>

namespace posewire::filter {
namespace {

using testing::HasSubstr;

struct Wrong {
    std::string text;
    std::string at; ///< the bytes that the error points at; empty at the end
    std::string says;
};

class FilterErrors : public testing::TestWithParam<Wrong> {};

TEST_P(FilterErrors, PointAtTheBytesAndSayWhatWouldBeRight) {
    const Wrong& wrong = GetParam();
    const auto filter = Filter::compile(wrong.text);
    ASSERT_FALSE(filter.has_value());
    const FilterError& error = filter.error();
    ASSERT_LE(error.offset + error.length, wrong.text.size());
    EXPECT_EQ(wrong.text.substr(error.offset, error.length), wrong.at) << error.text;
    EXPECT_THAT(error.text, HasSubstr(wrong.says));
}

INSTANTIATE_TEST_SUITE_P(
    Texts, FilterErrors,
    testing::Values(
        Wrong{"smaple == 1", "smaple", "did you mean `sample`?"},
        Wrong{"type == 2 && postion.z > 1", "postion.z", "did you mean `position.z`?"},
        Wrong{"zzzzzzzz", "zzzzzzzz", "There is no field `zzzzzzzz`."},
        Wrong{"orientaton.re > 1", "orientaton.re", "did you mean `orientation.re`?"},
        Wrong{"position > 2", "position", "write `position.z`"},
        Wrong{"orientation > 2", "orientation", "components re, i, j, k: write `orientation.k`"},
        Wrong{"position.q > 2", "position.q", "no field"}, Wrong{"type == ", "", "a value"},
        Wrong{"type == pose", "pose", "a message type such as 02"},
        Wrong{"segment == LeftHandd", "LeftHandd", "did you mean `LeftHand`?"},
        Wrong{"sample == \"five\"", "\"five\"", "a number"},
        Wrong{"sample contains \"5\"", "contains", "is not text"}, Wrong{"source > 5", ">", "is text"},
        Wrong{"source == \"1", "\"1", "closing quote"}, Wrong{"type = 2", "=", "Compare with `==`."},
        Wrong{"gap & duplicate", "&", "`&&`"}, Wrong{"(type == 2", "", "`)`"},
        Wrong{"type == 2)", ")", "`&&` or `||`"}, Wrong{"type == 2 type == 3", "type", "`&&` or `||`"},
        Wrong{"type in {1, 2", "", "`,` or `}`"}, Wrong{"type in {}", "}", "a value"},
        Wrong{"sample in 9..3", "9..3", "ends before it begins"}, Wrong{"sample in", "", "a set such as"},
        Wrong{"text matches \"(\"", "\"(\"", "regular expression"},
        Wrong{"transport == ftp", "ftp", "udp, tcp"}, Wrong{"duplicate == maybe", "maybe", "true or false"},
        Wrong{"utc > \"tomorrow\"", "\"tomorrow\"", "2026-01-31"}, Wrong{"größe == 1", "größe", "no field"},
        Wrong{"&& gap", "&&", "a field"}, Wrong{"tag < 3", "<", "Tags are text"}));

TEST(FilterLimits, RefusesTextsThatAreTooLong) {
    const auto filter = Filter::compile(std::string(Filter::kLongestText + 1, ' ') + "x");
    ASSERT_FALSE(filter);
    EXPECT_EQ(filter.error().offset, Filter::kLongestText);
}

TEST(FilterLimits, RefusesParenthesesThatAreTooDeep) {
    EXPECT_TRUE(Filter::compile(std::string(60, '(') + "gap" + std::string(60, ')')));
    EXPECT_FALSE(Filter::compile(std::string(2000, '(') + "gap" + std::string(2000, ')')));
    EXPECT_FALSE(Filter::compile(std::string(4000, '!') + "gap"));
}

} // namespace
} // namespace posewire::filter
