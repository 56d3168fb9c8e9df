// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/session/session_view.h"

#include <optional>

/// Which packet the inspector shows, and what stands around it in its stream.
namespace posewire::gui {

/// The selected packet; where none is selected the newest one of the shown character: of poses where a
/// segment is selected, else of `preferredType`, else of what there is. Nothing where no packet came.
[[nodiscard]] std::optional<std::uint64_t> inspectedPacket(model::SessionView& view,
                                                           std::uint8_t preferredType);

/// The nearest packet of the same sender, character and type before (-1) or after (+1) one; for bytes that
/// are no datagram the nearest of their kind. Nothing where there is none.
[[nodiscard]] std::optional<std::uint64_t> neighbourInStream(model::SessionView& view, std::uint64_t packet,
                                                             int direction);

} // namespace posewire::gui
