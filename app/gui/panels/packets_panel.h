// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/packet_filter_run.h"
#include "app/gui/models/packet_model.h"
#include "app/gui/models/packet_search.h"
#include "app/gui/models/packet_text.h"
#include "app/gui/panel.h"

#include <QTimer>

#include <memory>
#include <optional>

class QLabel;
class QMenu;
class QPushButton;

namespace posewire::gui {

class FilterBar;
class FindBar;
class PacketView;

/// Dock `packets`: every packet of the log, or those that the display filter lets through.
///
/// The slots are what the menus of the window do here, by name.
class PacketsPanel : public Panel {
    Q_OBJECT
    Q_PROPERTY(bool isTimeOfDay READ isTimeOfDay)
    Q_PROPERTY(bool isDeltaToRowAbove READ isDeltaToRowAbove)

public:
    PacketsPanel(model::SessionView& view, Commands& commands, QWidget* parent);
    ~PacketsPanel() override;

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override;
    void restoreState(const QJsonObject& state) override;

    [[nodiscard]] const PacketModel& packets() const { return m_packets; }
    [[nodiscard]] bool isTimeOfDay() const {
        return m_packets.timeMode() == PacketModel::TimeMode::TimeOfDay;
    }
    [[nodiscard]] bool isDeltaToRowAbove() const {
        return m_packets.deltaMode() == PacketModel::DeltaMode::RowAbove;
    }
    [[nodiscard]] const PacketFilterRun* filterRun() const { return m_run.get(); }
    /// What was said last below the list, such as "No problem after packet 12"; empty again after a while.
    [[nodiscard]] QString message() const;
    /// Goes where the text says, see packetTarget(); the answer is what is wrong with it, empty for nothing.
    QString goTo(const QString& text);

public slots:
    void goToPacket();
    void nextProblem();
    void previousProblem();
    void firstPacket();
    void newestPacket();
    void nextOfStream();
    void previousOfStream();
    void toggleMark();
    void nextMark();
    void previousMark();
    void editComment();
    void focusFilter();
    void find();
    void findNext();
    void findPrevious();
    void copyRows();
    void copyCsv();
    void copyCell();
    void copyBytesText();
    void copyBytesRaw();
    void copyBytesCArray();
    void copyBytesJson();
    void filterByCell();
    void filterAndCell();
    void filterOrCell();
    void filterNotCell();
    void timeSinceFirst();
    void timeOfDay();
    void deltaInStream();
    void deltaToRowAbove();

private:
    void layOut();
    void connectParts();
    void fitColumns();
    void followFilter();
    void followCursor();
    void followSelection();
    void showEmptyState();
    void cancelFilter();
    void clearFilter();
    void selectRow(const QModelIndex& index);
    void showPacket(std::uint64_t number);
    void say(const QString& text);
    [[nodiscard]] std::optional<std::uint64_t> selected() const;
    [[nodiscard]] std::vector<std::uint64_t> selectedPackets() const;
    /// The nearest row that satisfies a condition; goes there, or says `nothing`.
    template <class Condition>
    void goToRow(bool isForward, const Condition& isWanted, const QString& nothing);
    void goToProblem(bool isForward);
    void goToSameStream(bool isForward);
    void goToMark(bool isForward);
    void search(bool isForward);
    void takeSearchResult();
    void copyBytes(ByteFormat format);
    void applyCell(FilterJoin join);
    void setTimes(PacketModel::TimeMode time, PacketModel::DeltaMode delta);
    void showMenu(const QPoint& globalPlace);
    void addFilterMenu(QMenu& menu);
    void addCopyMenu(QMenu& menu);
    void addTimeMenu(QMenu& menu);

    model::SessionView& m_view;
    Commands& m_commands;
    PacketModel m_packets;
    std::unique_ptr<PacketFilterRun> m_run;
    std::optional<std::uint64_t> m_stoppedAt; ///< the packet where the cursor stands still
    std::uint64_t m_filteredTo = 0;           ///< by the run, when it was last asked
    std::uint64_t m_filterFrom = 0;           ///< what comes from here on is newer than the filter
    std::unique_ptr<PacketSearch> m_search;
    QString m_filterText; ///< as it was last taken from the session
    FilterBar* m_filter;
    FindBar* m_find;
    PacketView* m_list;
    QPushButton* m_clear;
    QLabel* m_message;
    QTimer m_messageTimer;
    QTimer m_searchTimer;
    bool m_isFollowing = false; ///< the selection: nobody selected anything here
};

} // namespace posewire::gui
