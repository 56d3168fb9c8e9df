// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/accounting/stream_accounting.h"

#include <array>
#include <cstring>

namespace posewire::model {

/// Adds a datagram of at most 1,500 bytes by its header alone; of equal time codes and indices they are
/// equal. Packets are numbered from 0.
inline std::span<const Verdict> addTo(StreamAccounting& stream, log::Stamp stamp, std::size_t bytes,
                                      const wire::Header& header) {
    std::array<std::byte, 1500> content{std::byte{header.datagramCounter}};
    std::memcpy(content.data() + 1, &header.timeCode, sizeof header.timeCode);
    log::Packet packet;
    packet.number = stream.datagrams();
    packet.stamp = stamp;
    packet.bytes = std::span(content).first(bytes);
    return stream.add(packet, header);
}

} // namespace posewire::model
