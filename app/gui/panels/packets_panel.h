// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/models/display_filter.h"
#include "app/gui/models/packet_model.h"
#include "app/gui/models/packet_search.h"
#include "app/gui/models/packet_text.h"
#include "app/gui/panels/find_bar.h"
#include "app/gui/panels/packet_view.h"
#include "app/gui/theme/widgets.h"

#include <memory>
#include <optional>
#include <vector>

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
    [[nodiscard]] PacketModel::TimeMode timeMode() const { return m_packets.timeMode(); }
    [[nodiscard]] PacketModel::DeltaMode deltaMode() const { return m_packets.deltaMode(); }
    void setTimeMode(PacketModel::TimeMode mode) { m_packets.setTimeMode(mode); }
    /// Goes to packetTarget() of the text; returns what is wrong with the text, empty for nothing.
    QString goTo(const QString& text);
    [[nodiscard]] const PacketFilterRun* filterRun() const { return m_run.get(); }
    /// What was said last below the list, such as "No problem after this packet."; empty again after a while.
    [[nodiscard]] QString message() const { return m_message->said(); }

private:
    struct Actions;
    enum class RowFormat { Text, Csv };
    enum class ProblemsOf { Selected, Anybody }; ///< the selected character, where there is one

    void connectParts();
    void followFilter();
    /// The list holds to a range from when it is selected until a packet beyond it is.
    void followRange();
    void takeMatches();
    void followCursor();
    void followSelection();
    void showEmptyState();
    void cancelFilter();
    void clearFilter();
    void focusList();
    /// To the filter and the selection before the newest jump.
    void goBack();
    void selectRow(const QModelIndex& index);
    void say(const QString& text);
    void showMenu(const QPoint& globalPlace);

    // Where the operator can go. The line below the list says what cannot be reached.
    void showPacket(std::uint64_t number);
    void askForPacket();
    void goToFirst();
    /// To the newest packet, and on with the list from then on.
    void goToNewest();
    /// Of those that the filter lists; without a filter `of` decides.
    void goToProblem(Direction direction, ProblemsOf of);
    void goToSameStream(Direction direction);
    void goToMark(Direction direction);
    /// Looks for the text of the find bar in the bytes of the listed packets, on a thread of its own, and
    /// goes there. Opens the bar where there is nothing to look for yet.
    void search(Direction direction);
    void takeFound();

    // What the operator can do with the selected packets. The line below the list says what was done, or why
    // not.
    [[nodiscard]] std::vector<std::uint64_t> selectedPackets() const;
    /// What is marked or commented on: those, or the newest shown where none is selected.
    [[nodiscard]] std::vector<std::uint64_t> meantPackets() const;
    void copyRows(RowFormat format);
    void copyCell();
    void copyBytes(ByteFormat format);
    /// Whether there are any, and all of them are marked.
    [[nodiscard]] bool areMarked() const;
    /// Marks all of them, or none where all are marked.
    void toggleMark();
    void editComment();
    /// The condition that the current cell means; empty where it has none.
    [[nodiscard]] QString cellFilter() const;
    void applyCell(FilterJoin join);

    PacketModel m_packets;
    std::unique_ptr<PacketFilterRun> m_run;
    std::optional<std::uint64_t> m_stoppedAt;      ///< the packet at which the cursor is paused
    std::uint64_t m_filtered = 0;                  ///< packets that the run was through with, when last asked
    std::uint64_t m_backlog = 0;                   ///< packets that were there when the filter was set
    std::uint64_t m_unfiltered = 0;                ///< packets that the filter was too late for
    QString m_filterText;                          ///< as it was last taken from the session
    std::optional<model::TimeRange> m_chosenRange; ///< likewise
    std::optional<model::TimeRange> m_range;       ///< that the list holds to
    std::optional<std::uint64_t> m_selectedPacket; ///< when the range was last followed
    std::optional<model::TimeRange> m_filterRange; ///< that the filter runs with
    bool m_comparesLengths = false;                ///< the filter that runs
    log::Stamp m_filterFirst{};
    PositionUnits m_filterUnits; ///< that it runs with
    FilterBar* m_filter;
    FindBar* m_find;
    PacketView* m_list;
    QPushButton* m_clear;
    PassingMessage* m_message;
    std::unique_ptr<PacketSearch> m_search;
    QTimer m_poll;              ///< for what the search has found
    bool m_isHeld = false;      ///< at a packet, or with the display in the past
    bool m_isFollowing = false; ///< the selection: nobody selected anything here
};

} // namespace posewire::gui
