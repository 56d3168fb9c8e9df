// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/accounting/stream_figures.h"

#include <optional>

namespace posewire::model {

/// Which moment is shown when, while the past is played. It is reckoned from the beginning each time, so that
/// nothing adds up.
class Playback {
public:
    /// Times as fast as it was, either way.
    static constexpr double kSlowest = 0.05;
    static constexpr double kFastest = 16;

    /// Begins at `from`, which `now` is for. A `speed` below 0 goes back; beyond the slowest and the fastest
    /// it is one of these. With a `loop` it stays within that, and begins again at its other end.
    Playback(log::Stamp from, log::Moment now, double speed, const std::optional<TimeRange>& loop = {});

    [[nodiscard]] double speed() const { return m_speed; }
    [[nodiscard]] log::Stamp at(log::Moment now) const;

private:
    log::Stamp m_from;
    log::Moment m_begin;
    double m_speed;
    std::optional<TimeRange> m_loop;
};

} // namespace posewire::model
