// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/property_model.h"
#include "app/gui/receiving_state.h"

#include <functional>
#include <vector>

namespace posewire::gui {

/// How well this computer can receive: its buffer, and how long its thread was kept from looking. `state` is
/// asked whenever they are shown.
[[nodiscard]] std::vector<Property> receivingFacts(std::function<ReceivingState()> state);

} // namespace posewire::gui
