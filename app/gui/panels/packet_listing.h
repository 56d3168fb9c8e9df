// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/commands.h"
#include "app/gui/models/packet_model.h"
#include "app/gui/panels/packet_view.h"

#include <functional>
#include <optional>

namespace posewire::gui {

/// What the parts of the dock of packets work with. Everything outlives them.
struct PacketListing {
    model::SessionView& view;
    Commands& commands;
    PacketModel& packets;
    PacketView& list;
    std::function<void()> refresh;           ///< the dock, after a command that changes what it shows
    std::function<void(const QString&)> say; ///< a line below the list for a while

    [[nodiscard]] std::optional<std::uint64_t> selected() const { return view.selection().packet; }
};

} // namespace posewire::gui
