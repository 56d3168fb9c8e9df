// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"

#include <ctime>

namespace posewire::log {

/// The only source of the time. Both calls are safe from any thread.
class Clock {
public:
    virtual ~Clock() = default;

    /// Comparable with kernel receive stamps. Jumps when the computer's clock is set.
    [[nodiscard]] virtual WallTime wall() const = 0;

    /// Never jumps; runs on while the computer sleeps, if the system supports that.
    [[nodiscard]] virtual Moment monotonic() const = 0;
};

class SystemClock final : public Clock {
public:
    [[nodiscard]] WallTime wall() const override;
    [[nodiscard]] Moment monotonic() const override;
};

/// In the local time zone; from any thread.
[[nodiscard]] std::tm localTime(std::time_t time);

} // namespace posewire::log
