// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/clock_history.h"

#include "core/model/session/ingest.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace posewire::gui {

namespace {

constexpr log::Duration kWindow = std::chrono::seconds(60);
constexpr std::size_t kMostReadings = 20'000;
constexpr double kMsPerDay = 86'400'000;
/// Milliseconds are cut, and senders sample their clock with some unrest.
constexpr double kLeastJumpMs = 20;

/// Poses first, since they are what the operator looks at; any other sampled type has the same header.
constexpr std::array<std::uint8_t, 11> kClockTypes{2, 1, 5, 21, 22, 23, 20, 24, 25, 3, 4};

std::uint8_t clockType(model::SessionView& view, const model::CharacterKey& key) {
    for (const std::uint8_t type : kClockTypes) {
        if (view.find(log::StreamKey{key.sender, key.character, type}) != nullptr) {
            return type;
        }
    }
    return 0;
}

/// "HH:MM:SS.mmm" as milliseconds of the day.
std::optional<double> millisecondsOf(std::string_view text) {
    int hours = 0;
    int minutes = 0;
    int seconds = 0;
    int milliseconds = 0;
    const auto read = [&](std::size_t at, std::size_t length, int& value) {
        const char* end = text.data() + at + length;
        return std::from_chars(text.data() + at, end, value).ptr == end;
    };
    if (text.size() != 12 || text[2] != ':' || text[5] != ':' || text[8] != '.' || !read(0, 2, hours) ||
        !read(3, 2, minutes) || !read(6, 2, seconds) || !read(9, 3, milliseconds)) {
        return std::nullopt;
    }
    return ((hours * 60.0 + minutes) * 60.0 + seconds) * 1000.0 + milliseconds;
}

} // namespace

void ClockHistory::follow(model::SessionView& view, const std::optional<model::CharacterKey>& key) {
    const std::uint8_t type = key ? clockType(view, *key) : std::uint8_t{0};
    const auto* newest = type == 0 ? nullptr : view.message(*key, type);
    const bool wentBack = newest != nullptr && newest->stamp < lastStamp();
    if (key != m_key || type != m_type || wentBack) {
        *this = {};
        m_key = key;
        m_type = type;
    }
    if (newest == nullptr) {
        return;
    }
    const log::Stamp from = std::max(newest->stamp - kWindow, lastStamp() + log::Duration(1));
    const std::size_t added =
        view.visit({key->sender, key->character, type}, from, kMostReadings, [this](const auto& message) {
            add({message.stamp, message.datagram.header.sampleCounter, message.datagram.header.timeCode});
        });
    if (added != 0) {
        m_drift = fitDrift();
    }
    readType25(view);
}

void ClockHistory::add(const Reading& reading) {
    if (!m_readings.empty()) {
        findJump(reading);
    }
    m_rate.add(reading.sample, reading.timeCode);
    m_readings.push_back(reading);
    while (reading.stamp - m_readings.front().stamp > kWindow || m_readings.size() > kMostReadings) {
        m_readings.pop_front();
    }
}

void ClockHistory::findJump(const Reading& reading) {
    const Reading& before = m_readings.back();
    const auto samples = static_cast<std::int32_t>(reading.sample - before.sample);
    const auto advanced = static_cast<std::int32_t>(reading.timeCode - before.timeCode);
    const auto hz = m_rate.frameHz();
    // A restarted counter says nothing about time: then the receive stamps have to do.
    const bool byStamps = samples < 0 || !hz;
    const double expected =
        byStamps ? log::millisecondsOf(reading.stamp - before.stamp) : samples * 1000.0 / *hz;
    const double difference = advanced - expected;
    const double tolerance = byStamps ? 250.0 : std::max(kLeastJumpMs, hz ? 3000.0 / *hz : 0.0);
    if (std::abs(difference) > tolerance) {
        m_jump = {difference, reading.stamp};
        m_readings.clear();
        m_rate = {};
    }
}

void ClockHistory::readType25(model::SessionView& view) {
    const auto* message = view.message(*m_key, wire::TimeCode::kType);
    const auto* code = message == nullptr ? nullptr : std::get_if<wire::TimeCode>(&message->datagram.body);
    const auto wall = code == nullptr ? std::nullopt : millisecondsOf(code->view());
    if (!wall) {
        m_type25.reset();
        m_offsetMs.reset();
        return;
    }
    m_type25 = std::string(code->view());
    m_offsetMs = std::remainder(*wall - message->datagram.header.timeCode, kMsPerDay);
}

std::optional<std::uint32_t> ClockHistory::headerMs() const {
    return m_readings.empty() ? std::nullopt : std::optional(m_readings.back().timeCode);
}

double ClockHistory::observedSeconds() const {
    return m_readings.empty() ? 0.0 : log::secondsOf(m_readings.back().stamp - m_readings.front().stamp);
}

std::optional<ClockHistory::Drift> ClockHistory::fitDrift() const {
    if (observedSeconds() < kLeastDriftSeconds) {
        return std::nullopt;
    }
    const Reading& first = m_readings.front();
    double meanX = 0;
    double meanY = 0;
    const auto x = [&](const Reading& r) { return log::secondsOf(r.stamp - first.stamp); };
    const auto y = [&](const Reading& r) {
        return static_cast<std::int32_t>(r.timeCode - first.timeCode) * 1e-3 - x(r);
    };
    const auto count = static_cast<double>(m_readings.size());
    for (const Reading& reading : m_readings) {
        meanX += x(reading) / count;
        meanY += y(reading) / count;
    }
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (const Reading& reading : m_readings) {
        const double dx = x(reading) - meanX;
        const double dy = y(reading) - meanY;
        xx += dx * dx;
        xy += dx * dy;
        yy += dy * dy;
    }
    const double slope = xy / xx;
    const double variance = std::max(0.0, yy - slope * xy) / std::max(1.0, count - 2);
    return Drift{slope * 1e6, std::sqrt(variance / xx) * 1e6};
}

} // namespace posewire::gui
