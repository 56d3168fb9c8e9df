// SPDX-License-Identifier: MIT
#include "core/model/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace posewire::model {
namespace {

TEST(Text, HasFixedDecimals) {
    EXPECT_EQ(fixedText(0, 0), "0");
    EXPECT_EQ(fixedText(0, 2), "0.00");
    EXPECT_EQ(fixedText(12.345678, 3), "12.346");
    EXPECT_EQ(fixedText(0.05, 1), "0.1");
    EXPECT_EQ(fixedText(-0.25, 2), "−0.25");
    EXPECT_EQ(fixedText(-0.004, 2), "0.00") << "nothing has no sign";
    EXPECT_EQ(fixedText(-1'684.5, 0), "−1684");
    EXPECT_EQ(millimetresText(0.012), "+12.0 mm");
}

TEST(Text, HasZerosInFront) {
    EXPECT_EQ(padded(7, 3), "007");
    EXPECT_EQ(padded(1'234, 3), "1234");
}

TEST(Text, HasNumbersOfAnySize) {
    EXPECT_EQ(fixedText(1e18, 2), "1000000000000000000.00");
    EXPECT_EQ(fixedText(-3e20, 1), "−300000000000000000000.0");
    EXPECT_EQ(fixedText(std::numeric_limits<double>::max(), 3).size(), 309U + 4);
    EXPECT_EQ(fixedText(1e-300, 3), "0.000");
    EXPECT_EQ(fixedText(std::nan(""), 3), "–");
    EXPECT_EQ(fixedText(-std::numeric_limits<double>::infinity(), 0), "–");
}

} // namespace
} // namespace posewire::model
