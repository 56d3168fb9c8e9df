// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/program_state.h"
#include "app/gui/models/column.h"
#include "core/model/session/session_view.h"

namespace posewire::gui {

/// What was lost in the range that is chosen and by whom; what the program asks of this computer and how well
/// that can receive; what the log keeps and what did not come into it. Reads the session and the program,
/// which must outlive it, whenever it is shown.
[[nodiscard]] std::vector<Property> computerFacts(model::SessionView& view, const ReceivingState& receiving,
                                                  const MonitorHealth& monitor);

} // namespace posewire::gui
