// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"
#include "app/gui/models/packet_facts.h"
#include "app/gui/models/packet_search.h"

#include <optional>
#include <span>
#include <vector>

namespace posewire::gui {

/// bool: a line under the row says that the display is paused behind this packet.
inline constexpr int kPausedHereRole = Qt::UserRole + 20;
/// bool: every second packet, for stripes that stay with their packet while old ones go.
inline constexpr int kStripeRole = Qt::UserRole + 21;

/// The packets of the log, or those that a filter lets through, in the order of arrival. Without a filter a
/// row is a number and takes no memory; texts are made when they are asked for.
class PacketModel : public ColumnModel<PacketFacts> {
public:
    enum Column : int { kNumber, kTime, kDelta, kSender, kType, kCharacter, kSample, kPart, kSize, kNote };
    enum class TimeMode { SinceFirst, TimeOfDay };
    enum class DeltaMode { Stream, RowAbove };

    explicit PacketModel(model::SessionView& view);

    /// Shows what the session has followed meanwhile: at most one removal (packets that the log dropped), one
    /// insertion and one change.
    void refresh();

    /// Lists only what addMatches() gives from now on.
    void beginMatches() { startAgain(true); }
    /// Numbers that grow and lie above those given before; they show with the next refresh().
    void addMatches(const std::vector<std::uint64_t>& numbers) { m_matches.append(numbers); }
    /// Lists all packets.
    void endMatches() { startAgain(false); }
    [[nodiscard]] bool isFiltered() const { return m_isFiltered; }

    void setTimeMode(TimeMode mode);
    void setDeltaMode(DeltaMode mode);
    [[nodiscard]] TimeMode timeMode() const { return m_timeMode; }
    [[nodiscard]] DeltaMode deltaMode() const { return m_deltaMode; }

    /// The packet's number; the row must be one of the list.
    [[nodiscard]] std::uint64_t packetAt(int row) const;
    /// -1 if the packet is not listed.
    [[nodiscard]] int rowOf(std::uint64_t number) const;
    /// The first row at or after a packet; rowCount() where there is none.
    [[nodiscard]] int rowFrom(std::uint64_t number) const;
    /// With a filter: the numbers of all rows.
    [[nodiscard]] const PacketNumbers& matches() const { return m_matches; }

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

protected:
    [[nodiscard]] ColumnRoom room(int column) const override;

private:
    const PacketFacts* facts(int row) const;
    void removeDropped();
    /// With those that are yet to be inserted.
    [[nodiscard]] int rowsThere() const;
    void startAgain(bool isFiltered);
    void announceColumn(int column);
    /// Read the model only where a cell is asked for.
    [[nodiscard]] static std::vector<TableColumn<PacketFacts>> columns(const PacketModel& model);
    [[nodiscard]] QString timeText(const PacketFacts& facts) const;
    [[nodiscard]] double deltaMs(const PacketFacts& facts) const;
    [[nodiscard]] QString senderText(const PacketFacts& facts) const;
    [[nodiscard]] QVariant characterMark(const PacketFacts& facts, int role) const;

    model::SessionView& m_view;
    bool m_isFiltered = false;
    int m_rows = 0;
    std::uint64_t m_begin = 0;   ///< without a filter: the packet of the first row
    PacketNumbers m_matches;     ///< with a filter; the first m_rows of them are rows
    bool m_hasSenders = false;   ///< more than one
    std::uint64_t m_removed = 0; ///< rows that went at the front
    TimeMode m_timeMode = TimeMode::SinceFirst;
    DeltaMode m_deltaMode = DeltaMode::Stream;
    model::Annotations m_annotations;           ///< as last shown
    model::Cursor m_cursor;                     ///< likewise
    mutable std::optional<PacketFacts> m_facts; ///< of the row last asked for, until the next refresh()
};

enum class ByteFormat {
    Text,   ///< offsets, sixteen bytes a line in hexadecimal, the readable ones beside them
    Raw,    ///< hexadecimal digits and nothing else
    CArray, ///< const unsigned char packet1204[760] = { … };
    Json,   ///< the object that `posewire-cli decode --json` writes
};

/// Empty if the log has dropped the packet.
[[nodiscard]] QString packetBytesText(model::SessionView& view, std::uint64_t number, ByteFormat format);

/// Rows as they stand in the list, cells set apart by tabs, one line each.
[[nodiscard]] QString packetRowsText(const PacketModel& model, std::span<const int> rows);

/// With a line of titles; numbers without anything between their digits, quotes where they are needed
/// (RFC 4180).
[[nodiscard]] QString packetRowsCsv(const PacketModel& model, std::span<const int> rows);

} // namespace posewire::gui
