// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/commands.h"
#include "app/gui/theme/theme.h"
#include "core/model/session/session_view.h"

#include <QString>

#include <cstdint>
#include <optional>

namespace posewire::gui {

[[nodiscard]] Health healthOf(model::EventSeverity severity);
/// "error", "warning", "note".
[[nodiscard]] QString severityWord(model::EventSeverity severity);
[[nodiscard]] QString groupWord(model::EventGroup group);

/// Whose event it is: "Mira Lin · 02", "Factory", or the address where it is of no character.
[[nodiscard]] QString whoseWords(model::SessionView& view, const model::Event& event);

/// A few words for a cell or a chip: "31 lost · network", "jitter 12.1 ms", "stale".
[[nodiscard]] QString briefWords(const model::Event& event);

/// A display filter for the packets at which it happened; empty for what no packet shows.
[[nodiscard]] QString packetFilterOf(model::SessionView& view, const model::Event& event);

/// The packet where the newest of it is to be seen: its own, or the last one before where it has none.
/// Nothing where the log has dropped it.
[[nodiscard]] std::optional<std::uint64_t> eventPacket(model::SessionView& view, const model::Event& event);

/// Selects that packet and brings the dock of packets to the front, with its like. False where the log has
/// dropped it.
bool showPacketsOf(model::SessionView& view, Commands& commands, const model::Event& event);

} // namespace posewire::gui
