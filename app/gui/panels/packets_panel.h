// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/models/display_filter.h"
#include "app/gui/models/packet_search.h"
#include "app/gui/panels/filter_bar.h"
#include "app/gui/panels/find_bar.h"
#include "app/gui/panels/packet_view.h"
#include "app/gui/theme/widgets.h"

#include <QPushButton>

namespace posewire::gui {

/// Dock `packets`: every packet of the log, or those that the display filter lets through.
class PacketsPanel : public Panel {
    Q_OBJECT

public:
    PacketsPanel(model::SessionView& view, Commands& commands, QWidget* parent);

    [[nodiscard]] static std::span<const ActionInfo> actionTable();

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override;
    void restoreState(const QJsonObject& state) override;

    [[nodiscard]] const PacketModel& packets() const { return m_packets; }
    [[nodiscard]] const ListFilter& filter() const { return m_filter; }
    /// Goes to packetTarget() of the text; returns what is wrong with the text, empty for nothing.
    QString goTo(const QString& text);

private:
    struct Actions;
    enum class Meant { Selected, OrNewest }; ///< the newest that is shown if none is selected
    enum class Copied { Rows, Csv, Cell };

    void followCursor();
    void followSelection();
    void showEmptyState();
    void focusList();
    void selectRow(const QModelIndex& index);
    /// In the line below the list: what was done, why not, or what cannot be reached.
    void say(const QString& text);
    void showMenu(const QPoint& globalPlace);

    void showPacket(std::uint64_t number);
    void askForPacket();
    /// To the newest packet, and on with the list from then on.
    void goToNewest();
    void go(Landmark landmark, Direction direction);
    void find(Direction direction);

    [[nodiscard]] std::vector<std::uint64_t> meantPackets(Meant meant) const;
    void copy(Copied what);
    void copyBytes(ByteFormat format);
    [[nodiscard]] bool areMarked() const;
    /// Marks all of them, or none if all are marked.
    void toggleMark();
    void editComment();
    /// The condition that the current cell means; empty if it has none.
    [[nodiscard]] QString cellFilter() const;
    void applyCell(FilterJoin join);

    PacketModel m_packets{m_view};
    ListFilter m_filter;
    std::optional<std::uint64_t> m_stoppedAt; ///< the packet at which the cursor is paused
    FilterBar* m_filterBar = new FilterBar(this);
    FindBar* m_find = new FindBar(this);
    PacketView* m_list = new PacketView(tr("Packets"), this);
    QPushButton* m_clear = new QPushButton(tr("Clear the filter"), m_list);
    PassingMessage* m_message = footMessage(this);
    bool m_isHeld = false;      ///< at a packet, or with the display in the past
    bool m_isFollowing = false; ///< the selection: nobody selected anything here
};

} // namespace posewire::gui
