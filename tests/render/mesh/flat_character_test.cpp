// SPDX-License-Identifier: MIT
#include "render/mesh/flat_character.h"

#include "render/mesh/import.h"
#include "tests/support/paths.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

namespace posewire::render {
namespace {

class FlatCharacterTest : public testing::Test {
protected:
    FlatCharacterTest() {
        auto imported = importCharacter(posewire::test::sourcePath("resources/mannequin_low.glb").string());
        EXPECT_TRUE(imported) << imported.error();
        m_character = imported.value_or(ImportedCharacter{});
        m_character.textures = {{"own.png", {}, {1, 2, 3, 4}, 1, 1, {}},
                                {"inside", {}, std::vector<std::uint8_t>(24, 7), 3, 2, {}},
                                {"gone.png", {}, {}, 0, 0, "it is not there"}};
        m_character.parts.front().texture = 2;
        m_character.texturePlaces.assign(m_character.mesh.vertexCount(), glm::vec2(0.25F, 0.75F));
        m_character.filesBeside = {"own.png"};
    }

    bool isRefused() const { return !unflatten(flatten(m_character)); }

    ImportedCharacter m_character;
};

TEST_F(FlatCharacterTest, ComesBackAsItWas) {
    const std::vector<std::byte> flat = flatten(m_character);
    const auto again = unflatten(flat);
    ASSERT_TRUE(again) << again.error();
    EXPECT_EQ(flatten(*again), flat);
    EXPECT_EQ(again->mesh.positions, m_character.mesh.positions);
    EXPECT_EQ(again->mesh.indices, m_character.mesh.indices);
    EXPECT_EQ(again->texturePlaces, m_character.texturePlaces);
    EXPECT_EQ(again->bones.back().name, m_character.bones.back().name);
    EXPECT_EQ(again->textures[1].texels, m_character.textures[1].texels);
    EXPECT_EQ(again->textures[2].problem, "it is not there");
    EXPECT_EQ(again->filesBeside, m_character.filesBeside);
}

TEST_F(FlatCharacterTest, EveryCutIsRefused) {
    const std::vector<std::byte> flat = flatten(m_character);
    for (std::size_t size = 0; size < flat.size(); size += 1 + flat.size() / 501) {
        EXPECT_FALSE(unflatten(std::span(flat).first(size))) << size;
    }
    std::vector<std::byte> longer = flat;
    longer.push_back({});
    EXPECT_FALSE(unflatten(longer));
}

TEST_F(FlatCharacterTest, CountsBeyondWhatIsThereTakeNoMemory) {
    std::vector<std::byte> flat = flatten(m_character);
    for (std::size_t field = 0; field < 7; ++field) {
        std::vector<std::byte> large = flat;
        std::memset(large.data() + 8 + 4 * field, 0xFF, 4);
        EXPECT_FALSE(unflatten(large)) << field;
    }
}

TEST_F(FlatCharacterTest, AnotherVersionIsRefused) {
    std::vector<std::byte> flat = flatten(m_character);
    flat[7] = std::byte{3};
    EXPECT_FALSE(unflatten(flat));
}

TEST_F(FlatCharacterTest, IndicesOutOfRangeAreRefused) {
    const ImportedCharacter sound = m_character;
    m_character.mesh.indices[5] = static_cast<std::uint32_t>(sound.mesh.vertexCount());
    EXPECT_TRUE(isRefused());
    m_character = sound;
    m_character.mesh.joints[0][0] = 255;
    EXPECT_TRUE(isRefused());
    m_character = sound;
    m_character.bones[1].parent = 1;
    EXPECT_TRUE(isRefused());
    m_character = sound;
    m_character.parts.front().texture = 3;
    EXPECT_TRUE(isRefused());
    m_character = sound;
    m_character.parts.front().indexCount += 3;
    EXPECT_TRUE(isRefused());
    m_character = sound;
    m_character.textures[1].width = 1 << 30;
    EXPECT_TRUE(isRefused());
    m_character = sound;
    m_character.texturePlaces.pop_back();
    EXPECT_TRUE(isRefused());
    m_character = sound;
    EXPECT_FALSE(isRefused());
}

TEST_F(FlatCharacterTest, NumbersThatAreNotFiniteAreRefused) {
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    for (float* value :
         {&m_character.mesh.positions[3].x, &m_character.mesh.normals[3].y, &m_character.mesh.occlusion[3],
          &m_character.mesh.weights[3].x, &m_character.texturePlaces[3].x, &m_character.bones[3].position.z,
          &m_character.bones[3].orientation.w, &m_character.parts[0].colour.r}) {
        const float before = std::exchange(*value, kNone);
        EXPECT_TRUE(isRefused());
        *value = before;
    }
    EXPECT_FALSE(isRefused());
}

} // namespace
} // namespace posewire::render
