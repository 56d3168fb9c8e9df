// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/wire/codec.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>

namespace posewire::exporting {

/// Joins samples that come in several datagrams, in whatever order these come.
class PartJoiner {
public:
    // Samples that lack a part: older ones are given up.
    static constexpr log::Duration kWait = std::chrono::seconds(4);
    static constexpr std::size_t kMostOpen = 1024;

    /// Null while something of the sample is missing. Valid until the next call.
    [[nodiscard]] const wire::Datagram* add(const wire::Datagram& part, log::Stamp stamp);
    void forget() { m_open.clear(); }

private:
    struct Open {
        std::uint32_t sample = 0;
        std::uint8_t type = 0;
        log::Stamp stamp{};       ///< of the part that came first
        std::size_t expected = 0; ///< 0 before the last part has come
        std::map<std::uint8_t, wire::Datagram> parts;
    };
    Open& openFor(const wire::Header& header, log::Stamp stamp);

    std::deque<Open> m_open; ///< the oldest first
    wire::Datagram m_whole;
};

} // namespace posewire::exporting
