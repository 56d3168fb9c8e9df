// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"

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
    explicit ClockFit(log::Duration span);

    /// In the order of time.
    void add(log::Stamp stamp, double differenceMs);
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
    log::Duration m_width; ///< of a part
    bool m_hasFirst = false;
    log::Stamp m_first{};
    double m_firstMs = 0;
    std::int64_t m_part = 0; ///< number of the one that is being looked at, and its least delayed sample
    log::Stamp m_least{};
    double m_leastMs = 0;
    Sums m_sums; ///< of the parts before it, relative to the first sample
};

} // namespace posewire::model
