// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/clock_history.h"
#include "app/gui/models/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace posewire::gui {

namespace {

QString plain(QString text) {
    return text.replace(QChar(0x202f), QLatin1Char(' '));
}

TEST(Text, SetsThousandsApart) {
    EXPECT_EQ(plain(grouped(0)), "0");
    EXPECT_EQ(plain(grouped(999)), "999");
    EXPECT_EQ(plain(grouped(153402)), "153 402");
    EXPECT_EQ(plain(grouped(1204881)), "1 204 881");
}

TEST(Text, WritesATrueMinusAndNoSignForZero) {
    EXPECT_EQ(fixed(-0.05, 2), QStringLiteral("−0.05"));
    EXPECT_EQ(fixed(-0.001, 2), QStringLiteral("0.00"));
    EXPECT_EQ(signedFixed(4.21, 1), QStringLiteral("+4.2"));
    EXPECT_EQ(signedFixed(0.01, 1), QStringLiteral("0.0"));
    EXPECT_EQ(fixed(std::numeric_limits<double>::quiet_NaN(), 1), QStringLiteral("–"));
    EXPECT_EQ(fixed(std::numeric_limits<double>::infinity(), 1), QStringLiteral("–"));
}

TEST(Text, WritesClocks) {
    EXPECT_EQ(milliClock(639'175), QStringLiteral("00:10:39.175"));
    EXPECT_EQ(milliClock(-1508), QStringLiteral("−00:00:01.508"));
    EXPECT_EQ(clockDifference(3.14), QStringLiteral("+3.1 ms"));
    EXPECT_EQ(clockDifference(-508.2), QStringLiteral("−508.2 ms"));
    EXPECT_EQ(clockDifference(-3'600'000), QStringLiteral("−01:00:00.000"));
    EXPECT_EQ(clockDifference(60'001), QStringLiteral("+00:01:00.001"));
}

TEST(Text, WritesDurationsToTheDigitThatMatters) {
    EXPECT_EQ(duration(0.43), QStringLiteral("0.4 s"));
    EXPECT_EQ(duration(59.9), QStringLiteral("59 s"));
    EXPECT_EQ(duration(720), QStringLiteral("12 min"));
    EXPECT_EQ(duration(10'900), QStringLiteral("3 h"));
}

} // namespace

} // namespace posewire::gui
