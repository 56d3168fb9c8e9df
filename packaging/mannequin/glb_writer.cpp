// SPDX-License-Identifier: MIT
#include "packaging/mannequin/glb_writer.h"

#include "render/mesh/joints.h"
#include "render/mesh/mannequin_file.h"

#include <cmath>
#include <cstring>

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>

namespace posewire::render::mannequin {
namespace {

using nlohmann::json;

// Numbers of the glTF 2.0 specification.
constexpr int kUnsignedByte = 5121;
constexpr int kUnsignedShort = 5123;
constexpr int kFloat = 5126;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;

constexpr std::size_t kFirstJointNode = 2;

template <typename Element>
void put(std::string& bytes, const std::vector<Element>& elements) {
    const std::size_t start = bytes.size();
    bytes.resize(start + elements.size() * sizeof(Element));
    std::memcpy(bytes.data() + start, elements.data(), elements.size() * sizeof(Element));
}

void putWord(std::string& bytes, std::size_t value) {
    put(bytes, std::vector<std::uint32_t>{static_cast<std::uint32_t>(value)});
}

void pad(std::string& bytes, char filler) {
    bytes.resize((bytes.size() + 3) / 4 * 4, filler);
}

std::string binaryOf(const SkinnedMesh& mesh) {
    std::string bytes;
    putWord(bytes, kMannequinMagic);
    putWord(bytes, kMannequinVersion);
    putWord(bytes, mesh.vertexCount());
    putWord(bytes, mesh.indices.size());
    put(bytes, mesh.positions);
    put(bytes, mesh.normals);
    put(bytes, mesh.weights);
    put(bytes, mesh.joints);
    for (const float occlusion : mesh.occlusion) {
        const auto level = static_cast<char>(static_cast<std::uint8_t>(std::lround(occlusion * 255.0F)));
        bytes.append({level, level, level, '\xFF'});
    }
    put(bytes, std::vector<std::uint16_t>(mesh.indices.begin(), mesh.indices.end()));
    pad(bytes, '\0');
    std::vector<glm::mat4> inverseBinds(kJointCount, glm::mat4(1.0F));
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
        inverseBinds[joint][3] = glm::vec4(-jointOrigin(joint), 1.0F);
    }
    put(bytes, inverseBinds);
    return bytes;
}

json vectorOf(const glm::vec3& v) {
    return json::array({v.x, v.y, v.z});
}

json nodes() {
    const float half = std::sqrt(0.5F);
    json list = json::array();
    list.push_back({{"name", "root"}, {"rotation", {-half, 0.0F, 0.0F, half}}, {"children", {2, 1}}});
    list.push_back({{"name", "mannequin"}, {"mesh", 0}, {"skin", 0}});
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
        const int parent = jointParent(joint);
        const glm::vec3 origin = jointOrigin(joint);
        const glm::vec3 offset = parent < 0 ? origin : origin - jointOrigin(static_cast<std::size_t>(parent));
        list.push_back({{"name", kJointNames[joint]}, {"translation", vectorOf(offset)}});
    }
    for (std::size_t joint = 1; joint < kJointCount; ++joint) {
        const auto parent = static_cast<std::size_t>(jointParent(joint));
        list[kFirstJointNode + parent]["children"].push_back(kFirstJointNode + joint);
    }
    return list;
}

/// Appends a view and an accessor; both get the same index.
void describe(json& file, const json& view, json accessor) {
    accessor["bufferView"] = file["bufferViews"].size();
    file["bufferViews"].push_back(view);
    file["accessors"].push_back(std::move(accessor));
}

void describeArrays(json& file, const SkinnedMesh& mesh) {
    const auto layout = MannequinFileLayout::of(mesh.vertexCount(), mesh.indices.size());
    const std::size_t count = mesh.vertexCount();
    const auto vertices = [&](std::size_t offset, std::size_t end, json accessor) {
        accessor["count"] = count;
        describe(
            file,
            {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", end - offset}, {"target", kArrayBuffer}},
            std::move(accessor));
    };
    glm::vec3 low = mesh.positions.front();
    glm::vec3 high = low;
    for (const glm::vec3& position : mesh.positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    vertices(layout.positions, layout.normals,
             {{"componentType", kFloat}, {"type", "VEC3"}, {"min", vectorOf(low)}, {"max", vectorOf(high)}});
    vertices(layout.normals, layout.weights, {{"componentType", kFloat}, {"type", "VEC3"}});
    vertices(layout.weights, layout.joints, {{"componentType", kFloat}, {"type", "VEC4"}});
    vertices(layout.joints, layout.colors, {{"componentType", kUnsignedByte}, {"type", "VEC4"}});
    vertices(layout.colors, layout.indices,
             {{"componentType", kUnsignedByte}, {"type", "VEC4"}, {"normalized", true}});
    describe(file,
             {{"buffer", 0},
              {"byteOffset", layout.indices},
              {"byteLength", mesh.indices.size() * sizeof(std::uint16_t)},
              {"target", kElementArrayBuffer}},
             {{"componentType", kUnsignedShort}, {"type", "SCALAR"}, {"count", mesh.indices.size()}});
    describe(file,
             {{"buffer", 0}, {"byteOffset", layout.end}, {"byteLength", kJointCount * sizeof(glm::mat4)}},
             {{"componentType", kFloat}, {"type", "MAT4"}, {"count", kJointCount}});
}

std::string descriptionOf(const SkinnedMesh& mesh, std::size_t binarySize) {
    json file;
    file["asset"] = {{"version", "2.0"}, {"generator", "Posewire mannequin_generator"}};
    file["scene"] = 0;
    file["scenes"] = json::array({{{"nodes", {0}}}});
    file["nodes"] = nodes();
    file["bufferViews"] = json::array();
    file["accessors"] = json::array();
    describeArrays(file, mesh);
    const json attributes{{"POSITION", 0}, {"NORMAL", 1}, {"WEIGHTS_0", 2}, {"JOINTS_0", 3}, {"COLOR_0", 4}};
    file["meshes"] = json::array(
        {{{"name", "mannequin"},
          {"primitives", json::array({{{"attributes", attributes}, {"indices", 5}, {"material", 0}}})}}});
    file["materials"] = json::array({{{"name", "suit"},
                                      {"pbrMetallicRoughness",
                                       {{"baseColorFactor", {0.80, 0.80, 0.82, 1.0}},
                                        {"metallicFactor", 0.0},
                                        {"roughnessFactor", 0.55}}}}});
    json joints = json::array();
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
        joints.push_back(kFirstJointNode + joint);
    }
    file["skins"] =
        json::array({{{"joints", joints}, {"inverseBindMatrices", 6}, {"skeleton", kFirstJointNode}}});
    file["buffers"] = json::array({{{"byteLength", binarySize}}});
    return file.dump();
}

} // namespace

std::string glbOf(const SkinnedMesh& mesh) {
    const std::string binary = binaryOf(mesh);
    std::string description = descriptionOf(mesh, binary.size());
    pad(description, ' ');
    std::string bytes = "glTF";
    putWord(bytes, 2);
    putWord(bytes, 12 + 8 + description.size() + 8 + binary.size());
    putWord(bytes, description.size());
    bytes += "JSON" + description;
    putWord(bytes, binary.size());
    bytes += std::string("BIN\0", 4) + binary;
    return bytes;
}

} // namespace posewire::render::mannequin
