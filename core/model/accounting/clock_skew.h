// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace posewire::model {

/// How much faster the sender's clock goes than ours, and what that made; both 0 where it is not known.
struct ClockSkew {
    double skewPpm = 0;
    double driftMs = 0;
};

/// Fits a line to how far our clock is ahead of the sender's, by the least delayed sample of each of equal
/// parts of the time: the network only ever adds to what the clocks differ by. O(1) memory.
class ClockFit {
public:
    /// All that will be added spans so much time.
    explicit ClockFit(std::int64_t spanNs);

    /// In the order of time.
    void add(std::int64_t stampNs, double differenceMs);
    [[nodiscard]] ClockSkew skew() const;

private:
    struct Sums {
        std::size_t count = 0;
        double seconds = 0;
        double ms = 0;
        double squares = 0;
        double products = 0;
        void add(double atSeconds, double differenceMs);
    };
    std::int64_t m_partNs;
    bool m_hasFirst = false;
    std::int64_t m_firstNs = 0;
    double m_firstMs = 0;
    std::int64_t m_part = 0; ///< the one that is being looked at, and its least delayed sample
    std::int64_t m_leastNs = 0;
    double m_leastMs = 0;
    Sums m_sums; ///< of the parts before it, relative to the first sample
};

} // namespace posewire::model
