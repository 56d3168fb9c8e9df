// SPDX-License-Identifier: MIT
#include "render/scene.h"

namespace posewire::render {
namespace {

constexpr glm::vec3 rgb(unsigned value) {
    return {static_cast<float>((value >> 16U) & 255U) / 255.0F,
            static_cast<float>((value >> 8U) & 255U) / 255.0F, static_cast<float>(value & 255U) / 255.0F};
}

constexpr SceneColours kDark{
    .backgroundTop = rgb(0x26292d),
    .backgroundBottom = rgb(0x2f3237),
    .floor = rgb(0x43474e),
    .gridMajor = rgb(0x6b717a),
    .gridMinor = rgb(0x555a62),
    .shadow = rgb(0x1b1d20),
    .origin = rgb(0xd03a35),
    .selection = rgb(0x4c9bff),
    .axisX = rgb(0xeb4034),
    .axisY = rgb(0x3cbe5a),
    .axisZ = rgb(0x4082f6),
    .outline = {0.05F, 0.06F, 0.07F, 0.35F},
};

constexpr SceneColours kLight{
    .backgroundTop = rgb(0xf3f5f9),
    .backgroundBottom = rgb(0xebeef3),
    .floor = rgb(0xd6dbe2),
    .gridMajor = rgb(0xa3abb6),
    .gridMinor = rgb(0xbec5ce),
    .shadow = rgb(0x757d89),
    .origin = rgb(0xdc4340),
    .selection = rgb(0x1f6feb),
    .axisX = rgb(0xeb4034),
    .axisY = rgb(0x3cbe5a),
    .axisZ = rgb(0x4082f6),
    .outline = {0.10F, 0.12F, 0.15F, 0.26F},
};

} // namespace

SceneColours darkSceneColours() {
    return kDark;
}

SceneColours lightSceneColours() {
    return kLight;
}

Light keyLight(const Camera& camera) {
    const glm::vec3 right = camera.right();
    const glm::vec3 towardsEye = glm::cross(right, glm::vec3(0.0F, 0.0F, 1.0F));
    return {1.2F * towardsEye + 1.1F * right + glm::vec3(0.0F, 0.0F, 1.9F)};
}

} // namespace posewire::render
