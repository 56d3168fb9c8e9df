// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"

namespace posewire::log {

/// The only way to the time. Both calls are safe from any thread.
class Clock {
public:
    virtual ~Clock() = default;

    /// Comparable with kernel receive stamps. Jumps when the computer's clock is set.
    [[nodiscard]] virtual WallTime wall() const = 0;

    /// Never jumps; goes on while the computer sleeps, where the system can tell.
    [[nodiscard]] virtual Moment monotonic() const = 0;
};

class SystemClock final : public Clock {
public:
    [[nodiscard]] WallTime wall() const override;
    [[nodiscard]] Moment monotonic() const override;
};

} // namespace posewire::log
