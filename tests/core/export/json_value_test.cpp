// SPDX-License-Identifier: MIT
#include "core/export/json_value.h"

#include <gtest/gtest.h>

#include <limits>

namespace posewire::exporting {
namespace {

TEST(JsonValue, WritesEveryKindInTheOrderOfItsKeys) {
    JsonValue value{{"zero", 0}, {"large", std::uint64_t{18446744073709551615U}}, {"half", 0.5}};
    value["text"] = "a\"b";
    value["yes"] = true;
    value["none"] = JsonValue();
    value["list"] = JsonValue::List{1, "two", JsonValue{{"three", 3}}};
    value["half"] = 0.25; // keeps its place
    EXPECT_EQ(value.text(), R"({"zero":0,"large":18446744073709551615,"half":0.25,"text":"a\"b","yes":true,)"
                            R"("none":null,"list":[1,"two",{"three":3}]})");
}

TEST(JsonValue, WritesFloatsWithTheDigitsOfTheirOwnPrecision) {
    EXPECT_EQ(JsonValue(0.1F).text(), "0.1");
    EXPECT_EQ(JsonValue(16777216.0F).text(), "16777216.0");
    EXPECT_EQ(JsonValue(std::numeric_limits<float>::infinity()).text(), "null");
    EXPECT_EQ(JsonValue(std::numeric_limits<double>::quiet_NaN()).text(), "null");
}

TEST(JsonValue, ReplacesBytesThatAreNotUtf8) {
    EXPECT_EQ(JsonValue(std::string("a\xff")).text(), "\"a\xEF\xBF\xBD\"");
}

TEST(JsonValue, IndentsWhereAsked) {
    EXPECT_EQ(JsonValue({{"a", 1}}).text(2), "{\n  \"a\": 1\n}");
}

} // namespace
} // namespace posewire::exporting
