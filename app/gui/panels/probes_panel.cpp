// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/probes_panel.h"

#include "app/gui/theme/widgets.h"

#include <algorithm>

namespace posewire::gui {

ProbesPanel::ProbesPanel(model::SessionView& view, Commands& commands, const ReceivingState& receiving,
                         QWidget* parent)
    : Panel(view, commands, parent), m_receiving(receiving) {
    tightColumn(this)->addWidget(m_table);
    m_table->setModel(&m_probes);
    refresh();
}

void ProbesPanel::refresh() {
    m_probes.refresh(m_receiving);
    m_table->setEmptyText(
        m_receiving.stageProblem.isEmpty()
            ? tr("No probe is heard of.\nA probe receives on another computer and publishes to a "
                 "server of NATS: posewire --nats nats://HOST --site SITE reads it here.")
            : m_receiving.stageProblem);
}

QString ProbesPanel::summary() const {
    const auto& probes = m_probes.rows();
    const auto alive = std::ranges::count_if(probes, &stage::ProbeState::isAlive);
    return probes.empty() ? QString() : tr("%1 of %2 alive").arg(alive).arg(probes.size());
}

} // namespace posewire::gui
