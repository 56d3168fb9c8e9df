// SPDX-License-Identifier: MIT
#include "core/export/json_value.h"

#include <gtest/gtest.h>

#include <limits>

namespace posewire::exporting {
namespace {

TEST(JsonValue, WritesFloatsWithTheDigitsOfTheirOwnPrecision) {
    EXPECT_EQ(jsonText(floatJson(0.1F)), "0.1");
    EXPECT_EQ(jsonText(floatJson(16777216.0F)), "16777216.0");
    EXPECT_EQ(jsonText(floatJson(std::numeric_limits<float>::infinity())), "null");
    EXPECT_EQ(jsonText(std::numeric_limits<double>::quiet_NaN()), "null");
}

TEST(JsonValue, ReplacesBytesThatAreNotUtf8) {
    EXPECT_EQ(jsonText("a\xff"), "\"a\xEF\xBF\xBD\"");
}

TEST(JsonValue, IndentsWhereAsked) {
    EXPECT_EQ(jsonText({{"a", 1}}, 2), "{\n  \"a\": 1\n}");
}

} // namespace
} // namespace posewire::exporting
