// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

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

/// A curve through equally spaced samples that closes on itself: a uniform cubic B-spline, so first and
/// second derivative are continuous everywhere. `Value` is double or a fixed-size Eigen vector.
template <typename Value>
class PeriodicSpline {
public:
    PeriodicSpline() = default;

    /// `samples` at phase 0, 1/n, 2/n …; at least 8 of them.
    explicit PeriodicSpline(std::vector<Value> samples) : m_coefficients(std::move(samples)) { prefilter(); }

    /// At any phase; 1 is one period.
    Value at(double phase) const {
        const auto size = static_cast<double>(m_coefficients.size());
        const double place = (phase - std::floor(phase)) * size;
        const double whole = std::floor(place);
        const double t = place - whole;
        const double s = 1.0 - t;
        const std::size_t n = m_coefficients.size();
        const std::size_t i = static_cast<std::size_t>(whole) % n;
        const double w0 = s * s * s / 6.0;
        const double w1 = (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0;
        const double w2 = (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0;
        const double w3 = t * t * t / 6.0;
        return Value(w0 * m_coefficients[(i + n - 1) % n] + w1 * m_coefficients[i] +
                     w2 * m_coefficients[(i + 1) % n] + w3 * m_coefficients[(i + 2) % n]);
    }

private:
    /// Samples to B-spline coefficients by the recursive filter with pole sqrt(3) - 2 (Unser, Aldroubi and
    /// Eden 1993), run over two periods so that its start has died away.
    void prefilter() {
        const double pole = std::sqrt(3.0) - 2.0;
        const std::size_t n = m_coefficients.size();
        std::vector<Value>& c = m_coefficients;
        for (Value& value : c) {
            value = Value(6.0 * value);
        }
        const std::vector<Value> scaled = c;
        Value state = scaled[0];
        for (std::size_t step = 1; step < 2 * n; ++step) {
            state = Value(scaled[step % n] + pole * state);
            c[step % n] = state;
        }
        c[0] = Value(scaled[0] + pole * c[n - 1]);
        const std::vector<Value> causal = c;
        state = Value((pole / (pole * pole - 1.0)) * causal[n - 1]);
        for (std::size_t step = 1; step < 2 * n; ++step) {
            const std::size_t place = (2 * n - 1 - step) % n;
            state = Value(pole * (state - causal[place]));
            c[place] = state;
        }
        c[n - 1] = Value(pole * (c[0] - causal[n - 1]));
    }

    std::vector<Value> m_coefficients;
};

/// A place on the floor and the direction of the path there. Metres, radians.
struct PathPlace {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    double heading = 0.0;   ///< about z, from the x-axis
    double curvature = 0.0; ///< 1/m, left turns +
};

/// A lemniscate of Bernoulli with its crossing at `centre`, walked at even speed. Curvature grows evenly from
/// zero at the crossing to 3 / `halfWidth` at the far ends.
class FigureOfEight {
public:
    explicit FigureOfEight(double halfWidth, const Eigen::Vector2d& centre = Eigen::Vector2d::Zero());

    /// Length of one lap, in metres.
    double length() const { return m_length; }

    /// The place `distance` metres after the crossing (any number, taken modulo the length).
    PathPlace at(double distance) const;

private:
    double m_length = 0.0;
    PeriodicSpline<Eigen::Vector4d> m_places; ///< x, y, heading, curvature by share of the lap
};

} // namespace posewire::performer
