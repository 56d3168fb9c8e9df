// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/property_model.h"
#include "app/gui/monitor_health.h"
#include "core/model/session/session_view.h"

#include <functional>
#include <vector>

namespace posewire::gui {

/// What the program asks of this computer: how full the receive buffer gets, processor, memory, pictures.
/// `health` is asked whenever they are shown.
[[nodiscard]] std::vector<Property> healthFacts(model::SessionView& view,
                                                const std::function<MonitorHealth()>& health);

} // namespace posewire::gui
