// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/wire/codec.h"

#include <cstdint>

namespace posewire::model {

/// A complete message, decoded. Items of a sample that came in several datagrams are joined.
struct Message {
    wire::Datagram datagram;
    log::Stamp stamp{};
    std::uint64_t packet = UINT64_MAX; ///< its number in the log; of the last of several datagrams
    log::SenderId sender{};
};

} // namespace posewire::model
