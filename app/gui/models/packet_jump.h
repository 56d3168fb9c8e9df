// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "core/model/session/session_view.h"

#include <QString>

#include <cstdint>
#include <optional>

/// The one way from what a dock shows to the packets behind it.
namespace posewire::gui {

/// Packets that a row or a cell is about.
struct PacketsBehind {
    QString filter;                          ///< display filter for them alone
    std::optional<std::uint64_t> packet{};   ///< the one to go to; nothing: the newest of them
    std::optional<std::uint8_t> type{};      ///< that all of them have
    std::optional<std::uint8_t> character{}; ///< likewise
    bool isTrouble = false;                  ///< whether all of them are problems
};

enum class PacketLook {
    InContext, ///< among those that the operator's own filter lets through
    Alone,
};

/// Selects such a packet and brings the list of packets to the front. In its context the operator's own
/// filter stays; where that would hide the packet, it lets these through as well. Commands::goBack() brings
/// back what was filtered and selected before. False where none of them is in memory: nothing happens then.
bool showPackets(model::SessionView& view, Commands& commands, const PacketsBehind& behind, PacketLook look);

/// Whether a display filter lets a packet through; true where the filter cannot be read. Of a packet that the
/// log has dropped: false.
[[nodiscard]] bool isListed(model::SessionView& view, const QString& filter, std::uint64_t packet);

/// What showPackets() says where it returns false.
[[nodiscard]] QString noPacketsText();

} // namespace posewire::gui
