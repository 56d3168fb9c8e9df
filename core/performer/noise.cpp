// SPDX-License-Identifier: MIT
#include "core/performer/noise.h"

#include <cmath>
#include <numbers>

namespace posewire::performer {
namespace {

/// The finalizer of SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;

/// Four 16-bit parts added up: mean 2, variance 4/12, in units of a full part.
double normalFrom(std::uint64_t bits) {
    constexpr double kPart = 65536.0;
    double sum = 0.0;
    for (int part = 0; part < 4; ++part) {
        sum += (static_cast<double>((bits >> (16 * part)) & 0xffffU) + 0.5) / kPart;
    }
    return (sum - 2.0) * std::numbers::sqrt3;
}

} // namespace

std::uint64_t KeyedRandom::bits(std::uint64_t key) const {
    return mixed(mixed(m_seed + kGolden) + key * kGolden);
}

double KeyedRandom::uniform(std::uint64_t key) const {
    return static_cast<double>(bits(key) >> 11) * 0x1.0p-53;
}

Eigen::Vector3d KeyedRandom::normal3(std::uint64_t key) const {
    const std::uint64_t first = bits(key);
    const std::uint64_t second = mixed(first + kGolden);
    return {normalFrom(first), normalFrom(second), normalFrom(mixed(second + kGolden))};
}

Wander::Wander(const KeyedRandom& random, double lowestHz, double highestHz, double amplitude) {
    double power = 0.0;
    for (std::size_t index = 0; index < kSines; ++index) {
        const double share = (static_cast<double>(index) + random.uniform(2 * index)) / kSines;
        const double hertz = lowestHz * std::pow(highestHz / lowestHz, share);
        Sine& sine = m_sines[index];
        sine.radiansPerSecond = 2.0 * std::numbers::pi * hertz;
        sine.phase = random.uniform(2 * index + 1, 0.0, 2.0 * std::numbers::pi);
        sine.amplitude = 1.0 / std::sqrt(hertz);
        power += 0.5 * sine.amplitude * sine.amplitude;
    }
    for (Sine& sine : m_sines) {
        sine.amplitude *= amplitude / std::sqrt(power);
    }
}

double Wander::at(double seconds) const {
    double sum = 0.0;
    for (const Sine& sine : m_sines) {
        sum += sine.amplitude * std::sin(sine.radiansPerSecond * seconds + sine.phase);
    }
    return sum;
}

} // namespace posewire::performer
