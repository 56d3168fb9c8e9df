// SPDX-License-Identifier: MIT
#include "render/passes/mesh_store.h"

#include <algorithm>
#include <cstddef>

#include <epoxy/gl.h>

namespace posewire::render {
namespace {

/// A joint with less of a vertex than this hardly moves it.
constexpr float kNoticeableWeight = 0.2F;

struct Vertex {
    glm::vec3 position;
    float occlusion;
    glm::vec3 normal;
    glm::vec3 templatePosition;
    JointIndices joints;
    glm::vec4 weights;
};
static_assert(sizeof(Vertex) == 60);

void attachAttributes(GpuMesh& gpu) {
    using Kind = gl::Attribute::Kind;
    gpu.array.attach(gpu.vertices, sizeof(Vertex), {0, 4, offsetof(Vertex, position), Kind::Float});
    gpu.array.attach(gpu.vertices, sizeof(Vertex), {1, 3, offsetof(Vertex, normal), Kind::Float});
    gpu.array.attach(gpu.vertices, sizeof(Vertex), {2, 3, offsetof(Vertex, templatePosition), Kind::Float});
    gpu.array.attach(gpu.vertices, sizeof(Vertex), {3, 4, offsetof(Vertex, joints), Kind::ByteInteger});
    gpu.array.attach(gpu.vertices, sizeof(Vertex), {4, 4, offsetof(Vertex, weights), Kind::Float});
    gpu.array.attachIndices(gpu.indices);
}

void measure(const SkinnedMesh& mesh, GpuMesh& gpu) {
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        for (int k = 0; k < 4; ++k) {
            const std::size_t joint = mesh.joints[i][static_cast<std::size_t>(k)];
            if (mesh.weights[i][k] >= kNoticeableWeight) {
                // Fingers reach about as far as the flat hand, however they bend.
                const std::size_t box = joint < kFirstFingerJoint ? joint : std::size_t{jointSegment(joint)};
                gpu.jointBoxes[box].add(mesh.positions[i]);
            }
        }
    }
    gpu.capsules = segmentCapsules(mesh);
}

std::optional<GpuMesh> upload(const SkinnedMesh& mesh, std::span<const glm::vec3> templatePositions) {
    const bool hasSuit = !templatePositions.empty();
    if (!mesh.validate(kJointCount) || (hasSuit && templatePositions.size() != mesh.vertexCount())) {
        return std::nullopt;
    }
    std::vector<Vertex> vertices;
    vertices.reserve(mesh.vertexCount());
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        vertices.push_back({mesh.positions[i], mesh.occlusion[i], mesh.normals[i],
                            hasSuit ? templatePositions[i] : mesh.positions[i], mesh.joints[i],
                            mesh.weights[i]});
    }
    GpuMesh gpu;
    gpu.hasSuit = hasSuit;
    gpu.vertices = gl::Buffer::create();
    gpu.vertices.upload(std::span<const Vertex>(vertices), gl::Buffer::Usage::Static);
    gpu.indices = gl::Buffer::create();
    gpu.indices.upload(std::span<const std::uint32_t>(mesh.indices), gl::Buffer::Usage::Static);
    gpu.indexCount = static_cast<int>(mesh.indices.size());
    gpu.vertexCount = static_cast<int>(vertices.size());
    gpu.array = gl::VertexArray::create();
    attachAttributes(gpu);
    measure(mesh, gpu);
    return gpu;
}

std::size_t indexOf(MeshId id) {
    return static_cast<std::size_t>(id) - 1;
}

} // namespace

void GpuMesh::draw() const {
    array.bind();
    glDrawElements(GL_TRIANGLES, indexCount, GL_UNSIGNED_INT, nullptr);
}

MeshId MeshStore::add(const SkinnedMesh& mesh, std::span<const glm::vec3> templatePositions) {
    std::optional<GpuMesh> gpu = upload(mesh, templatePositions);
    if (!gpu) {
        return MeshId::None;
    }
    auto place = std::ranges::find_if(m_meshes, [](const auto& free) { return !free; });
    place = place == m_meshes.end() ? m_meshes.emplace(place) : place;
    *place = std::move(gpu);
    return static_cast<MeshId>(place - m_meshes.begin() + 1);
}

void MeshStore::remove(MeshId id) {
    if (find(id) != nullptr) {
        m_meshes[indexOf(id)].reset();
    }
}

const GpuMesh* MeshStore::find(MeshId id) const {
    const std::size_t index = indexOf(id);
    return index < m_meshes.size() && m_meshes[index] ? &*m_meshes[index] : nullptr;
}

} // namespace posewire::render
