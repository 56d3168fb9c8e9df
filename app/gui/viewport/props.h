// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/body/character_pose.h"
#include "core/model/session/session_view.h"
#include "render/mesh/prop_shapes.h"
#include "render/renderer.h"

#include <array>
#include <vector>

namespace posewire::gui {

/// A prop of a character in a picture.
struct FigureProp {
    render::PropShape shape = render::PropShape::Generic;
    std::array<render::DualQuaternion, 1> motion{};

    bool operator==(const FigureProp&) const = default;
};

/// Those of a pose that have a place, in the shapes that their names ask for.
[[nodiscard]] std::vector<FigureProp>
propsOf(const model::SessionView& session, const model::CharacterKey& key, const model::CharacterPose& pose);

/// The meshes of props as one renderer knows them, each uploaded when it is first drawn.
class PropMeshes {
public:
    [[nodiscard]] render::MeshId of(render::PropShape shape, render::Renderer& renderer);

private:
    std::array<render::MeshId, render::kPropShapeCount> m_meshes{};
};

} // namespace posewire::gui
