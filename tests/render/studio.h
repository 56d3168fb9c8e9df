// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/mannequin.h"
#include "render/offscreen.h"
#include "tests/render/poses.h"
#include "tests/support/baseline.h"

#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace posewire::render::test {

inline constexpr glm::vec3 kBlue{0.20F, 0.45F, 0.75F};
inline constexpr glm::vec3 kOrange{0.914F, 0.392F, 0.090F};
inline constexpr int kWidth = 640;
inline constexpr int kHeight = 480;

/// A renderer with the mannequin and one scene that tests fill; a test fails where EGL gives no context.
class Studio : public ::testing::Test {
protected:
    void SetUp() override;

    Renderer& renderer() { return m_offscreen->renderer(); }
    const SkinnedMesh& mesh() const { return m_mesh; }
    MeshId meshId() const { return m_meshId; }

    /// Adds a character to the scene; the reference stays good until the test ends.
    SkinnedInstance& add(const Pose& pose, const glm::vec3& colour = kBlue);
    /// Keeps a palette for as long as the test runs.
    std::span<const DualQuaternion> addPalette(std::vector<DualQuaternion> palette);
    void addAxes(const Pose& pose, float length = 0.12F);
    /// The characters' camera of the sketches, with the light over the right shoulder.
    void look(float yaw, const glm::vec3& target, float distance);
    const Image& shoot(int width = kWidth, int height = kHeight, float pixelRatio = 1.0F);

    Scene scene;
    std::vector<SkinnedInstance> characters;
    std::vector<AxesInstance> axes;

private:
    std::optional<OffscreenRenderer> m_offscreen;
    SkinnedMesh m_mesh;
    MeshId m_meshId = MeshId::None;
    std::vector<std::vector<DualQuaternion>> m_palettes;
};

/// Red, green and blue of a pixel, from the top left.
glm::ivec3 pixel(const Image& image, int x, int y);
/// The pixel at which a point appears.
glm::ivec3 pixelAt(const Image& image, const Camera& camera, const glm::vec3& point);

} // namespace posewire::render::test
