// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"

#include <optional>

namespace posewire::model {

/// The end does not belong to it.
struct TimeRange {
    log::Stamp from{};
    log::Stamp to{};

    [[nodiscard]] double seconds() const { return log::secondsOf(to - from); }
    friend bool operator==(const TimeRange&, const TimeRange&) = default;
};

/// The time that figures are of: all of it, so much before the cursor, or between two stamps.
struct RangeChoice {
    log::Duration last{}; ///< above 0: so much before the cursor
    std::optional<TimeRange> fixed{};

    [[nodiscard]] bool isAll() const { return last <= log::Duration::zero() && !fixed; }
    friend bool operator==(const RangeChoice&, const RangeChoice&) = default;
};

} // namespace posewire::model
