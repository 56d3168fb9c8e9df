// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/overlays.h"
#include "core/model/body/spaces.h"

#include <QColor>

#include <vector>

/// What overlays are drawn with.
namespace posewire::gui {

[[nodiscard]] inline glm::vec3 pointOf(const Eigen::Vector3d& vector) {
    return {static_cast<float>(vector.x()), static_cast<float>(vector.y()), static_cast<float>(vector.z())};
}

[[nodiscard]] inline glm::quat turnOf(const Eigen::Quaterniond& rotation) {
    return {static_cast<float>(rotation.w()), static_cast<float>(rotation.x()),
            static_cast<float>(rotation.y()), static_cast<float>(rotation.z())};
}

[[nodiscard]] inline glm::vec4 inkOf(const QColor& colour, float alpha = 1.0F) {
    return {static_cast<float>(colour.redF()), static_cast<float>(colour.greenF()),
            static_cast<float>(colour.blueF()), alpha};
}

/// A line that fades towards its beginning.
void addWay(const std::vector<glm::vec3>& places, const glm::vec4& ink, float width, SceneFrame& frame);

} // namespace posewire::gui
