// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "app/gui/models/statistics_model.h"

/// The one way from what a dock shows to the packets behind it, and display filters for them.
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
/// back what was filtered and selected before. False if none of them is in memory: nothing happens then.
bool showPackets(model::SessionView& view, Commands& commands, const PacketsBehind& behind, PacketLook look);

/// True if a display filter lets a packet through, or cannot be read; false if the log has dropped the
/// packet.
[[nodiscard]] bool isListed(model::SessionView& view, const QString& filter, std::uint64_t packet);

/// The reason that showPackets() gives if it returns false.
[[nodiscard]] QString noPacketsText();

/// For packets of a time, such as `time >= 12.3 && time < 14.5`.
[[nodiscard]] QString rangeFilter(model::SessionView& view, const model::TimeRange& range);

/// For the packets that a cell counts: those of the row, in the range of the figures; in columns of what went
/// wrong, those at which it did.
[[nodiscard]] QString statisticsFilter(model::SessionView& view, const StatisticsModel& model,
                                       const QModelIndex& index);
/// The packets that a cell of the statistics is about.
[[nodiscard]] PacketsBehind packetsBehind(model::SessionView& view, const StatisticsModel& model,
                                          const QModelIndex& index);
/// All of some streams.
[[nodiscard]] PacketsBehind streamsBehind(model::SessionView& view,
                                          const std::vector<log::StreamKey>& streams,
                                          const std::optional<model::TimeRange>& range);

/// Losses of some streams, in a range or in all there is.
struct LossesSought {
    std::vector<log::StreamKey> streams;
    std::optional<model::LossCause> cause{}; ///< nothing for all
    std::optional<model::TimeRange> range{};
};
/// The packets after these losses, and the first ones of samples that are incomplete; of those, and of one
/// cause among others, as many of the newest as a filter can name.
[[nodiscard]] PacketsBehind lossesBehind(model::SessionView& view, const LossesSought& losses);

/// What the packets of such a filter are, in the words of a menu: "Packets after a gap"; empty for columns
/// that count nothing that packets could show.
[[nodiscard]] QString statisticsFilterTitle(int column);

/// For the packets of a character, from whichever port of its sender.
[[nodiscard]] QString characterFilter(const model::SessionView& view, const model::CharacterKey& key);

/// For the packets at which an event happened; empty for what no packet shows.
[[nodiscard]] QString packetFilterOf(model::SessionView& view, const model::Incident& event);

/// For packets that have in common what a cell of the packet list says; empty if nothing could say it.
[[nodiscard]] QString packetCellFilter(model::SessionView& view, std::uint64_t number, int column);

enum class FilterJoin { Replace, And, Or, AndNot };
[[nodiscard]] QString joinedFilter(const QString& filter, const QString& condition, FilterJoin join);

} // namespace posewire::gui
