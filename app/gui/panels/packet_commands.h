// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/commands.h"
#include "app/gui/models/display_filter.h"
#include "app/gui/models/packet_model.h"
#include "app/gui/models/packet_search.h"
#include "app/gui/models/packet_text.h"
#include "app/gui/panels/packet_view.h"

#include <QCoreApplication>
#include <QTimer>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

/// What the operator can do in the list of packets.
namespace posewire::gui {

class FindBar;

/// What the commands work with. Everything outlives them.
struct PacketListing {
    model::SessionView& view;
    Commands& commands;
    PacketModel& packets;
    PacketView& list;
    std::function<void()> refresh;           ///< the dock, after a command that changes what it shows
    std::function<void(const QString&)> say; ///< a line below the list for a while

    [[nodiscard]] std::optional<std::uint64_t> selected() const { return view.selection().packet; }
};

enum class Direction { Backward, Forward };

/// Where the operator can go. A line below the list reports what cannot be reached.
class PacketNavigation {
    Q_DECLARE_TR_FUNCTIONS(PacketNavigation)

public:
    PacketNavigation(PacketListing listing, FindBar& bar);

    /// Goes to packetTarget() of the text; returns what is wrong with the text, empty for nothing.
    QString goTo(const QString& text);
    void askForPacket();
    void goToFirst();
    /// To the newest packet, and on with the list from then on.
    void goToNewest();
    void goToProblem(Direction direction);
    void goToSameStream(Direction direction);
    void goToMark(Direction direction);
    /// Looks for the text of the find bar in the bytes of the listed packets, on a thread of its own, and
    /// goes there. Opens the bar where there is nothing to look for yet.
    void find(Direction direction);

private:
    void show(std::uint64_t number);
    void takeResult();

    PacketListing m_at;
    FindBar& m_bar;
    std::unique_ptr<PacketSearch> m_search;
    QTimer m_poll;
};

/// What the operator can do with the selected packets: copy, mark, comment, filter by a cell. A line
/// below the list reports what was done, or why not.
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
