// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/wire/codec.h"

#include <QTcpSocket>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace posewire::net {

/// A small pose.
inline std::vector<std::byte> datagram(std::uint32_t sample) {
    wire::Datagram datagram;
    wire::PoseQuaternion pose;
    pose.segments.push_back({1, {0, 0, 1}, {1, 0, 0, 0}});
    datagram.body = pose;
    datagram.header.sampleCounter = sample;
    datagram.header.datagramCounter = 0x80;
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    return *wire::encode(datagram);
}

/// Returns once the system has taken all of it.
inline void send(QTcpSocket& socket, std::span<const std::byte> bytes) {
    socket.write(reinterpret_cast<const char*>(bytes.data()), static_cast<qint64>(bytes.size()));
    while (socket.bytesToWrite() > 0 && socket.waitForBytesWritten(5000)) {
    }
}

} // namespace posewire::net
