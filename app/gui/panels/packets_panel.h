// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/packet_search.h"
#include "app/gui/panel.h"
#include "app/gui/panels/packet_commands.h"
#include "app/gui/theme/widgets.h"

class QPushButton;

namespace posewire::gui {

class FilterBar;

/// Dock `packets`: every packet of the log, or those that the display filter lets through.
class PacketsPanel : public Panel {
    Q_OBJECT

public:
    PacketsPanel(model::SessionView& view, Commands& commands, QWidget* parent);
    ~PacketsPanel() override;

    [[nodiscard]] static std::span<const ActionInfo> actionTable();

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override;
    void restoreState(const QJsonObject& state) override;

    [[nodiscard]] const PacketModel& packets() const { return m_packets; }
    [[nodiscard]] PacketNavigation& navigation() { return m_navigation; }
    [[nodiscard]] PacketModel::TimeMode timeMode() const { return m_packets.timeMode(); }
    [[nodiscard]] PacketModel::DeltaMode deltaMode() const { return m_packets.deltaMode(); }
    void setTimeMode(PacketModel::TimeMode mode);
    [[nodiscard]] const PacketFilterRun* filterRun() const { return m_run.get(); }
    /// What was said last below the list, such as "No problem after this packet."; empty again after a while.
    [[nodiscard]] QString message() const { return m_message->said(); }

private:
    struct Actions;

    void connectParts();
    void fitColumns();
    void followFilter();
    void followCursor();
    void followSelection();
    void showEmptyState();
    void cancelFilter();
    void clearFilter();
    void selectRow(const QModelIndex& index);
    void say(const QString& text);
    void showMenu(const QPoint& globalPlace);
    [[nodiscard]] PacketListing listing();

    PacketModel m_packets;
    std::unique_ptr<PacketFilterRun> m_run;
    std::optional<std::uint64_t> m_stoppedAt; ///< the packet at which the cursor is paused
    std::uint64_t m_filteredTo = 0;           ///< by the run, when it was last asked
    std::uint64_t m_filterFrom = 0;           ///< packets from here on arrived after the filter was set
    QString m_filterText;                     ///< as it was last taken from the session
    FilterBar* m_filter;
    FindBar* m_find;
    PacketView* m_list;
    QPushButton* m_clear;
    PassingMessage* m_message;
    SelectedPackets m_selected;
    PacketNavigation m_navigation;
    bool m_isFollowing = false; ///< the selection: nobody selected anything here
};

} // namespace posewire::gui
