// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/time.h"
#include "core/wire/header.h"

#include <chrono>
#include <optional>

namespace posewire::cli {

/// When the datagrams of a recording are due: by their stamps; without stamps by the senders' time codes; and
/// where those freeze or jump, one period per sample.
class DatagramPacer {
public:
    DatagramPacer(double periodSeconds, double speed)
        : m_period(std::chrono::duration<double>(periodSeconds)), m_speed(speed) {}

    /// How long after the start this datagram, the next of the recording, is due.
    log::Duration due(wire::Bytes datagram, std::optional<log::Stamp> stamp);

    /// The recording begins again, one period after its last datagram.
    void beginAgain();

private:
    /// Fractions count: rounded steps would add up to drift.
    using Nanoseconds = std::chrono::duration<double, std::nano>;

    [[nodiscard]] Nanoseconds step(wire::Bytes datagram, std::optional<log::Stamp> stamp);
    [[nodiscard]] Nanoseconds stepByHeader(const wire::Header& header);

    Nanoseconds m_period;
    double m_speed;
    Nanoseconds m_now{};
    std::optional<log::Stamp> m_stamp;
    std::optional<wire::Header> m_previous;
};

} // namespace posewire::cli
