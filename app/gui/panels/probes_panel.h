// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/models/probe_model.h"
#include "app/gui/panels/table_view.h"

namespace posewire::gui {

/// Dock `probes`: the state of each probe of the stage now, whatever moment is shown.
class ProbesPanel : public Panel {
    Q_OBJECT

public:
    ProbesPanel(model::SessionView& view, Commands& commands, const ReceivingState& receiving,
                QWidget* parent);

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override { return m_table->columns().state(); }
    void restoreState(const QJsonObject& state) override { m_table->columns().restore(state); }

private:
    const ReceivingState& m_receiving;
    ProbeModel m_probes;
    TableView* m_table = new TableView(tr("Probes"), this);
};

} // namespace posewire::gui
