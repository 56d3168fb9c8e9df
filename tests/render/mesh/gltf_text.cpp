// SPDX-License-Identifier: MIT
#include "tests/render/mesh/gltf_text.h"

#include <span>
#include <string_view>

namespace posewire::render::test {
namespace {

constexpr int kFloat = 5126;
constexpr int kUnsignedByte = 5121;

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            group = group << 8U | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k <= bytes.size() ? kDigits[group >> (18U - 6U * k) & 63U] : '=';
        }
    }
    return text;
}

/// The binary buffer, and the lists that describe it.
struct Buffer {
    std::string bytes;
    std::string views;
    std::string accessors;
    int count = 0;

    /// Returns the index of the accessor.
    template <typename Element>
    int add(std::span<const Element> elements, int componentType, const std::string& type, int elementCount) {
        const std::string comma = count > 0 ? "," : "";
        views += comma + "{\"buffer\":0,\"byteOffset\":" + std::to_string(bytes.size()) +
                 ",\"byteLength\":" + std::to_string(elements.size_bytes()) + "}";
        accessors += comma + "{\"bufferView\":" + std::to_string(count) +
                     ",\"componentType\":" + std::to_string(componentType) + ",\"type\":\"" + type +
                     "\",\"count\":" + std::to_string(elementCount) + "}";
        bytes.append(reinterpret_cast<const char*>(elements.data()), elements.size_bytes());
        return count++;
    }
};

template <typename Value, std::size_t Size>
std::vector<Value> threeTimes(const std::array<Value, Size>& values) {
    std::vector<Value> all;
    for (int vertex = 0; vertex < 3; ++vertex) {
        all.insert(all.end(), values.begin(), values.end());
    }
    return all;
}

std::string primitive(const GltfText::Triangle& triangle, Buffer& buffer) {
    const auto attribute = [&](const std::string& name, const auto& values, int type,
                               const std::string& shape) {
        return "\"" + name + "\":" + std::to_string(buffer.add(std::span(values), type, shape, 3));
    };
    const std::span<const float> positions(triangle.positions);
    std::string text = attribute("POSITION", positions, kFloat, "VEC3");
    const std::vector<std::uint8_t> joints = threeTimes(triangle.joints);
    text += "," + attribute("JOINTS_0", std::span<const std::uint8_t>(joints), kUnsignedByte, "VEC4");
    const std::vector<float> weights = threeTimes(triangle.weights);
    text += "," + attribute("WEIGHTS_0", std::span<const float>(weights), kFloat, "VEC4");
    if (triangle.red >= 0.0F) {
        const std::vector<float> colours = threeTimes(std::array{triangle.red, 0.0F, 0.0F, 1.0F});
        text += "," + attribute("COLOR_0", std::span<const float>(colours), kFloat, "VEC4");
    }
    if (triangle.hasNormals) {
        const std::vector<float> normals = threeTimes(std::array{0.0F, 0.0F, 1.0F});
        text += "," + attribute("NORMAL", std::span<const float>(normals), kFloat, "VEC3");
    }
    return "{\"primitives\":[{\"attributes\":{" + text + "}}]}";
}

} // namespace

std::string GltfText::text() const {
    Buffer buffer;
    std::string nodes;
    std::string joints;
    std::string meshList;
    for (int bone = 0; bone < boneCount; ++bone) {
        const std::string comma = bone > 0 ? "," : "";
        nodes += comma + "{\"name\":\"bone" + std::to_string(bone) + "\",\"translation\":[0,1,0]";
        nodes += bone + 1 < boneCount ? ",\"children\":[" + std::to_string(bone + 1) + "]}" : "}";
        joints += comma + std::to_string(bone);
    }
    std::string roots = "0";
    for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
        meshList += (mesh > 0 ? "," : "") + primitive(meshes[mesh], buffer);
        nodes += ",{\"name\":\"mesh" + std::to_string(mesh) + "\",\"mesh\":" + std::to_string(mesh) +
                 ",\"skin\":0}";
        roots += "," + std::to_string(static_cast<std::size_t>(boneCount) + mesh);
    }
    // The bind pose is the rest pose: bone n is at a height of n + 1.
    std::vector<float> inverseBinds;
    for (int bone = 0; bone < boneCount; ++bone) {
        inverseBinds.insert(inverseBinds.end(),
                            {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -static_cast<float>(bone + 1), 0, 1});
    }
    const int binds = buffer.add(std::span<const float>(inverseBinds), kFloat, "MAT4", boneCount);
    return "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[" + roots +
           "]}],\"nodes\":[" + nodes + "],\"meshes\":[" + meshList + "],\"skins\":[{\"joints\":[" + joints +
           "],\"inverseBindMatrices\":" + std::to_string(binds) + "}],\"bufferViews\":[" + buffer.views +
           "],\"accessors\":[" + buffer.accessors +
           "],\"buffers\":[{\"byteLength\":" + std::to_string(buffer.bytes.size()) +
           ",\"uri\":\"data:application/octet-stream;base64," + base64(buffer.bytes) + "\"}]}";
}

} // namespace posewire::render::test
