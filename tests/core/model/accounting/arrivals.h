// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/accounting/stream_accounting.h"

#include <array>
#include <cstring>

namespace posewire::model {

/// Adds a datagram of at most 1,500 bytes. Those of equal content and indices are equal. Packets are numbered
/// from 0.
inline std::span<const Verdict> addTo(StreamAccounting& stream, log::Stamp stamp, std::size_t bytes,
                                      const wire::Header& header, std::uint32_t content) {
    static std::array<std::byte, 1500> all; // to clear it each time costs as much as what is measured
    all[0] = std::byte{header.datagramCounter};
    std::memcpy(all.data() + 1, &content, sizeof content);
    log::Packet packet;
    packet.number = stream.datagrams();
    packet.stamp = stamp;
    packet.bytes = std::span(all).first(bytes);
    return stream.add(packet, header);
}
/// Its content is its time code.
inline std::span<const Verdict> addTo(StreamAccounting& stream, log::Stamp stamp, std::size_t bytes,
                                      const wire::Header& header) {
    return addTo(stream, stamp, bytes, header, header.timeCode);
}

} // namespace posewire::model
