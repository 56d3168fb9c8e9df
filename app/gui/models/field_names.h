// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/field_document.h"

namespace posewire::gui {

/// "freeAcceleration" as "Free acceleration".
[[nodiscard]] QString spacedName(std::string_view name);

/// "Segment 7 · Head", "Point 1.13 · pSacrum", "Tracker 11 · Right Hand".
[[nodiscard]] QString itemTitle(const FieldDocument& document, std::int32_t item);

/// "7 · Head", "1.13 · pSacrum".
[[nodiscard]] QString identifierText(const FieldDocument& document, std::int32_t node);

} // namespace posewire::gui
