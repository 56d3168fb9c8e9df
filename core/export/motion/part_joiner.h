// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/model/session/session_view.h"
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
    /// Of one sample, all parts together: what is more makes it no sample.
    static constexpr std::size_t kMostBytes = model::SessionView::kMostMessageBytes;

    /// Null while something of the sample is missing. Valid until the next call.
    [[nodiscard]] const wire::Datagram* add(const wire::Datagram& part, const log::Packet& packet);
    void forget() { m_open.clear(); }

private:
    struct Open {
        std::uint32_t sample = 0;
        std::uint8_t type = 0;
        log::Stamp stamp{};       ///< of the part that came first
        std::size_t expected = 0; ///< 0 before the last part has come
        std::size_t bytes = 0;
        std::map<std::uint8_t, wire::Datagram> parts;
    };
    Open& openFor(const wire::Header& header, log::Stamp stamp);

    std::deque<Open> m_open; ///< the oldest first
    wire::Datagram m_whole;
};

} // namespace posewire::exporting
