// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/models/joint_model.h"
#include "app/gui/panels/table_view.h"

namespace posewire::gui {

/// Dock `joints`: the angles of all joints of the shown character, and one joint closely.
class JointsPanel : public Panel {
    Q_OBJECT

public:
    JointsPanel(model::SessionView& view, Commands& commands, QWidget* parent);

    void refresh() override;
    [[nodiscard]] QString summary() const override;
    [[nodiscard]] QJsonObject state() const override { return m_table->columns().state(); }
    void restoreState(const QJsonObject& state) override { m_table->columns().restore(state); }

private:
    void select(const QModelIndex& index);

    JointModel m_joints{m_view};
    AngleModel m_angles{m_joints};
    TableView* m_table = new TableView(tr("Joints"), this);
    TableView* m_detail = new TableView(tr("Selected joint"), this);
    bool m_isFollowing = false;
};

} // namespace posewire::gui
