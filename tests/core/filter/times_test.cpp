// SPDX-License-Identifier: MIT
#include "tests/core/filter/filter_fixture.h"

#include <ctime>
#include <random>

namespace posewire::filter::test {
namespace {

/// A packet that came at a moment since 1970 UTC.
Case cameAt(log::Duration moment) {
    Case packet = golden("02_quaternion_counted");
    packet.packet.stamp = log::Stamp(moment);
    return packet;
}

std::string written(std::time_t seconds, const char* format) {
    const std::tm parts = *std::gmtime(&seconds);
    std::array<char, 64> text{};
    return {text.data(), std::strftime(text.data(), text.size(), format, &parts)};
}

bool isUtc(const std::string& text) {
    return Filter::compile("utc == \"" + text + '"').has_value();
}

TEST(FilterTime, ReadsEveryDateAsTheCalendarDoes) {
    std::mt19937_64 random{1970};
    std::uniform_int_distribution<std::int64_t> seconds(0, 4'102'444'799); // to the end of 2099
    for (std::size_t i = 0; i < 2'000; ++i) {
        const std::int64_t moment = seconds(random);
        const Case packet = cameAt(std::chrono::seconds(moment));
        for (const char* format :
             {"%Y-%m-%dT%H:%M:%S", "%Y-%m-%d %H:%M:%S", "%Y-%m-%dT%H:%M:%SZ", "%Y-%m-%dT%H:%M:%S.000"}) {
            const std::string text = written(moment, format);
            EXPECT_TRUE(matches(packet, "utc == \"" + text + '"')) << text << " is " << moment;
        }
        const std::string day = written(moment, "%Y-%m-%d");
        EXPECT_TRUE(matches(packet, "utc >= \"" + day + "\" && utc < \"" +
                                        written(moment - moment % 86'400 + 86'400, "%Y-%m-%dT%H:%M") + '"'))
            << day;
    }
}

TEST(FilterTime, ReadsFractionsOfASecond) {
    const Case packet = cameAt(1'769'817'600s + 250ms);
    EXPECT_TRUE(matches(packet, "utc == \"2026-01-31T00:00:00.25\""));
    EXPECT_TRUE(matches(packet, "utc == \"2026-01-31 00:00:00.250Z\""));
    EXPECT_TRUE(matches(packet, "utc in \"2026-01-31T00:00:00\"..\"2026-01-31T00:00:01\""));
    EXPECT_FALSE(matches(packet, "utc > \"2026-01-31T00:00:00.251\""));
    EXPECT_TRUE(matches(packet, "utc == 1769817600.25")) << "seconds since 1970 do as well";
}

TEST(FilterTime, RefusesWhatIsNoTime) {
    for (const char* text :
         {"2026-02-29", "2026-13-01", "2026-00-10", "2026-1-31", "2026-01-31T", "2026-01-31T25:00",
          "2026-01-31T23:60", "2026-01-31T24:01", "2026-01-31T12:00:61", "2026-01-31T12:00:00.",
          "2026-01-31T12:00:00.2x", "2026-01-31T12", "2026-01-31x12:00", "2026-01-31T-1:00", "31.1.2026",
          "12:00:00", ""}) {
        EXPECT_FALSE(isUtc(text)) << text;
    }
    EXPECT_TRUE(isUtc("2024-02-29"));
    EXPECT_TRUE(isUtc("2026-01-31T24:00")) << "midnight at the end of the day";
    EXPECT_TRUE(isUtc("2016-12-31T23:59:60")) << "a leap second";
}

TEST(FilterTime, CountsTimeFromTheFirstPacket) {
    const Case packet = golden("02_quaternion_counted"); // 2.5 s after the first
    EXPECT_TRUE(matches(packet, "time == 2.5 && time in 2..3"));
    EXPECT_FALSE(matches(packet, "time > 2.5 || time < 2.5"));
    EXPECT_FALSE(matches(packet, "delta >= 0")) << "nothing of its stream came before";
}

} // namespace
} // namespace posewire::filter::test
