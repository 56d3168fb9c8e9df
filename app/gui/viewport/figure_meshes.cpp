// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/figure_meshes.h"

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

std::shared_ptr<const FigureMesh> FigureMeshes::of(const model::Session& session,
                                                   const model::CharacterKey& key) {
    render::NullPose performer = render::kReferenceNullPose;
    const std::vector<Eigen::Vector3d> origins = session.bodyOrigins(key);
    for (std::size_t i = 0; i < std::min(origins.size(), performer.size()); ++i) {
        performer[i] = {static_cast<float>(origins[i].x()), static_cast<float>(origins[i].y()),
                        static_cast<float>(origins[i].z())};
    }
    Entry& entry = m_entries[key];
    if (entry.mesh == nullptr || entry.performer != performer) {
        entry = {performer, fitted(performer)};
    }
    return entry.mesh;
}

} // namespace posewire::gui
