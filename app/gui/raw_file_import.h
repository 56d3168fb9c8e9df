// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/packet_log.h"

#include <QString>

namespace posewire::gui {

/// Appends the datagrams of a file to the log, spaced by their time codes (by their order where those stand
/// still or go back), the newest at `endNs`. Needs the log's writer. The answer is what went wrong, empty for
/// nothing.
[[nodiscard]] QString importRawFile(const QString& path, log::PacketLog& log, std::int64_t endNs);

} // namespace posewire::gui
