// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/monitor_health.h"
#include "app/gui/receiving_state.h"

namespace posewire::gui {

/// What panels read that is not of the session.
class ProgramView {
public:
    virtual ~ProgramView() = default;

    /// How receiving goes: ports, buffers, what was dropped here.
    [[nodiscard]] virtual ReceivingState receivingState() const = 0;
    /// What this program itself costs.
    [[nodiscard]] virtual MonitorHealth monitorHealth() const = 0;
};

} // namespace posewire::gui
