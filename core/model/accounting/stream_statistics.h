// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace posewire::model {

/// How fast one stream is now, from receive stamps alone. O(1) in time and memory for each packet.
class StreamStatistics {
public:
    /// Adds a datagram; `beginsSample` is true for the first one of a sample.
    void add(std::int64_t stampNs, std::size_t bytes, bool beginsSample);

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

    std::uint64_t m_bytes = 0;
    std::uint64_t m_samples = 0;
    std::int64_t m_lastStampNs = 0;
    std::array<Arrival, kWindow> m_arrivals{};
};

} // namespace posewire::model
