// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/joints_panel.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/theme/widgets.h"

#include <QItemSelectionModel>
#include <QVBoxLayout>

namespace posewire::gui {

JointsPanel::JointsPanel(model::SessionView& view, Commands& commands, QWidget* parent)
    : Panel(view, commands, parent) {
    constexpr int kAngles = 3;
    auto* column = tightColumn(this);
    column->addWidget(m_table, 1);
    column->addWidget(new Line(this));
    column->addWidget(m_detail);
    m_table->setModel(&m_joints);
    m_table->setEmptyText(tr("No pose and no joint angles on the air.\nIn MVN: Network Streamer > enable "
                             "Position + Orientation (Quaternion) (type 02), or Joint Angles (type 20)."));
    m_detail->setModel(&m_angles);
    m_detail->setFixedHeight(m_detail->heightForRows(kAngles));
    m_detail->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    connect(m_table->selectionModel(), &QItemSelectionModel::currentRowChanged, this, &JointsPanel::select);
}

void JointsPanel::refresh() {
    m_isFollowing = true;
    m_joints.refresh();
    m_angles.refresh();
    m_detail->setVisible(m_joints.rowCount() != 0);
    if (m_joints.rowCount() != 0 && m_joints.shownRow() != m_table->currentIndex().row()) {
        m_table->setCurrentIndex(m_joints.index(m_joints.shownRow(), 0));
    }
    m_isFollowing = false;
}

/// Selects the segment below the joint.
void JointsPanel::select(const QModelIndex& index) {
    const auto key = m_joints.character();
    if (!m_isFollowing && index.isValid() && key) {
        m_commands.select(selectionOf(m_view, *key, m_joints.segmentOf(index.row())));
    }
}

QString JointsPanel::summary() const {
    if (m_joints.rowCount() == 0) {
        return {};
    }
    const QString last = m_joints.isStale()              ? m_joints.staleText()
                         : m_joints.motion().isReading() ? tr("reading …")
                                                         : spanText(m_view);
    return QStringLiteral("%1 · %2").arg(m_joints.sourceText(), last);
}

} // namespace posewire::gui
