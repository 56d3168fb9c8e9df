// SPDX-License-Identifier: MIT
#include "render/passes/mesh_store.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

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
    JointIndices segments;
    glm::vec4 weights;
};
static_assert(sizeof(Vertex) == 64);

void attachAttributes(GpuMesh& gpu) {
    using Kind = gl::Attribute::Kind;
    gpu.array.attach(gpu.vertices, sizeof(Vertex), {0, 4, offsetof(Vertex, position), Kind::Float});
    gpu.array.attach(gpu.vertices, sizeof(Vertex), {1, 3, offsetof(Vertex, normal), Kind::Float});
    gpu.array.attach(gpu.vertices, sizeof(Vertex), {2, 3, offsetof(Vertex, templatePosition), Kind::Float});
    gpu.array.attach(gpu.vertices, sizeof(Vertex), {3, 4, offsetof(Vertex, joints), Kind::ByteInteger});
    gpu.array.attach(gpu.vertices, sizeof(Vertex), {4, 4, offsetof(Vertex, weights), Kind::Float});
    gpu.array.attach(gpu.vertices, sizeof(Vertex), {5, 4, offsetof(Vertex, segments), Kind::ByteInteger});
    gpu.array.attachIndices(gpu.indices);
}

std::array<Segment, kJointCount> mannequinSegments() {
    std::array<Segment, kJointCount> segments{};
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
        segments[joint] = jointSegment(joint);
    }
    return segments;
}

void measure(const SkinnedMesh& mesh, std::size_t jointCount, GpuMesh& gpu) {
    gpu.jointBoxes.resize(jointCount);
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        for (int k = 0; k < 4; ++k) {
            if (mesh.weights[i][k] >= kNoticeableWeight) {
                gpu.jointBoxes[mesh.joints[i][static_cast<std::size_t>(k)]].add(mesh.positions[i]);
            }
        }
    }
}

/// Fingers reach about as far as the flat hand, however they bend.
void joinFingers(GpuMesh& gpu) {
    for (std::size_t joint = kFirstFingerJoint; joint < kJointCount; ++joint) {
        gpu.jointBoxes[jointSegment(joint)].add(gpu.jointBoxes[joint]);
        gpu.jointBoxes[joint] = {};
    }
}

GpuMesh upload(const SkinnedMesh& mesh, std::span<const glm::vec3> templatePositions,
               std::span<const Segment> jointSegments) {
    const bool hasSuit = !templatePositions.empty();
    std::vector<Vertex> vertices;
    vertices.reserve(mesh.vertexCount());
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        JointIndices segments{};
        std::ranges::transform(mesh.joints[i], segments.begin(),
                               [&](std::uint8_t joint) { return std::uint8_t{jointSegments[joint]}; });
        vertices.push_back({mesh.positions[i], mesh.occlusion[i], mesh.normals[i],
                            hasSuit ? templatePositions[i] : mesh.positions[i], mesh.joints[i], segments,
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
    measure(mesh, jointSegments.size(), gpu);
    return gpu;
}

bool isSound(const TextureImage& image) {
    return image.width > 0 && image.height > 0 &&
           image.texels.size() == std::size_t{4} * static_cast<std::size_t>(image.width) *
                                      static_cast<std::size_t>(image.height);
}

bool doFit(const SkinnedMesh& mesh, const MeshDress& dress) {
    const bool areJointsSound = std::ranges::all_of(
        dress.segmentJoints, [&](int joint) { return joint < static_cast<int>(dress.jointSegments.size()); });
    const bool arePartsSound = std::ranges::all_of(dress.parts, [&](const MeshPart& part) {
        return part.firstIndex <= mesh.indices.size() &&
               part.indexCount <= mesh.indices.size() - part.firstIndex;
    });
    return mesh.validate(dress.jointSegments.size()) && areJointsSound && arePartsSound &&
           !dress.parts.empty() && dress.segmentJoints.size() == kSegmentCount &&
           (dress.texturePlaces.empty() || dress.texturePlaces.size() == mesh.vertexCount());
}

void addDress(const MeshDress& dress, GpuMesh& gpu) {
    gpu.parts.assign(dress.parts.begin(), dress.parts.end());
    if (!dress.texturePlaces.empty()) {
        gpu.texturePlaces = gl::Buffer::create();
        gpu.texturePlaces.upload(dress.texturePlaces, gl::Buffer::Usage::Static);
        gpu.array.attach(gpu.texturePlaces, sizeof(glm::vec2), {6, 2, 0, gl::Attribute::Kind::Float});
    }
    for (const TextureImage& image : dress.textures) {
        gpu.textures.push_back(
            isSound(image) ? gl::Texture::ofPicture(image.width, image.height, image.texels) : gl::Texture());
    }
    for (MeshPart& part : gpu.parts) {
        const auto texture = static_cast<std::size_t>(part.texture);
        const bool isThere = part.texture >= 0 && texture < gpu.textures.size() &&
                             gpu.textures[texture].name() != 0 && !dress.texturePlaces.empty();
        part.texture = isThere ? part.texture : -1;
    }
}

std::size_t indexOf(MeshId id) {
    return static_cast<std::size_t>(id) - 1;
}

} // namespace

void GpuMesh::draw() const {
    array.bind();
    glDrawElements(GL_TRIANGLES, indexCount, GL_UNSIGNED_INT, nullptr);
}

void GpuMesh::draw(const MeshPart& part) const {
    array.bind();
    glDrawElements(GL_TRIANGLES, static_cast<int>(part.indexCount), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(sizeof(std::uint32_t) * std::uintptr_t{part.firstIndex}));
}

MeshId MeshStore::add(const SkinnedMesh& mesh, std::span<const glm::vec3> templatePositions) {
    const bool doFit = templatePositions.empty() || templatePositions.size() == mesh.vertexCount();
    if (!doFit || !mesh.validate(kJointCount)) {
        return MeshId::None;
    }
    GpuMesh gpu = upload(mesh, templatePositions, mannequinSegments());
    joinFingers(gpu);
    gpu.capsules = segmentCapsules(mesh);
    return keep(std::move(gpu));
}

MeshId MeshStore::add(const SkinnedMesh& mesh, const MeshDress& dress) {
    if (!doFit(mesh, dress)) {
        return MeshId::None;
    }
    GpuMesh gpu = upload(mesh, {}, dress.jointSegments);
    gpu.capsules = segmentCapsules(mesh, dress.jointSegments, dress.segmentJoints);
    addDress(dress, gpu);
    return keep(std::move(gpu));
}

MeshId MeshStore::keep(std::optional<GpuMesh> gpu) {
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
