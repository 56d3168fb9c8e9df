// SPDX-License-Identifier: MIT
#pragma once

#include "render/passes/mesh_store.h"
#include "render/renderer.h"

#include <vector>

#include <glm/mat4x4.hpp>

namespace posewire::render {

/// The uniform block Frame of frame.glsl, member by member (std140).
struct FrameBlock {
    glm::mat4 viewProjection{1.0F};
    glm::mat4 lightViewProjection{1.0F};
    glm::mat4 inverseLightViewProjection{1.0F};
    glm::vec4 eye{0.0F};
    glm::vec4 viewDirection{0.0F};
    glm::vec4 light{0.0F};
    glm::vec4 fill{0.0F};
    glm::vec4 viewport{0.0F};
    glm::vec4 floorFade{0.0F};
    glm::vec4 shadowRange{0.0F};
    glm::vec4 style{0.0F};
    glm::vec4 backgroundTop{0.0F};
    glm::vec4 backgroundBottom{0.0F};
    glm::vec4 floorColour{0.0F};
    glm::vec4 gridMajor{0.0F};
    glm::vec4 gridMinor{0.0F};
    glm::vec4 shadowColour{0.0F};
    glm::vec4 originColour{0.0F};
    glm::vec4 selectionColour{0.0F};
    glm::vec4 outlineColour{0.0F};
};

/// A character that can be drawn, and where it appears.
struct DrawnCharacter {
    const SkinnedInstance* instance = nullptr;
    /// Its own, and what its picture and its shadow are drawn by: the same or the low one.
    const GpuMesh* mesh = nullptr;
    const GpuMesh* drawn = nullptr;
    const GpuMesh* caster = nullptr;
    /// Of its own in the buffers of Palettes.
    int firstTexel = 0;
    /// Device coordinates of the light's picture, z unused.
    Bounds inLight;
    /// Device coordinates of the picture, clamped to it; empty where the character is out of sight.
    Bounds onScreen;

    bool isGhost() const { return instance->look.opacity < 1.0F; }
    bool isSolid() const { return !isGhost() && !onScreen.isEmpty(); }
    bool castsShadow() const { return !isGhost() && !inLight.isEmpty(); }
};

/// The selected segment as a bit; 0 where there is none.
int selectedBit(const CharacterLook& look);

/// Everything the passes share for one picture, worked out once.
struct Frame {
    const Scene* scene = nullptr;
    Viewport viewport;
    std::vector<DrawnCharacter> characters;
    FrameBlock block;
};

/// Fills a frame, which keeps the room that it had.
void planFrame(const Scene& scene, const Viewport& viewport, const MeshStore& meshes,
               const RenderQuality& quality, Frame& frame);

} // namespace posewire::render
