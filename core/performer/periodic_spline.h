// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace posewire::performer {

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

} // namespace posewire::performer
