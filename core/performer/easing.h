// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace posewire::performer {

/// 0 at `from`, 1 at `to`, with first and second derivative zero at both ends.
inline double smoothStep(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * t * (t * (6.0 * t - 15.0) + 10.0);
}

/// 1 inside [on, off], easing over `width` before and after.
inline double smoothWindow(double on, double off, double width, double x) {
    return smoothStep(on - width, on, x) * (1.0 - smoothStep(off, off + width, x));
}

/// max(x, 0) with its corner rounded over about `softness`; half of that at 0.
inline double smoothPositive(double x, double softness) {
    return 0.5 * (x + std::sqrt(x * x + softness * softness));
}

/// The fractional part, in [0, 1).
inline double fraction(double x) {
    return x - std::floor(x);
}

} // namespace posewire::performer
