// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/header.h"
#include "core/wire/type_table.h"

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace posewire::log {

/// How the datagrams of a raw file, which has no stamps, follow each other: by the time codes of their
/// sender, and where those freeze or jump, one period per sample.
class RawPace {
public:
    /// Fractions count: rounded steps would add up to drift.
    using Nanoseconds = std::chrono::duration<double, std::nano>;

    explicit RawPace(Nanoseconds period = std::chrono::duration<double>(1.0 / 240)) : m_period(period) {}

    /// How long after the one before it the next datagram is, and 0 of what cannot be read.
    Nanoseconds step(std::span<const std::byte> datagram) {
        const auto header = wire::decodeHeader(datagram);
        return header && wire::isSampled(header->type()) ? stepTo(*header) : Nanoseconds::zero();
    }

private:
    Nanoseconds stepTo(const wire::Header& header) {
        constexpr std::chrono::seconds longestPause(2);
        const auto before = std::exchange(m_previous, header);
        if (!before || before->sampleCounter == header.sampleCounter) {
            return Nanoseconds::zero();
        }
        const std::chrono::milliseconds elapsed(header.timeCode - before->timeCode); // modulo 2³²
        return elapsed != elapsed.zero() && elapsed <= longestPause ? elapsed : m_period;
    }

    Nanoseconds m_period;
    std::optional<wire::Header> m_previous;
};

} // namespace posewire::log
