// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/body_meshes.h"

#include <algorithm>
#include <cstring>

namespace posewire::gui {

void BodyMeshes::beginPicture() {
    ++m_picture;
    m_fits = 0;
    m_isBehind = false;
}

std::shared_ptr<const FigureMesh> BodyMeshes::of(const render::NullPose& performer) {
    Body body;
    static_assert(sizeof(body) == sizeof(performer));
    std::memcpy(body.data(), performer.data(), sizeof(body));
    if (const auto known = m_entries.find(body); known != m_entries.end()) {
        known->second.picture = m_picture;
        return known->second.mesh;
    }
    const bool hasRoom = makeRoom();
    if (hasRoom && m_fits < kFitsAtOnce) {
        ++m_fits;
        return m_entries.emplace(body, Entry{fitted(performer), m_picture}).first->second.mesh;
    }
    m_isBehind = m_isBehind || hasRoom;
    if (m_standIn == nullptr) {
        m_standIn = fitted(render::kReferenceNullPose);
    }
    return m_standIn;
}

/// False where all that there may be are in the picture.
bool BodyMeshes::makeRoom() {
    if (m_entries.size() < kMost) {
        return true;
    }
    const auto oldest =
        std::ranges::min_element(m_entries, {}, [](const auto& entry) { return entry.second.picture; });
    if (oldest->second.picture == m_picture) {
        return false;
    }
    if (m_fits < kFitsAtOnce) {
        m_entries.erase(oldest);
    }
    return true;
}

std::shared_ptr<const FigureMesh> BodyMeshes::fitted(const render::NullPose& performer) {
    if (m_mannequin == nullptr) {
        m_mannequin = std::make_unique<const render::SkinnedMesh>(render::loadMannequin(m_detail));
    }
    auto figure = std::make_shared<FigureMesh>();
    figure->mesh = render::fitToNullPose(*m_mannequin, performer, figure->origins);
    figure->templatePositions = m_mannequin->positions;
    figure->capsules = render::segmentCapsules(figure->mesh);
    return figure;
}

std::size_t BodyMeshes::bytesOfOne() const {
    if (m_mannequin == nullptr) {
        return 0;
    }
    const render::SkinnedMesh& mesh = *m_mannequin;
    const std::size_t vertex = 3 * sizeof(glm::vec3) + sizeof(float) + sizeof(render::JointIndices) +
                               sizeof(glm::vec4); // with its place on the template
    return 2 * (mesh.vertexCount() * vertex + mesh.indices.size() * sizeof(mesh.indices[0]));
}

std::size_t BodyMeshes::memoryBytes() const {
    return (m_entries.size() + (m_standIn != nullptr ? 1 : 0)) * bytesOfOne();
}

std::size_t BodyMeshes::mostBytes() const {
    return (kMost + 1) * bytesOfOne();
}

} // namespace posewire::gui
