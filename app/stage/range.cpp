// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stage/range.h"

#include <QDateTime>

#include <charconv>
#include <cmath>

namespace posewire::stage {
namespace {

/// From 0 to those of a year.
std::optional<log::Duration> secondsIn(const std::string& text) {
    double seconds = 0.0;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, seconds);
    const bool isGood =
        read.ec == std::errc{} && read.ptr == end && seconds >= 0.0 && seconds <= 31'536'000.0;
    return isGood ? std::optional(log::Duration(std::llround(seconds * 1e9))) : std::nullopt;
}

/// A time of day is the first one from `earliest` on.
std::optional<log::WallTime> timeFrom(const QDateTime& earliest, const std::string& text) {
    QDateTime time = QDateTime::fromString(QString::fromStdString(text), Qt::ISODateWithMs);
    if (const QTime ofDay = QTime::fromString(QString::fromStdString(text), Qt::ISODateWithMs);
        ofDay.isValid() && !time.isValid()) {
        time = QDateTime(earliest.date(), ofDay);
        time = time < earliest ? time.addDays(1) : time;
    }
    return time.isValid() ? std::optional(log::WallTime(std::chrono::milliseconds(time.toMSecsSinceEpoch())))
                          : std::nullopt;
}

usage::Reading into(std::string Range::*place, const std::string& option, Range& range) {
    return [place, option, &range](const std::string& text) -> std::string {
        range.*place = text;
        const auto begin = secondsIn(range.since);
        const auto end = secondsIn(range.until);
        if (begin && end && *begin >= *end) {
            return "--since must be before --until";
        }
        return momentAfter({}, text) ? ""
                                     : option + ": \"" + text +
                                           "\" is neither a number from 0 to 31536000 nor a time such as "
                                           "10:30, 10:30:15 or 2026-11-26T10:30";
    };
}

} // namespace

model::TimeRange Range::times(log::Stamp first, log::WallTime wall) const {
    const auto begin = momentAfter(wall, since);
    const auto end = momentAfter(wall, until);
    return {begin ? first + *begin : model::kAllTime.from, end ? first + *end : model::kAllTime.to};
}

std::array<usage::DeclaredOption, 2> addRange(usage::Arguments arguments, Range& range) {
    return {arguments.read("--since TIME", into(&Range::since, "--since", range),
                           "begin there: seconds after the first datagram, or a time: 10:30, 10:30:15, or "
                           "2026-11-26T10:30"),
            arguments.read("--until TIME", into(&Range::until, "--until", range), "end there, likewise")};
}

std::optional<log::WallTime> wallTimeOf(const std::string& text) {
    return secondsIn(text) ? std::nullopt : timeFrom(QDateTime::currentDateTime().addDays(-1), text);
}

std::optional<log::Duration> momentAfter(log::WallTime beginning, const std::string& text) {
    if (const auto seconds = secondsIn(text)) {
        return seconds;
    }
    const auto early = std::chrono::floor<std::chrono::milliseconds>(beginning) - std::chrono::hours(1);
    const auto time = timeFrom(QDateTime::fromMSecsSinceEpoch(early.time_since_epoch().count()), text);
    return time ? std::optional(*time - beginning) : std::nullopt;
}

} // namespace posewire::stage
