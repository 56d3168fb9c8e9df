// SPDX-License-Identifier: MIT
#include "render/passes/mesh_store.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <glm/common.hpp>

namespace posewire::render {
namespace {

/// A joint with less of a vertex than this hardly moves it.
constexpr float kNoticeableWeight = 0.2F;

/// Positions and occlusion in 1/65,535 of a cube and of all light, normals in 1/32,767: a hundredth of a
/// millimetre on a person.
struct Vertex {
    std::array<std::uint16_t, 3> position;
    std::uint16_t occlusion;
    std::array<std::int16_t, 4> normal;
    JointIndices joints;
    std::array<std::uint16_t, 4> weights;
};
static_assert(sizeof(Vertex) == kGpuVertexBytes);

constexpr float kMostShare = 65'535.0F;

std::uint16_t shareOf(float value) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * kMostShare));
}

/// Their sum is exactly 1.
std::array<std::uint16_t, 4> sharesOf(const glm::vec4& weights) {
    std::array<std::uint16_t, 4> shares{};
    int rest = static_cast<int>(kMostShare);
    for (int i = 1; i < 4; ++i) {
        shares[static_cast<std::size_t>(i)] = shareOf(weights[i]);
        rest -= shares[static_cast<std::size_t>(i)];
    }
    shares[0] = static_cast<std::uint16_t>(std::max(rest, 0));
    return shares;
}

/// In steps of a quarter of a metre, so that all levels of one body have the same.
Cube cubeAround(const SkinnedMesh& mesh) {
    constexpr float kStep = 0.25F;
    Bounds box;
    for (const glm::vec3& position : mesh.positions) {
        box.add(position);
    }
    if (box.isEmpty()) {
        return {};
    }
    const glm::vec3 low = kStep * glm::floor(box.min / kStep);
    const glm::vec3 size = box.max - low;
    const float longest = std::max({size.x, size.y, size.z, kStep});
    return {low, kStep * std::ceil(longest / kStep)};
}

void attachAttributes(GpuMesh& gpu) {
    using Kind = gl::Attribute::Kind;
    gpu.array.attach(gpu.vertices, sizeof(Vertex), {0, 4, offsetof(Vertex, position), Kind::UnsignedShare});
    gpu.array.attach(gpu.vertices, sizeof(Vertex), {1, 3, offsetof(Vertex, normal), Kind::SignedShare});
    gpu.array.attach(gpu.vertices, sizeof(Vertex), {2, 4, offsetof(Vertex, joints), Kind::ByteInteger});
    gpu.array.attach(gpu.vertices, sizeof(Vertex), {3, 4, offsetof(Vertex, weights), Kind::UnsignedShare});
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

GpuMesh upload(const SkinnedMesh& mesh, std::span<const Segment> jointSegments) {
    GpuMesh gpu;
    gpu.cube = cubeAround(mesh);
    gpu.segments.assign(jointSegments.begin(), jointSegments.end());
    std::vector<Vertex> vertices;
    vertices.reserve(mesh.vertexCount());
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        const glm::vec3 at = (mesh.positions[i] - gpu.cube.low) / gpu.cube.side;
        const glm::vec3 normal = glm::round(32'767.0F * mesh.normals[i]);
        vertices.push_back({{shareOf(at.x), shareOf(at.y), shareOf(at.z)},
                            shareOf(mesh.occlusion[i]),
                            {static_cast<std::int16_t>(normal.x), static_cast<std::int16_t>(normal.y),
                             static_cast<std::int16_t>(normal.z), 0},
                            mesh.joints[i],
                            sharesOf(mesh.weights[i])});
    }
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
        gpu.array.attach(gpu.texturePlaces, sizeof(glm::vec2), {4, 2, 0, gl::Attribute::Kind::Float});
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

MeshId MeshStore::add(const SkinnedMesh& mesh) {
    if (!mesh.validate(kJointCount)) {
        return MeshId::None;
    }
    GpuMesh gpu = upload(mesh, mannequinSegments());
    gpu.hasSuit = true;
    joinFingers(gpu);
    gpu.capsules = segmentCapsules(mesh);
    return keep(std::move(gpu));
}

MeshId MeshStore::add(const SkinnedMesh& mesh, const MeshDress& dress) {
    if (!doFit(mesh, dress)) {
        return MeshId::None;
    }
    GpuMesh gpu = upload(mesh, dress.jointSegments);
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
