// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/property_model.h"
#include "core/model/session/session_view.h"

#include <optional>

namespace posewire::gui {

/// What was concluded about a character besides its tags: revision and units with their evidence, address,
/// counts, parts of the null pose. `key` is read whenever a value is.
[[nodiscard]] std::vector<Property> characterFacts(model::SessionView& view,
                                                   const std::optional<model::CharacterKey>& key);

} // namespace posewire::gui
