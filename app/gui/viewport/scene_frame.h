// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/time.h"
#include "core/model/keys.h"
#include "render/mesh/mannequin.h"
#include "render/picking.h"
#include "render/scene.h"

#include <array>
#include <memory>
#include <vector>

namespace posewire::gui {

/// The mannequin fitted to one performer; never changed once made, so that threads may share it.
struct FigureMesh {
    render::SkinnedMesh mesh;
    std::vector<glm::vec3> templatePositions; ///< of each vertex on the mannequin before the fit
    render::NullPose origins{};               ///< what palettes of this mesh are made with
    render::SegmentCapsules capsules{};
};

/// One character in a picture.
struct Figure {
    model::CharacterKey key;
    std::shared_ptr<const FigureMesh> mesh;
    std::array<render::DualQuaternion, render::kJointCount> palette{};
    render::CharacterLook look;
    glm::vec3 labelPosition{0.0F}; ///< above the head
    render::Bounds bounds;         ///< of the segment origins
};

/// Everything that one picture shows, by value: it may be drawn on another thread while the session moves on.
struct SceneFrame {
    render::Camera camera;
    render::SceneColours colours;
    std::vector<Figure> figures;
    std::vector<Figure> ghosts; ///< not to be picked, without labels
    std::vector<render::AxesInstance> axes;
    std::vector<render::LineInstance> lines;
    std::vector<render::PointInstance> points;
    int width = 1; ///< device pixels
    int height = 1;
    float pixelRatio = 1.0F;
    log::Stamp built{}; ///< the session's time

    [[nodiscard]] float aspect() const { return static_cast<float>(width) / static_cast<float>(height); }
};

} // namespace posewire::gui
