// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>

namespace posewire::performer {

/// Random numbers by key: the same seed and key always give the same number, whatever the order of the calls.
class KeyedRandom {
public:
    explicit KeyedRandom(std::uint64_t seed) : m_seed(seed) {}

    /// An independent source for a part, such as a character.
    KeyedRandom fork(std::uint64_t key) const { return KeyedRandom(bits(key)); }

    std::uint64_t bits(std::uint64_t key) const;
    /// In [0, 1).
    double uniform(std::uint64_t key) const;
    double uniform(std::uint64_t key, double from, double to) const {
        return from + (to - from) * uniform(key);
    }
    /// Three independent numbers with mean 0 and variance 1, close to normal (sums of four uniform ones).
    Eigen::Vector3d normal3(std::uint64_t key) const;

private:
    std::uint64_t m_seed;
};

/// Slow wandering with more power at low frequencies (about 1/f): a sum of sines with random phases, smooth
/// in all derivatives. Root mean square about `amplitude`.
class Wander {
public:
    Wander() = default;
    Wander(const KeyedRandom& random, double lowestHz, double highestHz, double amplitude);

    double at(double seconds) const;

private:
    static constexpr std::size_t kSines = 6;
    struct Sine {
        double radiansPerSecond = 0.0;
        double phase = 0.0;
        double amplitude = 0.0;
    };
    std::array<Sine, kSines> m_sines{};
};

} // namespace posewire::performer
