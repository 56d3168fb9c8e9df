// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/wire/codec.h"

#include <cstddef>
#include <cstdint>

namespace posewire::model {

/// Messages of types that count samples that are larger, all parts together, are not read: those of MVN have
/// less than 3,000 bytes.
inline constexpr std::size_t kMostMessageBytes = 8192;

/// A complete message, decoded and Z-up. Items of a sample that came in several datagrams are joined.
struct Message {
    wire::Datagram datagram;
    log::Stamp stamp{};
    std::uint64_t packet = UINT64_MAX; ///< its number in the log; of the last of several datagrams
    log::SenderId sender{};
    bool isSentYUp = false; ///< the datagram was turned
};

} // namespace posewire::model
