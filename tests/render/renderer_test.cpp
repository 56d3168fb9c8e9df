// SPDX-License-Identifier: MIT
#include "tests/render/studio.h"

#include "render/gl/program.h"

#include <algorithm>
#include <array>
#include <limits>
#include <thread>

namespace posewire::render::testing {
namespace {

using RendererTest = Studio;

float largestDistance(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
    float largest = 0.0F;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, glm::length(a[i] - b[i]));
    }
    return largest;
}

TEST_F(RendererTest, SkinsAsTheReferenceOnTheProcessorDoes) {
    for (const Pose& pose : {tPose(), lungePose(), squatPose(), elbowPose()}) {
        const std::vector<DualQuaternion> palette = paletteOf(placed(pose, {2.0F, -1.0F, 0.3F}, 2.5F));
        std::vector<glm::vec3> positions(mesh().vertexCount());
        std::vector<glm::vec3> normals(mesh().vertexCount());
        SkinJob{&mesh(), palette, positions, normals}.run();
        const std::vector<glm::vec3> drawn = renderer().skinnedPositions(meshId(), palette);
        ASSERT_EQ(drawn.size(), positions.size());
        EXPECT_LT(largestDistance(drawn, positions), 1e-5F);
    }
}

TEST_F(RendererTest, DrawsOnSoftwareOpenGlWithoutMultisampling) {
    EXPECT_TRUE(isSoftwareRenderer(renderer().rendererName())) << renderer().rendererName();
    EXPECT_EQ(renderer().quality(), interactiveQuality(renderer().rendererName()));
    EXPECT_LT(renderer().quality().samples, 2);
    EXPECT_TRUE(renderer().quality().edgeSmoothing);
}

TEST_F(RendererTest, LeavesOutWhatCannotBeDrawn) {
    const Image empty = shoot();
    SkinnedInstance& unknown = add(tPose());
    unknown.mesh = static_cast<MeshId>(77);
    SkinnedInstance& cut = add(tPose());
    cut.palette = cut.palette.first(kSegmentCount);
    SkinnedInstance& invisible = add(tPose());
    invisible.look.opacity = 0.0F;
    EXPECT_EQ(shoot().pixels, empty.pixels);
}

TEST_F(RendererTest, SurvivesPalettesThatAreNotFinite) {
    const Image empty = shoot();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<DualQuaternion> broken(kJointCount, {glm::vec4(kNan), glm::vec4(kNan)});
    add(tPose()).palette = broken;
    EXPECT_EQ(compareImages(shoot(), empty, 2).shareBeyond, 0.0);
}

TEST_F(RendererTest, RefusesMeshesThatDoNotHoldTogether) {
    SkinnedMesh broken = mesh();
    broken.indices.back() = static_cast<std::uint32_t>(broken.vertexCount());
    EXPECT_EQ(renderer().uploadMesh(broken, broken.positions), MeshId::None);
    EXPECT_EQ(renderer().uploadMesh(mesh(), std::span(mesh().positions).first(3)), MeshId::None);
}

TEST_F(RendererTest, ForgetsReleasedMeshes) {
    const Image empty = shoot();
    add(tPose());
    EXPECT_NE(shoot().pixels, empty.pixels);
    renderer().releaseMesh(meshId());
    renderer().releaseMesh(meshId());
    renderer().releaseMesh(MeshId::None);
    EXPECT_EQ(shoot().pixels, empty.pixels);
    EXPECT_TRUE(renderer().skinnedPositions(meshId(), characters[0].palette).empty());
}

TEST_F(RendererTest, ThrowsTheShadowAwayFromTheLight) {
    add(tPose());
    scene.camera = facing(scene.camera, StandardView::Top);
    scene.camera.projection = Projection::Orthographic;
    scene.light.towards = {1.0F, 0.0F, 1.0F};
    const Image& image = shoot();
    // The chest is about 1.3 m high, and the light comes down at 45°.
    const glm::ivec3 shadow = pixelAt(image, scene.camera, {-1.31F, 0.06F, 0.0F});
    const glm::ivec3 open = pixelAt(image, scene.camera, {1.31F, 0.06F, 0.0F});
    EXPECT_LT(shadow.y + 40, open.y);
}

TEST_F(RendererTest, DarkensTheFloorUnderTheFeet) {
    scene.showOrigin = false;
    scene.light.towards = {0.0F, 0.0F, 1.0F};
    look(0.0F, {0.0F, 0.0F, 0.1F}, 2.0F);
    const Image open = shoot();
    add(grounded(tPose(), mesh()));
    const Image& image = shoot();
    const glm::vec3 beforeTheToes{0.24F, 0.084F, 0.0F};
    EXPECT_LT(pixelAt(image, scene.camera, beforeTheToes).y + 8,
              pixelAt(open, scene.camera, beforeTheToes).y);
}

TEST_F(RendererTest, PutsTheTriangleAtTheOriginAlongX) {
    scene.camera = facing(scene.camera, StandardView::Top);
    scene.camera.target = {0.0F, 0.0F, 0.0F};
    const Image& image = shoot();
    const glm::ivec3 inside = pixelAt(image, scene.camera, {0.08F, 0.0F, 0.0F});
    EXPECT_GT(inside.x, inside.y + 100);
    for (const glm::vec3 point : {glm::vec3(-0.05F, 0.0F, 0.0F), glm::vec3(0.3F, 0.03F, 0.0F)}) {
        const glm::ivec3 outside = pixelAt(image, scene.camera, point);
        EXPECT_LT(std::abs(outside.x - outside.y), 30);
    }
}

TEST_F(RendererTest, DrawsAxesInTheirColours) {
    axes.push_back({{0.0F, 0.0F, 1.0F}, glm::quat(1.0F, 0.0F, 0.0F, 0.0F), 0.4F});
    scene.axesWidth = 5.0F;
    const Image& image = shoot();
    const glm::ivec3 x = pixelAt(image, scene.camera, {0.2F, 0.0F, 1.0F});
    const glm::ivec3 y = pixelAt(image, scene.camera, {0.0F, 0.2F, 1.0F});
    const glm::ivec3 z = pixelAt(image, scene.camera, {0.0F, 0.0F, 1.2F});
    EXPECT_TRUE(x.x > 200 && x.y < 90 && x.z < 90) << x.x << ' ' << x.y << ' ' << x.z;
    EXPECT_TRUE(y.y > 160 && y.x < 90 && y.z < 120) << y.x << ' ' << y.y << ' ' << y.z;
    EXPECT_TRUE(z.z > 200 && z.x < 100 && z.y < 160) << z.x << ' ' << z.y << ' ' << z.z;
}

TEST_F(RendererTest, HidesLinesBehindABodyUnlessTheyShowThrough) {
    add(tPose());
    const Image without = shoot();
    std::array<LineInstance, 1> line{
        {{{-0.5F, -0.4F, 1.2F}, {-0.5F, 0.4F, 1.2F}, glm::vec4(1, 0, 1, 1), 6.0F, 0.0F}}};
    scene.lines = line;
    const glm::vec3 chest{0.0F, 0.0F, 1.2F};
    EXPECT_EQ(pixelAt(shoot(), scene.camera, chest), pixelAt(without, scene.camera, chest));
    line[0] = {{-0.2F, -0.4F, 1.2F}, {-0.2F, 0.4F, 1.2F}, glm::vec4(1, 0, 1, 1), 6.0F, 1.0F};
    EXPECT_GT(pixelAt(shoot(), scene.camera, {-0.2F, 0.0F, 1.2F}).x, 200);
}

TEST_F(RendererTest, DrawsPicturesOfAnySize) {
    add(tPose());
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 200}, {801, 33}, {0, -4}, {640, 480}}) {
        const Image& image = shoot(width, height);
        EXPECT_EQ(image.width, std::max(width, 1));
        EXPECT_EQ(image.height, std::max(height, 1));
        EXPECT_EQ(image.pixels.size(), image.stride() * static_cast<std::size_t>(image.height));
    }
}

TEST_F(RendererTest, MakesOpaquePictures) {
    add(tPose()).look.opacity = 0.5F;
    axes.push_back({{0.0F, 0.0F, 1.0F}, glm::quat(1.0F, 0.0F, 0.0F, 0.0F), 0.4F});
    const Image& image = shoot();
    for (std::size_t alpha = 3; alpha < image.pixels.size(); alpha += 4) {
        ASSERT_EQ(image.pixels[alpha], 255) << "pixel " << alpha / 4;
    }
}

TEST_F(RendererTest, WorksOnAThreadOfItsOwn) {
    add(tPose());
    const Image here = shoot();
    Image there;
    std::thread worker([&] {
        auto offscreen = OffscreenRenderer::create();
        ASSERT_TRUE(offscreen.has_value()) << offscreen.error();
        offscreen->renderer().uploadMesh(mesh(), mesh().positions);
        offscreen->render(scene, kWidth, kHeight);
        there = offscreen->takeImage();
    });
    worker.join();
    EXPECT_EQ(there.pixels, here.pixels);
}

TEST_F(RendererTest, GivesTheCompilersOwnText) {
    constexpr std::array<std::string_view, 1> kVertex{"void main() { gl_Position = vec4(0.0); }"};
    constexpr std::array<std::string_view, 1> kFragment{"void main() { undeclared = 1.0; }"};
    const auto program = gl::Program::create({"broken", kVertex, kFragment});
    ASSERT_FALSE(program.has_value());
    EXPECT_NE(program.error().find("program broken, fragment shader"), std::string::npos) << program.error();
    EXPECT_NE(program.error().find("undeclared"), std::string::npos) << program.error();
}

TEST(RenderQualityTest, SparesSoftwareRenderersAndUsesGraphicsProcessors) {
    EXPECT_TRUE(isSoftwareRenderer("llvmpipe (LLVM 15.0.6, 256 bits)"));
    EXPECT_TRUE(isSoftwareRenderer("softpipe"));
    EXPECT_FALSE(isSoftwareRenderer("Mesa Intel(R) UHD Graphics 620 (KBL GT2)"));
    EXPECT_EQ(interactiveQuality("NVIDIA GeForce RTX 3060/PCIe/SSE2"), RenderQuality{});
}

} // namespace
} // namespace posewire::render::testing
