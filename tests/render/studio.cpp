// SPDX-License-Identifier: MIT
#include "tests/render/studio.h"

#include <algorithm>
#include <cmath>

namespace posewire::render::test {

void Studio::SetUp() {
    useSoftwareOpenGl();
    tl::expected<OffscreenRenderer, std::string> created = OffscreenRenderer::create();
    ASSERT_TRUE(created.has_value()) << "these tests need EGL (libegl1, libgl1-mesa-dri): "
                                     << created.error();
    m_offscreen.emplace(std::move(*created));
    m_mesh = loadMannequin(Detail::Medium);
    m_meshId = renderer().uploadMesh(m_mesh);
    ASSERT_NE(m_meshId, MeshId::None);
    characters.reserve(8);
    m_palettes.reserve(8);
    scene.colours = lightSceneColours();
    look(0.30F, {0.0F, 0.0F, 0.9F}, 4.6F);
}

SkinnedInstance& Studio::add(const Pose& pose, const glm::vec3& colour) {
    SkinnedInstance instance;
    instance.mesh = m_meshId;
    instance.palette = m_palettes.emplace_back(paletteOf(pose));
    instance.look.colour = colour;
    return characters.emplace_back(instance);
}

std::span<const DualQuaternion> Studio::addPalette(std::vector<DualQuaternion> palette) {
    return m_palettes.emplace_back(std::move(palette));
}

void Studio::addAxes(const Pose& pose, float length) {
    for (std::size_t segment = 0; segment < kSegmentCount; ++segment) {
        axes.push_back({pose.positions[segment], pose.orientations[segment], length});
    }
}

void Studio::look(float yaw, const glm::vec3& target, float distance) {
    scene.camera.yaw = yaw;
    scene.camera.target = target;
    scene.camera.distance = distance;
    scene.light = keyLight(scene.camera);
}

const Image& Studio::shoot(int width, int height, float pixelRatio) {
    scene.characters = characters;
    scene.axes = axes;
    return m_offscreen->render(scene, width, height, pixelRatio);
}

glm::ivec3 pixel(const Image& image, int x, int y) {
    const std::size_t offset = image.stride() * static_cast<std::size_t>(y) + 4 * static_cast<std::size_t>(x);
    const glm::ivec3 bytes{image.pixels.at(offset), image.pixels.at(offset + 1), image.pixels.at(offset + 2)};
    return image.order == PixelOrder::Rgba ? bytes : glm::ivec3(bytes.z, bytes.y, bytes.x);
}

glm::ivec3 pixelAt(const Image& image, const Camera& camera, const glm::vec3& point) {
    const float aspect = static_cast<float>(image.width) / static_cast<float>(image.height);
    const glm::vec2 screen = camera.project(point, aspect).value_or(glm::vec2(0.0F));
    const int x = static_cast<int>((0.5F + 0.5F * screen.x) * static_cast<float>(image.width));
    const int y = static_cast<int>((0.5F - 0.5F * screen.y) * static_cast<float>(image.height));
    return pixel(image, std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1));
}

} // namespace posewire::render::test
