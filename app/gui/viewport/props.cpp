// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/props.h"

#include "app/gui/viewport/overlay_drawing.h"
#include "core/model/session/prop_names.h"

namespace posewire::gui {

std::vector<FigureProp> propsOf(const model::SessionView& session, const model::CharacterKey& key,
                                const model::CharacterPose& pose) {
    std::vector<FigureProp> props;
    for (int prop = 0; prop < pose.layout.props; ++prop) {
        const auto segment = static_cast<std::size_t>(pose.layout.body + prop);
        if (segment >= pose.segments.size() || !pose.isPresent(segment)) {
            continue;
        }
        const model::SegmentPose& at = pose.segments[segment];
        props.push_back(
            {render::propShapeOf(model::propName(session, key, pose.layout, prop)),
             {render::rigidMotion(turnOf(at.orientation), glm::vec3(0.0F), pointOf(at.position))}});
    }
    return props;
}

render::MeshId PropMeshes::of(render::PropShape shape, render::Renderer& renderer) {
    render::MeshId& id = m_meshes[static_cast<std::size_t>(shape)];
    if (id == render::MeshId::None) {
        id = renderer.uploadMesh(shape);
    }
    return id;
}

} // namespace posewire::gui
