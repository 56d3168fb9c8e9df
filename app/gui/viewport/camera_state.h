// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/camera_motion.h"

#include <QJsonObject>

namespace posewire::gui {

/// The camera as it is kept from one run to the next.
[[nodiscard]] QJsonObject stateOf(const CameraMotion& motion);
/// What is missing or makes no sense stays as it is.
void restore(CameraMotion& motion, const QJsonObject& state);

} // namespace posewire::gui
