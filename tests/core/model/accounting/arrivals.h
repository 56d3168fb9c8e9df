// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/accounting/stream_accounting.h"

#include <array>

namespace posewire::model {

/// Adds a datagram of at most 1,500 bytes by its header alone. Packets are numbered from 0.
inline std::span<const Verdict> addTo(StreamAccounting& stream, log::Stamp stamp, std::size_t bytes,
                                      const wire::Header& header) {
    static constexpr std::array<std::byte, 1500> kBytes{};
    log::Packet packet;
    packet.number = stream.datagrams();
    packet.stamp = stamp;
    packet.bytes = std::span(kBytes).first(bytes);
    return stream.add(packet, header);
}

} // namespace posewire::model
