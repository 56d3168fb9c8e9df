// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/fault_settings.h"
#include "core/performer/noise.h"

namespace posewire::performer {

/// Which datagrams of one sender a network loses: single ones, bursts, or after Gilbert and Elliott.
class LossPattern {
public:
    LossPattern(const FaultSettings& settings, const KeyedRandom& random);

    /// Whether the next datagram is lost. Call it once for each, in order.
    bool loses();

private:
    bool losesByState();

    KeyedRandom m_random;
    double m_burstChance; ///< of a burst to begin
    int m_burst;
    int m_leftOfBurst = 0;
    std::optional<GilbertElliott> m_model;
    bool m_isBad = false;
    std::uint64_t m_asked = 0;
};

} // namespace posewire::performer
