// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/stage/range.h"
#include "core/log/raw_pace.h"
#include "core/log/recording_file.h"
#include "core/log/timeline.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <utility>

namespace posewire::cli {

/// When the datagrams of a recording are due: by their stamps; without stamps by the senders' time codes; and
/// where those freeze or jump, one period per sample.
class DatagramPacer {
public:
    /// Only what lies in `range` is ever due; without stamps its times are seconds after the first datagram.
    DatagramPacer(double periodSeconds, double speed, stage::Range range = {})
        : m_period(std::chrono::duration<double>(periodSeconds)), m_speed(speed), m_range(std::move(range)) {}

    /// Time after the start at which the next datagram of the recording is due; nothing if it never is.
    std::optional<log::Duration> due(const log::FileRecord& record) {
        constexpr Nanoseconds longest{1e18}; // 31 years: more may not fit into a duration
        if (!std::exchange(m_hasBegun, true)) {
            const model::TimeRange times = m_range.times({}, record.time.value_or(log::WallTime()));
            m_from = std::max(times.from, log::Stamp()).time_since_epoch();
            m_until = times.to.time_since_epoch();
        }
        m_place = std::min(m_place + step(record), longest);
        if (m_place < m_from || isPast()) {
            return std::nullopt;
        }
        m_now = std::min(m_roundBegin + (m_place - m_from) / m_speed, longest);
        return std::chrono::duration_cast<log::Duration>(m_now);
    }

    /// Nothing more of this recording is due.
    [[nodiscard]] bool isPast() const { return m_place >= m_until; }

    /// The recording begins again, one period after what was due last.
    void beginAgain() {
        m_roundBegin = m_now + m_period / m_speed;
        m_place = {};
        m_clock = log::RecordedClock(m_timeline);
        m_stamp.reset();
        m_pace = log::RawPace(m_period);
    }

private:
    using Nanoseconds = log::RawPace::Nanoseconds;

    Nanoseconds step(const log::FileRecord& record) {
        if (record.time) {
            const log::Stamp stamp = m_clock.stampOf(*record.time, record.setBy);
            const log::Stamp before = m_stamp.value_or(stamp);
            m_stamp = stamp;
            return std::max(stamp - before, log::Duration::zero());
        }
        return m_pace.step(record.bytes);
    }

    Nanoseconds m_period;
    double m_speed;
    stage::Range m_range;
    bool m_hasBegun = false;
    Nanoseconds m_from{}; ///< after the first datagram, which says when that is
    Nanoseconds m_until{std::numeric_limits<double>::infinity()};
    Nanoseconds m_roundBegin{}; ///< since the start
    Nanoseconds m_place{};      ///< since the first datagram, as fast as it was recorded
    Nanoseconds m_now{};        ///< since the start
    log::Timeline m_timeline;
    log::RecordedClock m_clock{m_timeline};
    std::optional<log::Stamp> m_stamp;
    log::RawPace m_pace{m_period};
};

} // namespace posewire::cli
