// SPDX-License-Identifier: MIT
#include "render/passes/frame.h"

#include "render/mesh/finite.h"

#include <algorithm>
#include <cmath>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace posewire::render {
namespace {

constexpr int kTexelsPerJoint = 2;
/// Metres around the characters in the light's picture, for the soft edge of the shadow on the floor.
constexpr float kShadowMargin = 0.30F;
/// The light's picture grows in these steps, so that shadows do not shimmer while a character moves.
constexpr float kShadowStep = 0.5F;

constexpr float kFloorOpacityFromBelow = 0.25F;

bool isAboveFloor(const Camera& camera) {
    return camera.projection == Projection::Perspective ? camera.eye().z > 0.0F : camera.pitch > 0.0F;
}

/// Calls `visit` with the corners of the boxes around the joints, where the palette puts them.
template <typename Visit>
void forEachCorner(const DrawnCharacter& character, Visit visit) {
    for (std::size_t joint = 0; joint < character.mesh->jointBoxes.size(); ++joint) {
        const Bounds& box = character.mesh->jointBoxes[joint];
        const Stretch stretch = character.instance->fit.empty() ? Stretch() : character.instance->fit[joint];
        for (int corner = 0; corner < 8 && !box.isEmpty(); ++corner) {
            const glm::vec3 world =
                transformPoint(character.instance->palette[joint], stretch(box.corner(corner)));
            if (isFinite(world)) {
                visit(world);
            }
        }
    }
}

/// Null where there is none that the same palette moves.
const GpuMesh* lowMesh(const SkinnedInstance& instance, const GpuMesh& mesh, const MeshStore& meshes) {
    const GpuMesh* low = meshes.find(instance.lowMesh);
    // What the shader knows of the body holds for both.
    const bool isOfOneBody =
        low != nullptr && low->jointBoxes.size() == mesh.jointBoxes.size() && low->cube == mesh.cube;
    return isOfOneBody ? low : nullptr;
}

void findDrawable(const Scene& scene, const MeshStore& meshes, const RenderQuality& quality,
                  std::vector<DrawnCharacter>& characters) {
    characters.clear();
    int firstTexel = 0;
    for (const SkinnedInstance& instance : scene.characters) {
        const GpuMesh* mesh = meshes.find(instance.mesh);
        const std::size_t joints = mesh == nullptr ? 0 : mesh->jointBoxes.size();
        if (mesh == nullptr || instance.palette.size() < joints ||
            (!instance.fit.empty() && instance.fit.size() < joints) || !(instance.look.opacity > 0.0F)) {
            continue;
        }
        const GpuMesh* low = lowMesh(instance, *mesh, meshes);
        const GpuMesh* caster = quality.lowShadows && low != nullptr ? low : mesh;
        characters.push_back({&instance, mesh, mesh, caster, firstTexel, Bounds{}, Bounds{}});
        firstTexel += kTexelsPerJoint * static_cast<int>(mesh->jointBoxes.size());
    }
}

glm::vec3 lightDirection(const Light& light) {
    const float length = glm::length(light.towards);
    // Light from below the horizon would have no shadow on the floor.
    glm::vec3 towards = std::isfinite(length) && length > 1e-6F ? light.towards / length : glm::vec3(0, 0, 1);
    towards.z = std::max(towards.z, 0.2F);
    return glm::normalize(towards);
}

glm::mat4 lightView(const glm::vec3& towards) {
    const glm::vec3 up = std::abs(towards.z) > 0.99F ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
    return glm::lookAt(towards, glm::vec3(0.0F), up);
}

/// Fits the light's picture around the characters, in whole texels and steps.
void fitLight(Frame& frame, int shadowMapSize) {
    const glm::mat4 view = lightView(glm::vec3(frame.block.light));
    Bounds all;
    for (DrawnCharacter& character : frame.characters) {
        forEachCorner(character, [&](const glm::vec3& world) {
            character.inLight.add(glm::vec3(view * glm::vec4(world, 1.0F)));
        });
        if (!character.isGhost()) {
            all.add(character.inLight);
        }
    }
    if (all.isEmpty()) {
        return;
    }
    const glm::vec3 size = all.max - all.min;
    const float side =
        kShadowStep * std::ceil((std::max(size.x, size.y) + 2.0F * kShadowMargin) / kShadowStep) +
        kShadowStep;
    const float texel = side / static_cast<float>(shadowMapSize);
    const glm::vec3 centre = texel * glm::round(all.centre() / texel);
    const float near = -all.max.z - 0.2F;
    const float far = -all.min.z + 0.2F;
    const glm::mat4 projection = glm::ortho(centre.x - 0.5F * side, centre.x + 0.5F * side,
                                            centre.y - 0.5F * side, centre.y + 0.5F * side, near, far);
    frame.block.lightViewProjection = projection * view;
    frame.block.inverseLightViewProjection = glm::inverse(frame.block.lightViewProjection);
    frame.block.shadowRange = {side, far - near, 1.0F / static_cast<float>(shadowMapSize), 1.0F};
    for (DrawnCharacter& character : frame.characters) {
        Bounds& box = character.inLight;
        if (!box.isEmpty()) {
            box.min = (box.min - centre - kShadowMargin) / (0.5F * side);
            box.max = (box.max - centre + kShadowMargin) / (0.5F * side);
        }
    }
}

/// Of a body with a selected segment; device pixels of its height.
constexpr float kLeastWithBorder = 160.0F;

/// Where each is in the picture, and by what mesh it is drawn there.
void placeOnScreen(Frame& frame, const MeshStore& meshes, float lowBodiesBelow) {
    const glm::mat4& viewProjection = frame.block.viewProjection;
    for (DrawnCharacter& character : frame.characters) {
        bool isBehindEye = false;
        Bounds box;
        forEachCorner(character, [&](const glm::vec3& world) {
            const glm::vec4 clip = viewProjection * glm::vec4(world, 1.0F);
            isBehindEye = isBehindEye || clip.w < 0.01F;
            box.add(glm::vec3(clip) / std::max(clip.w, 0.01F));
        });
        if (isBehindEye) {
            box.min = glm::vec3(-1.0F);
            box.max = glm::vec3(1.0F);
        }
        const bool isVisible =
            !box.isEmpty() && box.min.x < 1.0F && box.max.x > -1.0F && box.min.y < 1.0F && box.max.y > -1.0F;
        if (isVisible) {
            character.onScreen = {glm::max(box.min, -1.0F), glm::min(box.max, 1.0F)};
        }
        const float height = 0.5F * (box.max.y - box.min.y) * frame.block.viewport.y;
        const GpuMesh* low = lowMesh(*character.instance, *character.mesh, meshes);
        // The border of a segment is ragged on few vertices, and only one character has a selected one.
        const bool hasBorder = selectedBit(character.instance->look) != 0;
        const float below = hasBorder ? std::min(lowBodiesBelow, kLeastWithBorder) : lowBodiesBelow;
        if (isVisible && low != nullptr && height < below) {
            character.drawn = low;
        }
    }
}

void fillColours(FrameBlock& block, const SceneColours& colours) {
    block.backgroundTop = glm::vec4(colours.backgroundTop, 1.0F);
    block.backgroundBottom = glm::vec4(colours.backgroundBottom, 1.0F);
    block.floorColour = glm::vec4(colours.floor, 1.0F);
    block.gridMajor = glm::vec4(colours.gridMajor, 1.0F);
    block.gridMinor = glm::vec4(colours.gridMinor, 1.0F);
    block.shadowColour = glm::vec4(colours.shadow, 1.0F);
    block.originColour = glm::vec4(colours.origin, 1.0F);
    block.selectionColour = glm::vec4(colours.selection, 1.0F);
    block.outlineColour = colours.outline;
}

} // namespace

int selectedBit(const CharacterLook& look) {
    const bool isSegment =
        look.selectedSegment >= 0 && look.selectedSegment < static_cast<int>(kSegmentCount);
    return isSegment ? 1 << look.selectedSegment : 0;
}

void planFrame(const Scene& scene, const Viewport& viewport, const MeshStore& meshes,
               const RenderQuality& quality, Frame& frame) {
    frame.scene = &scene;
    frame.viewport = viewport;
    findDrawable(scene, meshes, quality, frame.characters);
    frame.block = {};
    FrameBlock& block = frame.block;
    const Camera& camera = scene.camera;
    const auto width = static_cast<float>(viewport.width);
    const auto height = static_cast<float>(viewport.height);
    block.viewProjection = camera.viewProjection(width / height);
    block.eye = glm::vec4(camera.eye(), camera.projection == Projection::Perspective ? 1.0F : 0.0F);
    block.viewDirection = glm::vec4(camera.forward(), 0.0F);
    block.light = glm::vec4(lightDirection(scene.light), 0.0F);
    // From the viewer's other side, so that what the key light leaves out keeps its form.
    block.fill = glm::vec4(glm::normalize(-0.9F * camera.right() - 0.5F * camera.forward()), 0.0F);
    block.viewport = {width, height, 1.0F / width, 1.0F / height};
    const float reach = std::clamp(2.0F + 0.9F * camera.distance, 2.5F, 90.0F);
    block.floorFade = {camera.target.x, camera.target.y, 0.30F * reach, reach};
    block.style = {viewport.pixelRatio, scene.showFloor ? 1.0F : 0.0F, scene.showOrigin ? 1.0F : 0.0F,
                   isAboveFloor(camera) ? 1.0F : kFloorOpacityFromBelow};
    block.shadowRange = {1.0F, 1.0F, 1.0F, 0.0F};
    fillColours(block, scene.colours);
    fitLight(frame, quality.shadowMapSize);
    placeOnScreen(frame, meshes, quality.lowBodiesBelow);
}

} // namespace posewire::render
