// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/sample_step.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace posewire::model {

/// Rates and counts of one stream, from receive stamps alone. O(1) in time and memory for each packet.
class StreamStatistics {
public:
    /// Adds a datagram. `sample` is its sample counter, `beginsSample` true for the first datagram of a
    /// sample.
    void add(std::int64_t stampNs, std::size_t bytes, std::uint32_t sample, bool beginsSample);

    [[nodiscard]] std::uint64_t datagrams() const { return m_datagrams; }
    [[nodiscard]] std::uint64_t bytes() const { return m_bytes; }
    [[nodiscard]] std::int64_t firstStampNs() const { return m_firstStampNs; }
    [[nodiscard]] std::int64_t lastStampNs() const { return m_lastStampNs; }
    [[nodiscard]] std::uint32_t lastSample() const { return m_lastSample; }

    /// Samples a second over the window of the newest samples (at most 256 and at most about 2 s before the
    /// newest); 0 before the second sample.
    [[nodiscard]] double rateHz() const;
    /// Bytes a second over the same window.
    [[nodiscard]] double bytesPerSecond() const;

    /// Time between samples over the same window, in nanoseconds; zeros before the second sample.
    struct Spacing {
        double mean = 0;
        double deviation = 0;
        double least = 0;
        double most = 0;
    };
    [[nodiscard]] Spacing spacing() const;

    /// How often the sample counter moved on by something else than its usual step, which is the most
    /// frequent one of the last 64. Repeats of type 12 and 13 count no gaps, since their counter stands
    /// still.
    [[nodiscard]] std::uint64_t gaps() const { return m_gaps; }
    /// The usual step of the sample counter; 0 before it is known or where there is none.
    [[nodiscard]] std::uint32_t step() const { return m_step.value(); }

private:
    static constexpr std::size_t kWindow = 256;
    struct Arrival {
        std::int64_t stampNs;
        std::uint64_t bytesSoFar;
    };
    [[nodiscard]] std::size_t windowSize() const;
    [[nodiscard]] const Arrival& arrival(std::size_t back) const {
        return m_arrivals[(m_samples - 1 - back) % kWindow];
    }
    void addStep(std::uint32_t moved);

    std::uint64_t m_datagrams = 0;
    std::uint64_t m_bytes = 0;
    std::uint64_t m_samples = 0;
    std::uint64_t m_gaps = 0;
    std::int64_t m_firstStampNs = 0;
    std::int64_t m_lastStampNs = 0;
    std::uint32_t m_lastSample = 0;
    SampleStep m_step;
    std::array<Arrival, kWindow> m_arrivals{};
};

} // namespace posewire::model
