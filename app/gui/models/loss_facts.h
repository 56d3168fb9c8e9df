// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/property_model.h"
#include "core/model/session/session_view.h"

#include <vector>

namespace posewire::gui {

/// Of all streams, in the range that is chosen: whose losses they were, and the longest gap.
[[nodiscard]] std::vector<Property> lossFacts(model::SessionView& view);

} // namespace posewire::gui
