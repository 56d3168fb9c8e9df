// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stage/range.h"

#include <QDateTime>

#include <gtest/gtest.h>

#include <chrono>

namespace posewire::stage {
namespace {

using namespace std::chrono_literals;

log::WallTime local(const QString& text) {
    return log::WallTime(
        std::chrono::milliseconds(QDateTime::fromString(text, Qt::ISODateWithMs).toMSecsSinceEpoch()));
}

TEST(Range, ANumberIsSecondsFromTheBeginning) {
    const log::WallTime beginning = local("2026-11-26T23:30:00");
    EXPECT_EQ(momentAfter(beginning, "12.5"), 12'500ms);
    EXPECT_EQ(momentAfter(beginning, "0"), 0s);
    EXPECT_EQ(momentAfter(beginning, "31536000"), 31'536'000s);
    for (const char* text : {"x", "", "-1", "31536001", "nan", "inf", "+1", "25:00", "2026-13-01T10:30"}) {
        EXPECT_FALSE(momentAfter(beginning, text)) << text;
    }
    EXPECT_FALSE(wallTimeOf("12")) << "and not noon";
}

TEST(Range, ATimeOfDayIsTheNextFromAnHourBeforeTheBeginning) {
    const log::WallTime beginning = local("2026-11-26T23:30:05.250");
    EXPECT_EQ(momentAfter(beginning, "23:31"), 54'750ms);
    EXPECT_EQ(momentAfter(beginning, "23:30"), -5'250ms) << "a round time just before it";
    EXPECT_EQ(momentAfter(beginning, "22:31"), -(59min + 5'250ms));
    EXPECT_EQ(momentAfter(beginning, "01:30:05.5"), 2h + 250ms) << "on the next day";
    EXPECT_EQ(momentAfter(beginning, "22:30"), 23h - 5'250ms) << "on the next day";
    EXPECT_EQ(momentAfter(local("2026-11-26T00:10:00"), "23:50"), -20min) << "on the day before";
}

TEST(Range, ADateIsTakenAsItIs) {
    EXPECT_EQ(momentAfter(local("2026-11-26T23:30:00"), "2026-11-24T23:30:01"), -48h + 1s);
    EXPECT_EQ(wallTimeOf("2026-11-24T23:30"), local("2026-11-24T23:30:00"));
}

TEST(Range, ATimeOfDayWithoutABeginningIsTheNewest) {
    const QDateTime now = QDateTime::currentDateTime();
    for (const QTime time : {QTime(0, 0), QTime(12, 0), QTime(23, 59, 59)}) {
        const auto wall = wallTimeOf(time.toString(Qt::ISODate).toStdString());
        ASSERT_TRUE(wall);
        const log::Duration age =
            std::chrono::milliseconds(QDateTime::currentMSecsSinceEpoch()) - wall->time_since_epoch();
        EXPECT_GE(age, 0s) << now.toString().toStdString();
        EXPECT_LE(age, 25h);
    }
}

TEST(Range, HasTimesOfARecording) {
    const log::Stamp first(5s);
    const log::WallTime wall = local("2026-11-26T10:00:00");
    EXPECT_TRUE(Range().isAll());
    EXPECT_EQ(Range().times(first, wall), model::kAllTime);
    EXPECT_EQ((Range{"1", ""}.times(first, wall)), (model::TimeRange{first + 1s, model::kAllTime.to}));
    EXPECT_EQ((Range{"10:00:01", "2"}.times(first, wall)), (model::TimeRange{first + 1s, first + 2s}));
}

TEST(Range, IsReadInAnyOrderAndRefusedIfItIsNone) {
    const auto problem = [](std::vector<std::string> arguments) {
        usage::CommandLine line("tool", "", [] { return std::string(); });
        Range range;
        addRange(line.arguments(), range)[0].formerly("--from");
        arguments.insert(arguments.begin(), "tool");
        const auto parsed = line.parse(arguments);
        return parsed ? range.since + " to " + range.until : parsed.error().text;
    };
    EXPECT_EQ(problem({"--until", "11:00", "--since", "2"}), "2 to 11:00");
    EXPECT_EQ(problem({"--since", "23:00", "--until", "01:00"}), "23:00 to 01:00") << "over midnight";
    const std::string swapped = "tool: --since must be before --until; see tool --help\n";
    EXPECT_EQ(problem({"--since", "2", "--until", "2"}), swapped);
    EXPECT_EQ(problem({"--until", "1", "--from", "2"}), swapped);
    EXPECT_EQ(problem({"--until", "half"}).find("tool: --until: \"half\" is neither a number"), 0U);
}

} // namespace
} // namespace posewire::stage
