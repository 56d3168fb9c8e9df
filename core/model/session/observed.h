// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/model/accounting/packet_digest.h"
#include "core/wire/codec.h"

#include <optional>

namespace posewire::model {

struct Character;
struct Sender;
struct Stream;

/// A packet on its way through the stages of an ingest, with what each found out for those after it.
struct Observed {
    const log::Packet& packet;
    std::optional<wire::Header> header{};     ///< nothing if it cannot be read
    const wire::Datagram* datagram = nullptr; ///< null if it cannot be decoded
    PacketDigest digest{};
    Sender* sender = nullptr; ///< null if the log does not know it
    Stream* stream = nullptr;
    Character* character = nullptr;
};

} // namespace posewire::model
