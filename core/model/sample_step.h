// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace posewire::model {

/// The sender's own spacing of sample counters, since a stream may be sent at a fraction of the capture rate:
/// the most frequent of the last 64 differences between successive highest counters, provided at least 90 %
/// of them are multiples of it. Loss makes multiples, never fractions.
class SampleStep {
public:
    static constexpr std::size_t kKept = 64;
    static constexpr std::size_t kLeast = 4; ///< differences before a step is believed

    /// Adds a difference; one of 0 says nothing.
    void add(std::uint32_t difference);

    /// 0 before it is known, or where there is none: the stream is irregular.
    [[nodiscard]] std::uint32_t value() const { return m_value; }

private:
    [[nodiscard]] std::uint32_t mostFrequent() const;

    std::array<std::uint32_t, kKept> m_differences{};
    std::size_t m_count = 0;
    std::uint32_t m_value = 0;
};

} // namespace posewire::model
