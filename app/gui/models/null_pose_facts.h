// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/null_pose_reading.h"
#include "app/gui/models/property_model.h"

namespace posewire::gui {

/// When and how completely scale messages came, and the size of the body. The reading must outlive them.
[[nodiscard]] std::vector<Property> nullPoseFacts(const NullPoseReading& reading);

[[nodiscard]] Health healthOf(model::Severity severity);

/// Findings as lines to copy: symbol, what, what it means.
[[nodiscard]] QString findingsText(const std::vector<model::NullPoseFinding>& findings);

} // namespace posewire::gui
