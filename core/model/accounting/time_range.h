// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace posewire::model {

/// Stamps in nanoseconds; the end does not belong to it.
struct TimeRange {
    std::int64_t fromNs = 0;
    std::int64_t toNs = 0;

    [[nodiscard]] double seconds() const { return static_cast<double>(toNs - fromNs) * 1e-9; }
    friend bool operator==(const TimeRange&, const TimeRange&) = default;
};

/// The time that figures are of: all of it, so much before the cursor, or between two stamps.
struct RangeChoice {
    std::int64_t lastNs = 0; ///< above 0: so much before the cursor
    std::optional<TimeRange> fixed{};

    [[nodiscard]] bool isAll() const { return lastNs <= 0 && !fixed; }
    friend bool operator==(const RangeChoice&, const RangeChoice&) = default;
};

} // namespace posewire::model
