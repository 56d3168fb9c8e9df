// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"

#include <cstdint>

namespace posewire::model {

/// Compares the sender's clock with ours. The sender's is the header time code where it advances with the
/// samples, else the sample counter times its own period. O(1) for each sample.
class SenderClock {
public:
    struct Sample {
        log::Stamp stamp{};
        std::uint32_t sample = 0;
        std::uint32_t timeCode = 0; ///< ms
    };
    /// The first datagram of a sample, in the order of arrival.
    void add(const Sample& sample);
    /// The counter restarted: nothing from before applies any more, except the jitter.
    void restart();

    [[nodiscard]] double jitterMs() const { return m_jitterMs; }
    /// Else the sample counter times its own period is the sender's clock.
    [[nodiscard]] bool isFromTimeCode() const { return m_timed > m_untimed; }
    /// At the newest sample, our clock minus the sender's time code, both since the first of its generation.
    [[nodiscard]] double differenceMs() const { return m_differenceMs; }
    /// Grows whenever what comes has nothing to do with what came.
    [[nodiscard]] std::uint32_t generation() const { return m_generation; }

private:
    bool m_hasFirst = false;
    Sample m_first;
    Sample m_previous;
    double m_jitterMs = 0;
    std::uint64_t m_timed = 0;   ///< successive samples whose time code advanced with them
    std::uint64_t m_untimed = 0; ///< successive samples whose time code did not
    double m_sumSinceMs = 0;     ///< between the successive samples of the period
    double m_sumMoved = 0;
    std::int64_t m_timeCodeMs = 0; ///< since the first sample, without wrap-around
    double m_differenceMs = 0;
    std::uint32_t m_generation = 0;
};

} // namespace posewire::model
