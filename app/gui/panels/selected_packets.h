// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/display_filter.h"
#include "app/gui/models/packet_text.h"
#include "app/gui/panels/packet_listing.h"

#include <QCoreApplication>

#include <vector>

namespace posewire::gui {

/// What the operator can do with the selected packets: copy, mark, comment, filter by a cell. What was done,
/// or why not, is said below the list.
class SelectedPackets {
    Q_DECLARE_TR_FUNCTIONS(SelectedPackets)

public:
    enum class RowFormat { Text, Csv };

    explicit SelectedPackets(PacketListing listing) : m_at(std::move(listing)) {}

    [[nodiscard]] bool isEmpty() const { return numbers().empty(); }
    void copyRows(RowFormat format);
    void copyCell();
    void copyBytes(ByteFormat format);
    /// Marks all of them, or none where all are marked.
    void toggleMark();
    void editComment();
    /// The condition that the current cell stands for; empty where it has none.
    [[nodiscard]] QString cellFilter() const;
    void applyCell(FilterJoin join);

private:
    [[nodiscard]] std::vector<std::uint64_t> numbers() const;

    PacketListing m_at;
};

} // namespace posewire::gui
