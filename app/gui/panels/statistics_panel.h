// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/base/program_state.h"
#include "app/gui/models/column.h"
#include "app/gui/models/display_filter.h"
#include "app/gui/models/statistics_model.h"
#include "app/gui/panels/range_bar.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/widgets.h"

#include <set>

class QSplitter;

namespace posewire::gui {

/// Dock `statistics`: the range of time, figures of every stream in it, and below them those of this
/// computer.
class StatisticsPanel : public Panel {
    Q_OBJECT

public:
    StatisticsPanel(model::SessionView& view, Commands& commands, const ReceivingState& receiving,
                    const MonitorHealth& health, QWidget* parent);

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override { return m_table->columns().state(); }
    void restoreState(const QJsonObject& state) override { m_table->columns().restore(state); }

    /// Shows the packets that a cell counts in the dock of packets.
    void showPackets(const QModelIndex& index, PacketLook look = PacketLook::InContext);
    void filterToRange();

private:
    void setUpStreams();
    void foldEnded();
    void select(const QModelIndex& index);
    void addActions(QMenu& menu, const QModelIndex& index);

    StatisticsModel m_streams;
    std::set<log::SenderId> m_folded; ///< senders that had ended
    PropertyModel m_computer;
    RangeBar* m_range;
    TableView* m_table;
    TableView* m_facts;
    QAction* m_filterToRange;
    QSplitter* m_parts;
    PassingMessage* m_message;
};

} // namespace posewire::gui
