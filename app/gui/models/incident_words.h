// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/display_filter.h"
#include "app/gui/theme/theme.h"
#include "core/model/incidents/incident.h"

/// Incidents as the window shows them, wherever it does.
namespace posewire::gui {

[[nodiscard]] Health healthOf(model::IncidentSeverity severity);
/// "error", "warning", "note".
[[nodiscard]] QString severityWord(model::IncidentSeverity severity);
[[nodiscard]] QString groupWord(model::IncidentGroup group);

/// Whose incident it is: "Mira Lin · 02", "Factory", or the address where it is of no character.
[[nodiscard]] QString whoseWords(model::SessionView& view, const model::Incident& incident);
/// "Mira Lin", or the address.
[[nodiscard]] QString whoseWords(model::SessionView& view, const model::Incident::Part& part);

/// Where the guide says what it means and what to do about it: its cause where it is a loss, else its kind.
[[nodiscard]] QString helpPlaceOf(const model::Incident& incident);

/// The packet where the newest of it is to be seen: its own, or the last one before where it has none.
/// Nothing if the log has dropped it.
[[nodiscard]] std::optional<std::uint64_t> incidentPacket(model::SessionView& view,
                                                          const model::Incident& incident);

[[nodiscard]] PacketsBehind packetsBehind(model::SessionView& view, const model::Incident& incident,
                                          const model::Incident::Part* part = nullptr);

} // namespace posewire::gui
