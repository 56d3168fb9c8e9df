// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace posewire::performer {

/// Loss in two states (Gilbert 1960, Elliott 1963): a good one and a bad one, drawn for each datagram.
struct GilbertElliott {
    double toBad = 0.0;        ///< p: chance to go from good to bad
    double toGood = 1.0;       ///< r: chance to come back
    double passesInGood = 1.0; ///< k: chance of a datagram to pass in the good state
    double passesInBad = 0.0;  ///< h: and in the bad one
};

/// What goes wrong between a sender and the network. Probabilities are per datagram; times are seconds after
/// the start.
struct FaultSettings {
    std::uint64_t seed = 1; ///< the same seed gives the same faults
    double rateHz = 240.0;  ///< of the samples, before any reduction

    double drop = 0.0;
    int burst = 1; ///< datagrams lost one after another each time
    std::optional<GilbertElliott> gilbertElliott;
    double duplicate = 0.0;
    double reorder = 0.0;
    double corrupt = 0.0;
    double truncate = 0.0;
    double delayMs = 0.0;  ///< of every datagram
    double jitterMs = 0.0; ///< up to so much more, evenly distributed
    bool splits = false;   ///< samples of several items go in two to four datagrams

    struct Restart {
        double atSeconds = 0.0;
        std::uint32_t firstSample = 1;
    };
    std::optional<Restart> restart; ///< the sample counter restarts
    struct Pause {
        double atSeconds = 0.0;
        double seconds = 0.0;
    };
    std::optional<Pause> pause; ///< nothing is sent; the capture and its counter run on
    struct Reduction {
        double atSeconds = 0.0;
        std::uint32_t step = 2;
    };
    std::optional<Reduction> reduction; ///< from then on every step-th sample
};

/// What is wrong with the settings, as one sentence; empty when Faults can be made of them.
std::optional<std::string> findProblem(const FaultSettings& settings);

} // namespace posewire::performer
