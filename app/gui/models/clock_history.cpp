// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/clock_history.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/accounting/probation.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

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

std::optional<log::StreamKey> clockStream(model::SessionView& view, const model::CharacterKey& key) {
    for (const std::uint8_t type : kClockTypes) {
        const log::StreamKey stream{key.sender, key.character, type};
        if (view.roster().find(stream) != nullptr) {
            return stream;
        }
    }
    return std::nullopt;
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

PropertyValue header(const ClockHistory& clock) {
    const auto milliseconds = clock.headerMs();
    return {milliseconds ? tr("%1 · %2 ms").arg(milliClock(*milliseconds), grouped(*milliseconds)) : dash(),
            Health::Unknown,
            tr("Time code of every header: since the start of a recording, or the sender's time "
               "of day when live")};
}

PropertyValue type25(const ClockHistory& clock) {
    return {clock.type25() ? shownText(*clock.type25()) : tr("not on the air"), Health::Unknown,
            tr("Wall clock that the sender sends as text. In MVN: Network Streamer > Time Code (type 25)")};
}

PropertyValue offset(const ClockHistory& clock) {
    return {clock.offsetMs() ? clockDifference(*clock.offsetMs()) : dash(), Health::Unknown,
            tr("Type 25 minus the header time code of the same datagram")};
}

PropertyValue drift(const ClockHistory& clock) {
    const auto& found = clock.drift();
    const QString none = clock.headerMs() ? tr("not yet known") : dash();
    constexpr double kLeastShown = 0.05;
    const bool isSeen = found && std::abs(found->skewPpm) >= kLeastShown;
    const QString text =
        !found   ? none
        : isSeen ? tr("%1 ± %2 ppm").arg(signedFixed(found->skewPpm, 1), fixed(found->errorPpm, 1))
                 : tr("none, ± %1 ppm").arg(fixed(found->errorPpm, 1));
    return {text, Health::Unknown,
            tr("How much faster the sender's header clock runs than this computer's, by the least delayed "
               "samples of the last minute, ± its standard error. Not known as long as delays on the way "
               "hide it.")};
}

PropertyValue frameRate(const ClockHistory& clock) {
    const auto hz = clock.frameHz();
    return {hz ? tr("%1 Hz").arg(fixed(*hz, 2)) : dash(), Health::Unknown,
            tr("How far the sample counter moves on in a second of the sender's time code")};
}

PropertyValue lastJump(const ClockHistory& clock) {
    const auto& jump = clock.lastJump();
    const QString none = clock.headerMs() ? tr("none") : dash();
    return {jump ? tr("%1 at %2").arg(clockDifference(jump->milliseconds), timeOfDay(jump->time).chopped(4))
                 : none,
            jump ? Health::Warning : Health::Unknown,
            tr("The newest place where the time code did not advance with its samples, and when it "
               "was received")};
}

} // namespace

void ClockHistory::follow(model::SessionView& view, const std::optional<model::CharacterKey>& key) {
    const auto stream = key ? clockStream(view, *key) : std::nullopt;
    const log::Stamp newest = stream ? view.messages().newestStamp(*stream) : log::Stamp();
    if (stream != m_stream || newest < m_lastStamp) {
        *this = {};
        m_stream = stream;
    }
    if (newest == log::Stamp()) {
        return;
    }
    const log::Stamp from = std::max(newest - kWindow, m_lastStamp + log::Duration(1));
    m_lastStamp = newest;
    view.messages().visitHeaders(*stream, from, kMostReadings,
                                 [this](log::Stamp stamp, const wire::Header& header) {
                                     add({stamp, header.sampleCounter, header.timeCode});
                                 });
    const model::ClockSkew skew =
        view.roster()
            .find(*stream)
            ->accounting.clock(model::TimeRange{newest - kWindow, newest + log::Duration(1)})
            .skew;
    m_drift = skew.isKnown() ? std::optional(skew) : std::nullopt;
    if (m_jump) {
        m_jump->time = view.wallOf(m_jump->stamp);
    }
    readType25(view.messages().message(*key, wire::TimeCode::kType));
}

void ClockHistory::add(const Reading& reading) {
    if (m_newest) {
        const auto ahead = static_cast<std::int32_t>(reading.sample - m_newest->sample);
        if (ahead <= 0 && ahead >= -model::Probation::kMostBack) {
            return; // out of order, or again: no evidence of the clock
        }
        const bool isFar = ahead < 0 || ahead > model::Probation::kMostForward;
        if (isFar && isStraggler(reading)) {
            return;
        }
        m_doubtful.clear();
        if (isCorrupt(reading)) {
            return;
        }
    }
    m_rate.add(reading.sample, reading.timeCode);
    m_newest = reading;
}

/// One from far away is, until so many in a row agree that the counter restarted there.
bool ClockHistory::isStraggler(const Reading& reading) {
    constexpr std::size_t kAgreeing = 8;
    const bool agrees = !m_doubtful.empty() &&
                        std::abs(static_cast<std::int32_t>(reading.sample - m_doubtful.back().sample)) <=
                            model::Probation::kMostBack;
    if (!agrees) {
        m_doubtful.clear();
    }
    m_doubtful.push_back(reading);
    return m_doubtful.size() < kAgreeing;
}

/// In ms; nothing if it advanced with the samples.
std::optional<double> ClockHistory::jumpBetween(const Reading& before, const Reading& reading) const {
    const auto samples = static_cast<std::int32_t>(reading.sample - before.sample);
    const auto advanced = model::timeCodeStep(before.timeCode, reading.timeCode);
    const auto hz = m_rate.frameHz();
    // A restarted counter says nothing about time: then the receive stamps have to do.
    const bool byStamps = samples < 0 || !hz;
    const double expected =
        byStamps ? log::millisecondsOf(reading.stamp - before.stamp) : samples * 1000.0 / *hz;
    const double difference = advanced - expected;
    const double tolerance = byStamps ? 250.0 : std::max(kLeastJumpMs, hz ? 3000.0 / *hz : 0.0);
    return std::abs(difference) > tolerance ? std::optional(difference) : std::nullopt;
}

/// One time code that is off is, until the next agrees with it; or where none in a row agrees with any.
bool ClockHistory::isCorrupt(const Reading& reading) {
    constexpr std::size_t kMostCorrupt = 8;
    if (!jumpBetween(*m_newest, reading)) {
        m_jumped.clear();
        return false;
    }
    const bool agrees = !m_jumped.empty() && !jumpBetween(m_jumped.back(), reading);
    if (!agrees && m_jumped.size() < kMostCorrupt) {
        m_jumped.push_back(reading);
        return true;
    }
    const Reading first = agrees ? m_jumped.back() : reading;
    m_jump = {jumpBetween(*m_newest, first).value_or(0), first.stamp};
    m_newest.reset();
    m_jumped.clear();
    m_rate = {};
    if (agrees) {
        m_rate.add(first.sample, first.timeCode);
        m_newest = first;
    }
    return false;
}

void ClockHistory::readType25(const model::Message* message) {
    const auto* code = message == nullptr ? nullptr : std::get_if<wire::TimeCode>(&message->datagram.body);
    const auto wall = code == nullptr ? std::nullopt : millisecondsOf(code->view());
    m_type25.reset();
    m_offsetMs.reset();
    if (wall) {
        m_type25 = std::string(code->view());
        m_offsetMs = std::remainder(*wall - message->datagram.header.timeCode, kMsPerDay);
    }
}

std::optional<std::uint32_t> ClockHistory::headerMs() const {
    return m_newest ? std::optional(m_newest->timeCode) : std::nullopt;
}

QString clockText(const ClockHistory& clock, ClockChoice choice) {
    const QString none = QStringLiteral("--:--:--.---");
    if (choice == ClockChoice::Type25) {
        return clock.type25() ? shownText(*clock.type25()) : none;
    }
    return clock.headerMs() ? milliClock(*clock.headerMs()) : none;
}

std::vector<Property> clockFacts(const ClockHistory& clock) {
    return propertiesOf(clock, {{tr("Header"), header},
                                {tr("Type 25"), type25},
                                {tr("Offset"), offset},
                                {tr("Drift"), drift},
                                {tr("Frame rate"), frameRate},
                                {tr("Last jump"), lastJump}});
}

} // namespace posewire::gui
