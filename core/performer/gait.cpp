// SPDX-License-Identifier: MIT
#include "core/performer/gait.h"

#include <array>
#include <cmath>
#include <numbers>

namespace posewire::performer {
namespace {

constexpr std::size_t kHarmonics = 8;

/// f = mean + sum of a_k cos(2 pi k phase) + b_k sin(2 pi k phase), degrees.
struct Harmonics {
    double mean;
    std::array<double, kHarmonics> a;
    std::array<double, kHarmonics> b;
};

constexpr Harmonics kPelvisTilt{kMeanPelvisTilt,
                                {0.016, 0.414, 0.005, 0.154, 0.006, -0.055, 0.002, -0.017},
                                {0.082, -0.719, 0.023, -0.025, 0.012, 0.056, 0.005, 0.026}};
constexpr Harmonics kPelvisObliquity{-0.014,
                                     {1.860, 0.022, -1.197, 0.008, -0.001, -0.004, 0.031, 0.005},
                                     {2.117, 0.041, 0.221, 0.021, -0.096, 0.014, -0.008, 0.002}};
constexpr Harmonics kPelvisRotation{-0.040,
                                    {3.742, 0.018, 0.331, 0.012, 0.264, 0.005, 0.035, -0.001},
                                    {2.108, 0.014, -0.386, 0.020, -0.054, 0.015, 0.059, 0.005}};
constexpr Harmonics kHipFlexion{18.442,
                                {20.877, -3.147, -0.092, -0.102, -0.267, -0.007, -0.038, 0.004},
                                {-3.197, -1.545, 1.618, -0.088, 0.264, 0.094, -0.001, 0.026}};
constexpr Harmonics kHipAdduction{-0.328,
                                  {0.483, -0.050, -1.594, 0.040, -0.168, -0.074, 0.043, -0.010},
                                  {4.942, -0.503, 0.464, 0.105, -0.159, 0.044, -0.045, -0.007}};
constexpr Harmonics kHipRotation{-1.870,
                                 {1.184, -1.059, -1.170, -0.086, 0.006, 0.017, 0.031, 0.043},
                                 {0.718, -0.665, 1.024, 0.493, 0.005, -0.088, -0.142, -0.179}};
constexpr Harmonics kKneeFlexion{22.874,
                                 {-1.905, -13.630, -0.707, -0.868, -0.545, 0.065, -0.042, 0.046},
                                 {-18.750, 7.009, 4.312, 0.627, 0.736, 0.202, 0.026, 0.036}};
constexpr Harmonics kAnkleDorsiflexion{0.748,
                                       {-2.048, 0.820, -4.602, 2.197, -0.526, 0.266, 0.523, -0.072},
                                       {7.084, -7.213, 0.848, 0.237, -1.374, 0.547, -0.494, -0.047}};

/// cos and sin of the multiples of one phase, shared by all curves.
struct Multiples {
    explicit Multiples(double phase) {
        const double angle = 2.0 * std::numbers::pi * phase;
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        cosines[0] = c;
        sines[0] = s;
        for (std::size_t k = 1; k < kHarmonics; ++k) {
            cosines[k] = cosines[k - 1] * c - sines[k - 1] * s;
            sines[k] = sines[k - 1] * c + cosines[k - 1] * s;
        }
    }

    double of(const Harmonics& curve) const {
        double sum = curve.mean;
        for (std::size_t k = 0; k < kHarmonics; ++k) {
            sum += curve.a[k] * cosines[k] + curve.b[k] * sines[k];
        }
        return sum;
    }

    std::array<double, kHarmonics> cosines{};
    std::array<double, kHarmonics> sines{};
};

} // namespace

GaitAngles gaitAngles(double phase) {
    const Multiples multiples(phase);
    return {multiples.of(kPelvisTilt),  multiples.of(kPelvisObliquity),  multiples.of(kPelvisRotation),
            multiples.of(kHipFlexion),  multiples.of(kHipAdduction),     multiples.of(kHipRotation),
            multiples.of(kKneeFlexion), multiples.of(kAnkleDorsiflexion)};
}

} // namespace posewire::performer
