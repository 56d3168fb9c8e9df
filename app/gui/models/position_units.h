// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/session/session_view.h"

#include <map>
#include <optional>

namespace posewire::gui {

/// What senders' positions come in, by sender and message type, as far as that is another unit than usual.
/// A copy: a thread may have one while the session follows the log.
using PositionUnits = std::map<std::pair<log::SenderId, std::uint8_t>, model::LengthUnit>;

[[nodiscard]] PositionUnits unusualPositionUnits(const model::SessionView& view);

/// Empty for the usual one.
[[nodiscard]] std::optional<model::LengthUnit> unitIn(const PositionUnits& units, log::SenderId sender,
                                                      std::uint8_t type);

} // namespace posewire::gui
