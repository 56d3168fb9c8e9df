// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/display_filter.h"
#include "app/gui/models/tree_model.h"
#include "core/model/session/fault_matrix.h"

#include <optional>
#include <vector>

namespace posewire::gui {

struct FaultRow {
    enum Kind : std::uint8_t { All, Character, Unconfirmed, Stream };
    Kind kind = All;
    model::CharacterKey first{};   ///< of the character; stays through restarts
    model::CharacterKey current{}; ///< what it is called by
    std::uint8_t type = 0;         ///< of a stream
    model::FaultCounts counts{};
    std::vector<log::StreamKey> streams{}; ///< that it sums

    [[nodiscard]] bool isSame(const FaultRow& other) const {
        return kind == other.kind && first == other.first && type == other.type;
    }
};

/// Whose fault it was: a row for all, one for each character, its streams below, and columns for this
/// computer, the network, the sender and what is not known; over the range that is chosen.
class FaultModel : public TreeModel<FaultRow> {
public:
    enum Column : int { kName, kThisComputer, kNetwork, kSender, kUnknown, kLost, kExpected };

    explicit FaultModel(model::SessionView& view) : TreeModel(columns(*this)), m_view(view) {}

    /// Announces one change, or a reset where rows came or went.
    void refresh();

    [[nodiscard]] const FaultRow& row(const QModelIndex& index) const {
        return m_rows[static_cast<std::size_t>(node(index))];
    }
    /// Invalid where there is none.
    [[nodiscard]] QModelIndex indexOf(const FaultRow& like, int column = 0) const;
    /// Samples lost that a cell counts, or its row where it counts none.
    [[nodiscard]] std::uint64_t lost(const QModelIndex& index) const;
    /// The packets that a cell counts.
    [[nodiscard]] PacketsBehind packetsBehind(const QModelIndex& index) const;
    /// A line for each character and stream, with titles (RFC 4180).
    [[nodiscard]] QString csv() const;

    [[nodiscard]] QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;

protected:
    /// In a narrow dock causes of nothing leave before those of something, two at most.
    [[nodiscard]] ColumnRoom room(int column) const override;

private:
    [[nodiscard]] static std::vector<TableColumn<FaultRow>> columns(const FaultModel& model);
    [[nodiscard]] QString nameOf(const FaultRow& row) const;
    [[nodiscard]] QVariant marksOf(const FaultRow& row, int role) const;

    void chooseCauses();

    model::SessionView& m_view;
    std::vector<int> m_leaving; ///< columns of causes, the first one first
    std::optional<model::TimeRange> m_range;
    std::vector<FaultRow> m_rows; ///< by node; streams follow their character
};

} // namespace posewire::gui
