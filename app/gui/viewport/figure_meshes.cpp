// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/figure_meshes.h"

#include "core/model/body/reference_body.h"
#include "render/mesh/null_pose_fit.h"

#include <algorithm>

namespace posewire::gui {

const render::SkinnedMesh& FigureMeshes::mannequin() {
    if (m_mannequin == nullptr) {
        m_mannequin = std::make_unique<const render::SkinnedMesh>(render::loadMannequin(m_detail));
    }
    return *m_mannequin;
}

std::shared_ptr<const FigureMesh> FigureMeshes::fitted(const render::NullPose& performer) {
    auto figure = std::make_shared<FigureMesh>();
    figure->mesh = render::fitToNullPose(mannequin(), performer, figure->origins);
    figure->templatePositions = mannequin().positions;
    figure->capsules = render::segmentCapsules(figure->mesh);
    return figure;
}

std::shared_ptr<const FigureMesh> FigureMeshes::of(model::SessionView& session,
                                                   const model::CharacterKey& key) {
    render::NullPose performer{};
    const model::BodyOrigins& origins = session.bodyOrigins(key);
    static_assert(std::tuple_size_v<decltype(origins.places)> == std::tuple_size_v<render::NullPose>);
    std::ranges::transform(origins.places, performer.begin(), [](const Eigen::Vector3d& origin) {
        return glm::vec3(origin.x(), origin.y(), origin.z());
    });
    Entry& entry = m_entries[key];
    if (entry.mesh == nullptr || entry.performer != performer) {
        entry = {performer, fitted(performer)};
    }
    return entry.mesh;
}

} // namespace posewire::gui
