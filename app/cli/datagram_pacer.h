// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/wire/header.h"

#include <cstdint>
#include <optional>

namespace posewire::cli {

/// When the datagrams of a recording are due: by their stamps; without stamps by the senders' time codes; and
/// where those freeze or jump, one period per sample.
class DatagramPacer {
public:
    DatagramPacer(double periodSeconds, double speed) : m_periodNs(periodSeconds * 1e9), m_speed(speed) {}

    /// Nanoseconds after the start at which this datagram, the next of the recording, is due.
    std::int64_t due(wire::Bytes datagram, std::optional<std::int64_t> stampNs);

    /// The recording begins again, one period after its last datagram.
    void beginAgain();

private:
    [[nodiscard]] double step(wire::Bytes datagram, std::optional<std::int64_t> stampNs);
    [[nodiscard]] double stepByHeader(const wire::Header& header);

    double m_periodNs;
    double m_speed;
    double m_nowNs = 0.0;
    std::optional<std::int64_t> m_stampNs;
    std::optional<wire::Header> m_previous;
};

} // namespace posewire::cli
