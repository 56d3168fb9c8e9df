// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/body_meshes.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace posewire::gui {

void BodyMeshes::beginPicture() {
    ++m_picture;
    m_fits = 0;
    m_isBehind = false;
}

const render::FingerOrigins& BodyMeshes::unknownFingers() {
    static const render::FingerOrigins kUnknown = [] {
        render::FingerOrigins fingers;
        fingers.fill(glm::vec3(std::numeric_limits<float>::quiet_NaN()));
        return fingers;
    }();
    return kUnknown;
}

std::shared_ptr<const FigureMesh> BodyMeshes::of(const render::NullPose& performer,
                                                 const render::FingerOrigins& fingers) {
    Body body;
    static_assert(sizeof(body) == sizeof(performer) + sizeof(fingers));
    std::memcpy(body.data(), performer.data(), sizeof(performer));
    std::memcpy(body.data() + 3 * performer.size(), fingers.data(), sizeof(fingers));
    if (const auto known = m_entries.find(body); known != m_entries.end()) {
        known->second.picture = m_picture;
        return known->second.mesh;
    }
    const bool hasRoom = makeRoom();
    if (hasRoom && m_fits < kFitsAtOnce) {
        ++m_fits;
        return m_entries.emplace(body, Entry{fitted(performer, fingers), m_picture}).first->second.mesh;
    }
    m_isBehind = m_isBehind || hasRoom;
    if (m_standIn == nullptr) {
        m_standIn = fitted(render::kReferenceNullPose, unknownFingers());
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

std::shared_ptr<const FigureMesh> BodyMeshes::fitted(const render::NullPose& performer,
                                                     const render::FingerOrigins& fingers) {
    if (m_mannequin == nullptr) {
        m_mannequin = std::make_unique<const render::SkinnedMesh>(render::loadMannequin(m_detail));
        m_lowMannequin =
            std::make_unique<const render::SkinnedMesh>(render::loadMannequin(render::Detail::Low));
    }
    auto figure = std::make_shared<FigureMesh>();
    figure->mesh =
        render::fitToNullPose(*m_mannequin, performer, fingers, figure->origins, figure->fingerOrigins);
    figure->templatePositions = m_mannequin->positions;
    figure->lowMesh =
        render::fitToNullPose(*m_lowMannequin, performer, fingers, figure->origins, figure->fingerOrigins);
    figure->lowTemplatePositions = m_lowMannequin->positions;
    figure->capsules = render::segmentCapsules(figure->mesh);
    return figure;
}

std::size_t BodyMeshes::bytesOfOne() const {
    if (m_mannequin == nullptr) {
        return 0;
    }
    constexpr std::size_t vertex = 3 * sizeof(glm::vec3) + sizeof(float) + sizeof(render::JointIndices) +
                                   sizeof(glm::vec4); // with its place on the template
    std::size_t bytes = 0;
    for (const auto* mesh : {m_mannequin.get(), m_lowMannequin.get()}) {
        bytes += mesh->vertexCount() * vertex + mesh->indices.size() * sizeof(mesh->indices[0]);
    }
    return 2 * bytes;
}

std::size_t BodyMeshes::memoryBytes() const {
    return (m_entries.size() + (m_standIn != nullptr ? 1 : 0)) * bytesOfOne();
}

std::size_t BodyMeshes::mostBytes() const {
    return (kMost + 1) * bytesOfOne();
}

} // namespace posewire::gui
