// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/wire/header.h"

#include <algorithm>
#include <cstddef>

namespace posewire::log {

/// Calls f(offset, size, flags) for each datagram of a packet: relays from TCP, and recorders, join several.
template <class Function>
void forEachDatagram(wire::Bytes packet, PacketFlags flags, Function&& f) {
    std::size_t size = flags.skipped || flags.isDropRecord ? packet.size() : wire::firstDatagram(packet);
    if (size == packet.size()) {
        f(std::size_t{0}, size, flags);
        return;
    }
    const std::size_t count = wire::countDatagrams(packet);
    flags.shared = std::min<std::size_t>(count, PacketFlags::kMostShared) & 7U;
    for (std::size_t from = 0; from < packet.size(); from += size) {
        size = wire::firstDatagram(packet.subspan(from));
        f(from, size, flags);
        flags.afterClosed = false;
    }
}

} // namespace posewire::log
