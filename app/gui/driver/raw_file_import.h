// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/packet.h"
#include "core/log/time.h"

#include <QString>

#include <functional>
#include <span>

namespace posewire::gui {

/// Takes one packet of a file on its way to the log; sets `arrival.sender` itself.
using PacketTaker = std::function<void(std::span<const std::byte> bytes, const log::SenderInfo& sender,
                                       const log::Arrival& arrival)>;

/// Reads a file of datagrams. Those of a capture keep their stamps and senders. Those of a raw file are one
/// sender, spaced by their time codes (by their order where those stand still or go back), the newest at
/// `end`. The answer is what went wrong, empty for nothing.
[[nodiscard]] QString importRawFile(const QString& path, const PacketTaker& take, log::Stamp end);

} // namespace posewire::gui
