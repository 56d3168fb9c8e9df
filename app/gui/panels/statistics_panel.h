// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/statistics_model.h"
#include "app/gui/panel.h"
#include "app/gui/panels/table_view.h"

namespace posewire::gui {

/// Dock `statistics`: figures of every stream, and below them those of this computer.
class StatisticsPanel : public Panel {
    Q_OBJECT

public:
    StatisticsPanel(model::SessionView& view, Commands& commands, QWidget* parent);

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override;
    void restoreState(const QJsonObject& state) override;

private:
    void select(const QModelIndex& index);

    model::SessionView& m_view;
    Commands& m_commands;
    StatisticsModel m_streams;
    PropertyModel m_receiver;
    TableView* m_table;
    TableView* m_facts;
};

} // namespace posewire::gui
