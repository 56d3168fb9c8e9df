// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/codec.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>

namespace posewire::exporting {

/// Joins samples that come in several datagrams, in whatever order these come.
class PartJoiner {
public:
    static constexpr std::size_t kMostOpen = 16; ///< samples that lack a part; the oldest is given up

    /// Null while something of the sample is missing. Valid until the next call.
    [[nodiscard]] const wire::Datagram* add(const wire::Datagram& part);
    void forget() { m_open.clear(); }

private:
    struct Open {
        std::uint32_t sample = 0;
        std::uint8_t type = 0;
        std::size_t expected = 0; ///< 0 before the last part has come
        std::map<std::uint8_t, wire::Datagram> parts;
    };
    Open& openFor(const wire::Header& header);

    std::deque<Open> m_open; ///< the oldest first
    wire::Datagram m_whole;
};

} // namespace posewire::exporting
