// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/props.h"

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
        const Eigen::Vector3f place = pose.segments[segment].position.cast<float>();
        const Eigen::Quaternionf turn = pose.segments[segment].orientation.cast<float>();
        props.push_back({render::propShapeOf(model::propName(session, key, pose.layout, prop)),
                         {render::rigidMotion(glm::quat(turn.w(), turn.x(), turn.y(), turn.z()),
                                              glm::vec3(0.0F), {place.x(), place.y(), place.z()})}});
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
