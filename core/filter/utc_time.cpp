// SPDX-License-Identifier: MIT
#include "core/filter/utc_time.h"

#include <charconv>
#include <chrono>

namespace posewire::filter {
namespace {

/// Reads a number of that many digits, after `before` unless that is 0.
bool take(std::string_view& text, char before, std::size_t digits, int& value) {
    const std::size_t skipped = before != 0 ? 1 : 0;
    if (text.size() < skipped + digits || (before != 0 && text.front() != before)) {
        return false;
    }
    const char* begin = text.data() + skipped;
    const bool isNumber =
        std::from_chars(begin, begin + digits, value).ptr == begin + digits && *begin != '-';
    text.remove_prefix(skipped + digits);
    return isNumber;
}

/// Seconds of "12:00", "12:00:00" or "12:00:00.25".
std::optional<double> timeOfDay(std::string_view text) {
    int hour = 0;
    int minute = 0;
    int second = 0;
    double fraction = 0;
    if (!take(text, 0, 2, hour) || !take(text, ':', 2, minute) || hour > 24 || minute > 59) {
        return std::nullopt;
    }
    if (!text.empty() && (!take(text, ':', 2, second) || second > 60)) {
        return std::nullopt;
    }
    if (text.starts_with('.') && text.size() > 1) {
        const char* end = text.data() + text.size();
        const auto format = std::chars_format::fixed;
        text.remove_prefix(std::from_chars(text.data(), end, fraction, format).ptr == end ? text.size() : 0);
    }
    return text.empty() ? std::optional(hour * 3600.0 + minute * 60.0 + second + fraction) : std::nullopt;
}

} // namespace

std::optional<double> utcSeconds(std::string_view text) {
    int year = 0;
    int month = 0;
    int day = 0;
    if (!take(text, 0, 4, year) || !take(text, '-', 2, month) || !take(text, '-', 2, day)) {
        return std::nullopt;
    }
    const std::chrono::year_month_day date{std::chrono::year(year),
                                           std::chrono::month(static_cast<unsigned>(month)),
                                           std::chrono::day(static_cast<unsigned>(day))};
    if (!date.ok()) {
        return std::nullopt;
    }
    const double midnight =
        static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count()) * 86400.0;
    if (text.ends_with('Z')) {
        text.remove_suffix(1);
    }
    if (text.empty()) {
        return midnight;
    }
    const bool isSeparated = text.front() == 'T' || text.front() == ' ';
    const auto seconds = isSeparated ? timeOfDay(text.substr(1)) : std::nullopt;
    return seconds ? std::optional(midnight + *seconds) : std::nullopt;
}

} // namespace posewire::filter
