// SPDX-License-Identifier: MIT
#include "render/mesh/flat_character.h"

#include "render/mesh/finite.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace posewire::render {
namespace {

constexpr std::array<char, 8> kMagic{'P', 'W', 'C', 'H', 'A', 'R', 0, 2};

static_assert(sizeof(glm::vec2) == 8 && sizeof(glm::vec3) == 12 && sizeof(glm::vec4) == 16 &&
              sizeof(JointIndices) == 4);

enum Flag : std::uint32_t { HasColour = 1, TwoSided = 2, Masked = 4 };

class FlatWriter {
public:
    template <class T>
    void number(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes(&value, sizeof(T));
    }
    void count(std::size_t value) { number(static_cast<std::uint32_t>(value)); }
    template <class T>
    void array(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes(values.data(), values.size() * sizeof(T));
    }
    void text(std::string_view value) {
        value = value.substr(0, kLongestFlatText);
        count(value.size());
        bytes(value.data(), value.size());
    }
    std::vector<std::byte> take() { return std::move(m_flat); }

private:
    void bytes(const void* from, std::size_t size) {
        const auto* first = static_cast<const std::byte*>(from);
        m_flat.insert(m_flat.end(), first, first + size);
    }

    std::vector<std::byte> m_flat;
};

/// Reads zeros and empty arrays from the first thing on that is not there.
class FlatReader {
public:
    explicit FlatReader(std::span<const std::byte> flat) : m_rest(flat) {}

    template <class T>
    T number() {
        T value{};
        if (has(sizeof(T))) {
            std::memcpy(&value, m_rest.data(), sizeof(T));
            m_rest = m_rest.subspan(sizeof(T));
        }
        return value;
    }
    std::size_t count(std::size_t most) {
        const std::size_t value = number<std::uint32_t>();
        m_isSound = m_isSound && value <= most;
        return m_isSound ? value : 0;
    }
    template <class T>
    std::vector<T> array(std::size_t count) {
        std::vector<T> values;
        if (count != 0 && has(count * sizeof(T))) {
            values.resize(count);
            std::memcpy(values.data(), m_rest.data(), count * sizeof(T));
            m_rest = m_rest.subspan(count * sizeof(T));
        }
        return values;
    }
    std::string text() {
        const std::vector<char> characters = array<char>(count(kLongestFlatText));
        return {characters.begin(), characters.end()};
    }
    [[nodiscard]] bool isSound() const { return m_isSound; }
    [[nodiscard]] bool isAtEnd() const { return m_isSound && m_rest.empty(); }

private:
    bool has(std::size_t size) {
        m_isSound = m_isSound && m_rest.size() >= size;
        return m_isSound;
    }

    std::span<const std::byte> m_rest;
    bool m_isSound = true;
};

MeshPart partFrom(FlatReader& in) {
    MeshPart part;
    part.firstIndex = in.number<std::uint32_t>();
    part.indexCount = in.number<std::uint32_t>();
    part.colour = in.number<glm::vec3>();
    part.texture = in.number<std::int32_t>();
    const std::size_t flags = in.count(HasColour | TwoSided | Masked);
    part.hasColour = (flags & HasColour) != 0;
    part.isTwoSided = (flags & TwoSided) != 0;
    part.isMasked = (flags & Masked) != 0;
    return part;
}

ImportedBone boneFrom(FlatReader& in) {
    ImportedBone bone;
    bone.parent = in.number<std::int32_t>();
    bone.position = in.number<glm::vec3>();
    const auto turn = in.number<std::array<float, 4>>();
    bone.orientation = glm::quat(turn[0], turn[1], turn[2], turn[3]);
    bone.hasWeights = in.count(1) != 0;
    bone.name = in.text();
    return bone;
}

/// Both are 0 if there is no picture.
bool isSize(int width, int height) {
    return (width == 0) == (height == 0) && std::min(width, height) >= 0 &&
           std::max(width, height) <= kMostTextureSide;
}

ImportedTexture textureFrom(FlatReader& in) {
    ImportedTexture texture;
    texture.width = in.number<std::int32_t>();
    texture.height = in.number<std::int32_t>();
    if (isSize(texture.width, texture.height)) {
        texture.texels = in.array<std::uint8_t>(texelBytes(texture.width, texture.height));
    }
    texture.name = in.text();
    texture.problem = in.text();
    return texture;
}

bool isSound(const ImportedTexture& texture) {
    return texture.encoded.empty() && isSize(texture.width, texture.height) &&
           texture.texels.size() <= kMostTextureBytes &&
           texture.texels.size() == texelBytes(texture.width, texture.height);
}

bool areSound(const std::vector<ImportedTexture>& textures) {
    std::size_t bytes = 0;
    for (const ImportedTexture& texture : textures) {
        bytes += texture.texels.size();
        if (!isSound(texture)) {
            return false;
        }
    }
    return bytes <= kMostTexturesBytes;
}

bool areSound(const std::vector<ImportedBone>& bones) {
    for (std::size_t i = 0; i < bones.size(); ++i) {
        const ImportedBone& bone = bones[i];
        const float length = glm::dot(bone.orientation, bone.orientation);
        if (bone.parent < -1 || bone.parent >= static_cast<int>(i) || !isFinite(bone.position) ||
            !(std::abs(length - 1.0F) <= 1e-3F)) {
            return false;
        }
    }
    return bones.size() <= kMostImportedBones;
}

bool arePartsSound(const ImportedCharacter& character) {
    std::size_t end = 0;
    for (const MeshPart& part : character.parts) {
        const bool isColour = part.colour.r >= 0.0F && part.colour.r <= 1.0F && part.colour.g >= 0.0F &&
                              part.colour.g <= 1.0F && part.colour.b >= 0.0F && part.colour.b <= 1.0F;
        if (part.firstIndex != end || part.indexCount % 3 != 0 || !isColour || part.texture < -1 ||
            part.texture >= static_cast<int>(character.textures.size())) {
            return false;
        }
        end += part.indexCount;
    }
    return end == character.mesh.indices.size();
}

bool arePlacesSound(const ImportedCharacter& character) {
    const auto isFinitePlace = [](const glm::vec2& place) {
        return std::isfinite(place.x) && std::isfinite(place.y);
    };
    return (character.texturePlaces.empty() ||
            character.texturePlaces.size() == character.mesh.vertexCount()) &&
           std::ranges::all_of(character.texturePlaces, isFinitePlace);
}

} // namespace

tl::expected<void, std::string> validate(const ImportedCharacter& character) {
    if (character.mesh.vertexCount() > kMostImportedVertices) {
        return tl::make_unexpected("the file has more than 500,000 vertices");
    }
    if (character.mesh.indices.size() > 3 * kMostImportedTriangles) {
        return tl::make_unexpected("the file has more than 2,000,000 triangles");
    }
    if (std::max({character.parts.size(), character.textures.size(), character.filesBeside.size()}) >
        kMostImportedParts) {
        return tl::make_unexpected("the file has more than 4,096 parts");
    }
    if (!areSound(character.bones)) {
        return tl::make_unexpected("the bones of the file are damaged");
    }
    if (!areSound(character.textures) || !arePlacesSound(character)) {
        return tl::make_unexpected("the textures of the file are damaged");
    }
    if (!arePartsSound(character)) {
        return tl::make_unexpected("the materials of the file are damaged");
    }
    return character.mesh.validate(character.bones.size());
}

std::vector<std::byte> flatten(const ImportedCharacter& character) {
    const SkinnedMesh& mesh = character.mesh;
    FlatWriter out;
    out.number(kMagic);
    for (const std::size_t count :
         {mesh.vertexCount(), mesh.indices.size(), character.texturePlaces.size(), character.parts.size(),
          character.textures.size(), character.bones.size(), character.filesBeside.size()}) {
        out.count(count);
    }
    out.array(mesh.positions);
    out.array(mesh.normals);
    out.array(mesh.occlusion);
    out.array(mesh.joints);
    out.array(mesh.weights);
    out.array(character.texturePlaces);
    out.array(mesh.indices);
    for (const MeshPart& part : character.parts) {
        out.number(part.firstIndex);
        out.number(part.indexCount);
        out.number(part.colour);
        out.number(static_cast<std::int32_t>(part.texture));
        out.count((part.hasColour ? HasColour : 0U) | (part.isTwoSided ? TwoSided : 0U) |
                  (part.isMasked ? Masked : 0U));
    }
    for (const ImportedBone& bone : character.bones) {
        const glm::quat& turn = bone.orientation;
        out.number(static_cast<std::int32_t>(bone.parent));
        out.number(bone.position);
        out.number(std::array<float, 4>{turn.w, turn.x, turn.y, turn.z});
        out.count(bone.hasWeights ? 1 : 0);
        out.text(bone.name);
    }
    for (const ImportedTexture& texture : character.textures) {
        out.number(static_cast<std::int32_t>(texture.width));
        out.number(static_cast<std::int32_t>(texture.height));
        out.array(texture.texels);
        out.text(texture.name);
        out.text(texture.problem);
    }
    for (const std::string& file : character.filesBeside) {
        out.text(file);
    }
    return out.take();
}

tl::expected<ImportedCharacter, std::string> unflatten(std::span<const std::byte> flat) {
    FlatReader in(flat);
    const bool isOurs = flat.size() <= kMostFlatBytes && in.number<std::array<char, 8>>() == kMagic;
    if (!isOurs) {
        return tl::make_unexpected("it is no character in the flat form");
    }
    const std::size_t vertices = in.count(kMostImportedVertices);
    const std::size_t indices = in.count(3 * kMostImportedTriangles);
    const std::size_t places = in.count(kMostImportedVertices);
    const std::size_t parts = in.count(kMostImportedParts);
    const std::size_t textures = in.count(kMostImportedParts);
    const std::size_t bones = in.count(kMostImportedBones);
    const std::size_t filesBeside = in.count(kMostImportedParts);
    ImportedCharacter character;
    character.mesh.positions = in.array<glm::vec3>(vertices);
    character.mesh.normals = in.array<glm::vec3>(vertices);
    character.mesh.occlusion = in.array<float>(vertices);
    character.mesh.joints = in.array<JointIndices>(vertices);
    character.mesh.weights = in.array<glm::vec4>(vertices);
    character.texturePlaces = in.array<glm::vec2>(places);
    character.mesh.indices = in.array<std::uint32_t>(indices);
    for (std::size_t i = 0; i < parts && in.isSound(); ++i) {
        character.parts.push_back(partFrom(in));
    }
    for (std::size_t i = 0; i < bones && in.isSound(); ++i) {
        character.bones.push_back(boneFrom(in));
    }
    for (std::size_t i = 0; i < textures && in.isSound(); ++i) {
        character.textures.push_back(textureFrom(in));
    }
    for (std::size_t i = 0; i < filesBeside && in.isSound(); ++i) {
        character.filesBeside.push_back(in.text());
    }
    if (!in.isAtEnd()) {
        return tl::make_unexpected("the flat character is cut short or has more than it says");
    }
    if (const auto sound = validate(character); !sound) {
        return tl::make_unexpected(sound.error());
    }
    return character;
}

} // namespace posewire::render
