// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/session/session_view.h"

#include <QString>

#include <span>

namespace posewire::gui {

class PacketModel;

/// How the bytes of a packet can be copied.
enum class ByteFormat {
    Text,   ///< offsets, sixteen bytes a line in hexadecimal, the readable ones beside them
    Raw,    ///< hexadecimal digits and nothing else
    CArray, ///< const unsigned char packet1204[760] = { … };
    Json,   ///< the object that `posewire-cli decode --json` writes
};

/// Empty where the log has dropped the packet.
[[nodiscard]] QString packetBytesText(model::SessionView& view, std::uint64_t number, ByteFormat format);

/// Rows as they stand in the list, cells set apart by tabs, one line each.
[[nodiscard]] QString packetRowsText(const PacketModel& model, std::span<const int> rows);

/// With a line of titles; numbers without anything between their digits, quotes where they are needed
/// (RFC 4180).
[[nodiscard]] QString packetRowsCsv(const PacketModel& model, std::span<const int> rows);

} // namespace posewire::gui
