// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/body_fits.h"

#include <algorithm>
#include <cstring>

namespace posewire::gui {

namespace {

std::shared_ptr<const MannequinMeshes> loadMeshes(render::Detail detail) {
    auto meshes = std::make_shared<MannequinMeshes>();
    meshes->mesh = render::loadMannequin(detail);
    meshes->lowMesh = render::loadMannequin(render::Detail::Low);
    meshes->capsules = render::segmentCapsules(meshes->mesh);
    return meshes;
}

} // namespace

std::shared_ptr<const FigureBody> BodyFits::of(const render::NullPose& performer,
                                               const render::FingerOrigins& fingers) {
    Body key;
    static_assert(sizeof(key) == sizeof(performer) + sizeof(fingers));
    std::memcpy(key.data(), performer.data(), sizeof(performer));
    std::memcpy(key.data() + 3 * performer.size(), fingers.data(), sizeof(fingers));
    ++m_asked;
    if (const auto known = m_entries.find(key); known != m_entries.end()) {
        known->second.asked = m_asked;
        return known->second.body;
    }
    if (m_mannequin == nullptr) {
        m_mannequin = loadMeshes(m_detail);
    }
    if (m_entries.size() >= kMost) {
        m_entries.erase(
            std::ranges::min_element(m_entries, {}, [](const auto& entry) { return entry.second.asked; }));
    }
    auto body = std::make_shared<FigureBody>();
    body->mannequin = m_mannequin;
    body->fit = render::fitBody(performer, fingers);
    body->capsules = render::stretched(m_mannequin->capsules, body->fit.stretches);
    return m_entries.emplace(key, Entry{std::move(body), m_asked}).first->second.body;
}

std::size_t BodyFits::mannequinBytes() const {
    if (m_mannequin == nullptr) {
        return 0;
    }
    constexpr std::size_t kHere =
        2 * sizeof(glm::vec3) + sizeof(float) + sizeof(render::JointIndices) + sizeof(glm::vec4);
    std::size_t bytes = 0;
    for (const auto* mesh : {&m_mannequin->mesh, &m_mannequin->lowMesh}) {
        bytes += mesh->vertexCount() * (kHere + render::kGpuVertexBytes) +
                 2 * mesh->indices.size() * sizeof(mesh->indices[0]);
    }
    return bytes;
}

std::size_t BodyFits::memoryBytes() const {
    return mannequinBytes() + m_entries.size() * (sizeof(Body) + sizeof(FigureBody));
}

std::size_t BodyFits::mostBytes() const {
    return m_mannequin == nullptr ? 0 : mannequinBytes() + kMost * (sizeof(Body) + sizeof(FigureBody));
}

} // namespace posewire::gui
