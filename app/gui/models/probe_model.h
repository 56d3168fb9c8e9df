// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/program_state.h"
#include "app/gui/models/column.h"

namespace posewire::gui {

/// The probes of the stage, by name.
class ProbeModel : public TableModel<stage::ProbeState> {
public:
    enum Column : int { kName, kState, kRate, kDropped, kLostOnWay, kSpool, kClock, kHost, kVersion };

    ProbeModel();

    void refresh(const ReceivingState& receiving) { setRows(receiving.probes); }
};

} // namespace posewire::gui
