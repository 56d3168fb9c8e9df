// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/models/fault_model.h"
#include "app/gui/panels/range_bar.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/widgets.h"

#include <Qt>

#include <optional>
#include <vector>

namespace posewire::gui {

/// Dock `faults`: how much each character lost, and whose fault it was, over the time that was chosen for all
/// figures.
class FaultsPanel : public Panel {
    Q_OBJECT

public:
    FaultsPanel(model::SessionView& view, Commands& commands, QWidget* parent);

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override { return m_table->columns().state(); }
    void restoreState(const QJsonObject& state) override { m_table->columns().restore(state); }

    /// Shows the packets that a cell counts in the dock of packets.
    void showPackets(const QModelIndex& cell, PacketLook look);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void addActions(QMenu& menu, const QModelIndex& index);
    void select(const QModelIndex& index);
    void keepPlace();
    void restorePlace();

    FaultModel m_faults{m_view};
    ElidedLabel* m_span = new ElidedLabel(Qt::AlignLeft | Qt::AlignVCenter, this);
    SpanBar* m_choice = new SpanBar(m_view, m_commands, this);
    TableView* m_table = new TableView(tr("Faults"), this);
    PassingMessage* m_message = footMessage(this);
    // While the model is reset:
    std::vector<FaultRow> m_opened;
    std::optional<FaultRow> m_current;
    int m_currentColumn = 0;
};

} // namespace posewire::gui
