// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/session/session_view.h"

#include <QString>

#include <tl/expected.hpp>

#include <cstdint>

namespace posewire::gui {

/// The packet that an operator means: "1204112" or "1 204 112" is a number, "+100" and "-100" count from the
/// selected packet (none: the newest one), "12.5 s" is the first packet from so long after the first one on,
/// "10:42:17.508" the first from that time of day on, on the day of the newest packet. The error says what
/// may be written, or what there is.
[[nodiscard]] tl::expected<std::uint64_t, QString> packetTarget(model::SessionView& view,
                                                                const QString& text);

} // namespace posewire::gui
