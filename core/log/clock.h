// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"

namespace posewire::log {

/// The only way to the time. Both calls are safe from any thread.
class Clock {
public:
    virtual ~Clock() = default;

    /// Comparable with kernel receive stamps. May jump when the computer's clock is set.
    [[nodiscard]] virtual Stamp wall() const = 0;

    [[nodiscard]] virtual Moment monotonic() const = 0;
};

class SystemClock final : public Clock {
public:
    [[nodiscard]] Stamp wall() const override {
        return std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now());
    }
    [[nodiscard]] Moment monotonic() const override {
        return std::chrono::time_point_cast<Duration>(std::chrono::steady_clock::now());
    }
};

} // namespace posewire::log
