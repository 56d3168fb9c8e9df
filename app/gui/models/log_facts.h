// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/property_model.h"
#include "core/model/session/session_view.h"

#include <vector>

namespace posewire::gui {

/// What the log keeps and what did not come into it: memory, packets, datagrams dropped here, malformed and
/// foreign ones.
[[nodiscard]] std::vector<Property> logFacts(model::SessionView& view);

} // namespace posewire::gui
