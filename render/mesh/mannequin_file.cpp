// SPDX-License-Identifier: MIT
#include "render/mesh/mannequin_file.h"

#include "render/mesh/joints.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace posewire::render {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian and read in place");

constexpr std::uint32_t kBinaryChunk = 0x004E4942; // "BIN\0"
constexpr std::size_t kFileHeaderSize = 12;
constexpr std::size_t kChunkHeaderSize = 8;
constexpr std::uint32_t kMostVertices = 65536;

std::uint32_t wordAt(std::string_view bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof(word));
    return word;
}

/// The data of the binary chunk, or nothing.
std::string_view binaryChunk(std::string_view bytes) {
    if (bytes.size() < kFileHeaderSize || bytes.substr(0, 4) != "glTF") {
        return {};
    }
    bytes.remove_prefix(kFileHeaderSize);
    while (bytes.size() >= kChunkHeaderSize) {
        const std::size_t size = wordAt(bytes, 0);
        const std::uint32_t type = wordAt(bytes, 4);
        bytes.remove_prefix(kChunkHeaderSize);
        if (size > bytes.size()) {
            return {};
        }
        if (type == kBinaryChunk) {
            return bytes.substr(0, size);
        }
        bytes.remove_prefix(size);
    }
    return {};
}

template <typename Element>
std::vector<Element> arrayAt(std::string_view chunk, std::size_t offset, std::size_t count) {
    std::vector<Element> elements(count);
    std::memcpy(static_cast<void*>(elements.data()), chunk.data() + offset, count * sizeof(Element));
    return elements;
}

} // namespace

MannequinFileLayout MannequinFileLayout::of(std::size_t vertexCount, std::size_t indexCount) {
    MannequinFileLayout layout;
    layout.positions = sizeof(MannequinFileHeader);
    layout.normals = layout.positions + vertexCount * sizeof(glm::vec3);
    layout.weights = layout.normals + vertexCount * sizeof(glm::vec3);
    layout.joints = layout.weights + vertexCount * sizeof(glm::vec4);
    layout.colors = layout.joints + vertexCount * sizeof(JointIndices);
    layout.indices = layout.colors + vertexCount * 4;
    layout.end = (layout.indices + indexCount * sizeof(std::uint16_t) + 3) / 4 * 4;
    return layout;
}

tl::expected<SkinnedMesh, std::string> readMannequinFile(std::string_view bytes) {
    const std::string_view chunk = binaryChunk(bytes);
    MannequinFileHeader header{};
    if (chunk.size() < sizeof(header)) {
        return tl::make_unexpected("this is no binary glTF file");
    }
    std::memcpy(&header, chunk.data(), sizeof(header));
    if (header.magic != kMannequinMagic || header.version != kMannequinVersion) {
        return tl::make_unexpected("this glTF file is not a mannequin of this version");
    }
    const std::size_t count = header.vertexCount;
    const auto layout = MannequinFileLayout::of(count, header.indexCount);
    if (count > kMostVertices || layout.end > chunk.size()) {
        return tl::make_unexpected("the mannequin file is cut off");
    }
    SkinnedMesh mesh;
    mesh.positions = arrayAt<glm::vec3>(chunk, layout.positions, count);
    mesh.normals = arrayAt<glm::vec3>(chunk, layout.normals, count);
    mesh.weights = arrayAt<glm::vec4>(chunk, layout.weights, count);
    mesh.joints = arrayAt<JointIndices>(chunk, layout.joints, count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto level = static_cast<std::uint8_t>(chunk[layout.colors + 4 * i]);
        mesh.occlusion.push_back(static_cast<float>(level) / 255.0F);
    }
    const auto indices = arrayAt<std::uint16_t>(chunk, layout.indices, header.indexCount);
    mesh.indices.assign(indices.begin(), indices.end());
    if (const auto sound = mesh.validate(kJointCount); !sound) {
        return tl::make_unexpected(sound.error());
    }
    return mesh;
}

} // namespace posewire::render
