// SPDX-License-Identifier: MIT
#include "tests/render/studio.h"
#include "tests/support/images.h"

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <thread>

namespace posewire::render::test {
namespace {

class RendererTest : public Studio {
protected:
    const Image& shootMarks(std::span<const PointInstance> points, float pixelRatio) {
        scene.points = points;
        return shoot(kWidth, kHeight, pixelRatio);
    }
};

/// Vertices are kept in hundredths of a millimetre.
constexpr float kRounded = 4e-5F;

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
        EXPECT_LT(largestDistance(drawn, positions), kRounded);
    }
}

TEST_F(RendererTest, SkinsClosedHandsAsTheReferenceOnTheProcessorDoes) {
    const std::vector<DualQuaternion> palette = fist(placed(lungePose(), {2.0F, -1.0F, 0.3F}, 2.5F));
    std::vector<glm::vec3> positions(mesh().vertexCount());
    std::vector<glm::vec3> normals(mesh().vertexCount());
    SkinJob{&mesh(), palette, positions, normals}.run();
    const std::vector<glm::vec3> drawn = renderer().skinnedPositions(meshId(), palette);
    ASSERT_EQ(drawn.size(), positions.size());
    EXPECT_LT(largestDistance(drawn, positions), kRounded);
}

/// Every segment and finger turned and shifted anyhow.
std::vector<DualQuaternion> randomPalette(std::mt19937& random) {
    std::normal_distribution<float> normal;
    const auto turn = [&] {
        return glm::normalize(glm::quat(normal(random), normal(random), normal(random), normal(random)));
    };
    const auto place = [&](const glm::vec3& about) {
        return about + 0.1F * glm::vec3(normal(random), normal(random), normal(random));
    };
    Pose pose;
    for (std::size_t i = 0; i < kSegmentCount; ++i) {
        pose.orientations[i] = turn();
        pose.positions[i] = place(kReferenceNullPose[i]);
    }
    std::array<glm::vec3, kFingerJointCount> places;
    std::array<glm::quat, kFingerJointCount> turns;
    for (std::size_t i = 0; i < kFingerJointCount; ++i) {
        turns[i] = turn();
        places[i] = place(jointOrigin(kFirstFingerJoint + i));
    }
    std::vector<DualQuaternion> palette(kJointCount);
    PaletteJob job{pose.positions, pose.orientations, kReferenceNullPose, palette};
    job.leftHand = {std::span(places).first(kHandSegmentCount), std::span(turns).first(kHandSegmentCount)};
    job.rightHand = {std::span(places).last(kHandSegmentCount), std::span(turns).last(kHandSegmentCount)};
    job.run();
    return palette;
}

TEST_F(RendererTest, SkinsRandomPosesAsTheReferenceOnTheProcessorDoes) {
    std::mt19937 random(7);
    std::vector<glm::vec3> positions(mesh().vertexCount());
    std::vector<glm::vec3> normals(mesh().vertexCount());
    for (int pose = 0; pose < 500; ++pose) {
        const std::vector<DualQuaternion> palette = randomPalette(random);
        SkinJob{&mesh(), palette, positions, normals}.run();
        const std::vector<glm::vec3> drawn = renderer().skinnedPositions(meshId(), palette);
        ASSERT_EQ(drawn.size(), positions.size());
        ASSERT_LT(largestDistance(drawn, positions), 1e-4F) << "pose " << pose;
    }
}

TEST_F(RendererTest, FitsBodiesAsTheReferenceOnTheProcessorDoes) {
    NullPose child = kReferenceNullPose;
    for (glm::vec3& origin : child) {
        origin *= 0.62F;
    }
    NullPose longArms = kReferenceNullPose;
    for (const Segment segment : {LeftForeArm, LeftHand}) {
        longArms[segment].y += 0.06F;
    }
    FingerOrigins longFingers;
    for (std::size_t i = 0; i < kFingerJointCount; ++i) {
        const glm::vec3& hand = kReferenceNullPose[jointSegment(kFirstFingerJoint + i)];
        longFingers[i] = hand + 1.2F * (jointOrigin(kFirstFingerJoint + i) - hand);
    }
    std::mt19937 random(3);
    for (const BodyFit& fit : {fitBody(child), fitBody(longArms), fitBody(kReferenceNullPose, longFingers)}) {
        const SkinnedMesh body = fitted(mesh(), fit);
        std::vector<glm::vec3> positions(body.vertexCount());
        std::vector<glm::vec3> normals(body.vertexCount());
        for (int pose = 0; pose < 20; ++pose) {
            const std::vector<DualQuaternion> palette = randomPalette(random);
            SkinJob{&body, palette, positions, normals}.run();
            const auto drawn = renderer().skinnedPositions(meshId(), palette, fit.stretches);
            ASSERT_EQ(drawn.size(), positions.size());
            ASSERT_LT(largestDistance(drawn, positions), 1e-4F);
        }
    }
    EXPECT_TRUE(renderer().skinnedPositions(meshId(), randomPalette(random), std::vector<Stretch>(3)).empty())
        << "a fit of too few joints";
}

TEST_F(RendererTest, OutlinesWhatIsSelectedAndNothingElse) {
    CharacterLook& look = add(grounded(tPose(), mesh())).look;
    scene.colours.selection = {1.0F, 0.0F, 1.0F};
    const auto magenta = [](const Image& image) {
        int count = 0;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const glm::ivec3 colour = pixel(image, x, y);
                count += colour.x > 200 && colour.y < 60 && colour.z > 200 ? 1 : 0;
            }
        }
        return count;
    };
    EXPECT_EQ(magenta(shoot()), 0);
    look.isSelected = true;
    const int around = magenta(shoot());
    EXPECT_GT(around, 800);
    look.isSelected = false;
    look.selectedSegment = LeftUpperArm;
    const int arm = magenta(shoot());
    EXPECT_GT(arm, 60);
    EXPECT_LT(arm, around / 2);
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
    EXPECT_EQ(renderer().uploadMesh(broken), MeshId::None);
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

TEST_F(RendererTest, ShowsProvenanceOnItsSegmentsOnly) {
    CharacterLook& look = add(grounded(tPose(), mesh())).look;
    const Image sent = shoot();
    const glm::vec3 thigh = kReferenceNullPose[LeftUpperLeg] + glm::vec3(0.08F, 0.0F, -0.15F);
    const glm::vec3 otherThigh(thigh.x, -thigh.y, thigh.z);
    // Of a line along the thigh, since stripes may be as strong as the suit.
    const auto saturation = [&](const Image& image) {
        int sum = 0;
        for (int step = 0; step < 20; ++step) {
            const glm::vec3 down(0.0F, 0.0F, -0.008F * static_cast<float>(step));
            const glm::ivec3 colour = pixelAt(image, scene.camera, thigh + down);
            sum += std::max({colour.x, colour.y, colour.z}) - std::min({colour.x, colour.y, colour.z});
        }
        return sum / 20;
    };
    for (const Provenance provenance : {Provenance::Solved, Provenance::Assumed}) {
        look.provenance[LeftUpperLeg] = provenance;
        const Image& shown = shoot();
        EXPECT_LT(5 * saturation(shown), 4 * saturation(sent));
        EXPECT_TRUE(provenance == Provenance::Assumed || 2 * saturation(shown) > saturation(sent));
        EXPECT_EQ(pixelAt(shown, scene.camera, otherThigh), pixelAt(sent, scene.camera, otherThigh));
    }
    look.provenance[LeftUpperLeg] = Provenance::Sent;
    EXPECT_EQ(shoot().pixels, sent.pixels);
}

TEST_F(RendererTest, IgnoresASelectionThatIsNoSegment) {
    CharacterLook& look = add(tPose()).look;
    const Image plain = shoot();
    for (const int segment : {23, 31, 32, 1000, -7}) {
        look.selectedSegment = segment;
        EXPECT_EQ(shoot().pixels, plain.pixels) << segment;
    }
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
        offscreen->renderer().uploadMesh(mesh());
        offscreen->render(scene, kWidth, kHeight);
        there = offscreen->takeImage();
    });
    worker.join();
    EXPECT_EQ(there.pixels, here.pixels);
}

TEST_F(RendererTest, SaysThatAShadowIsTooLargeForTheDriver) {
    const auto large = OffscreenRenderer::create(RenderQuality{.shadowMapSize = 1 << 20});
    ASSERT_FALSE(large.has_value());
    EXPECT_NE(large.error().find("1048576 x 1048576 pixels"), std::string::npos) << large.error();
}

TEST_F(RendererTest, GivesAnEmptyPictureBeyondTheLimitsOfTheDriver) {
    add(tPose());
    const Image before = shoot();
    const Image& image = shoot(1 << 20, 4);
    EXPECT_EQ(image.width, 0);
    EXPECT_TRUE(image.pixels.empty());
    EXPECT_EQ(shoot().pixels, before.pixels);
}

TEST_F(RendererTest, ShowsCharactersThroughTheFloorFromBelow) {
    look(0.3F, {0.0F, 0.0F, 0.9F}, 4.6F);
    for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
        scene.camera.projection = projection;
        scene.camera.pitch = -0.6F;
        characters.clear();
        const Image floor = shoot();
        add(grounded(tPose(), mesh()));
        EXPECT_GT(compareImages(shoot(), floor, 8).shareBeyond, 0.02);
    }
}

TEST_F(RendererTest, LeavesTheFloorOutWhereAsked) {
    const Image with = shoot();
    scene.showFloor = false;
    const Image& without = shoot();
    // What is left is the background, which is the same across a row.
    EXPECT_EQ(compareImages(with, without, 8).sameSize, true);
    const glm::ivec3 left = pixel(without, 0, kHeight - 1);
    const glm::ivec3 middle = pixel(without, kWidth / 2, kHeight - 1);
    EXPECT_LE(std::abs(left.x - middle.x), 1);
    EXPECT_NE(pixel(with, kWidth / 2, kHeight - 1), middle);
}

TEST_F(RendererTest, DrawsFromInsideABody) {
    const Image empty = shoot();
    add(tPose());
    scene.camera.target = {0.0F, 0.0F, 1.2F};
    scene.camera.distance = 0.2F;
    EXPECT_GT(compareImages(shoot(), empty, 8).shareBeyond, 0.1);
}

TEST_F(RendererTest, DrawsNothingOfCharactersOutOfSight) {
    scene.showFloor = false;
    const Image empty = shoot();
    add(placed(tPose(), {0.0F, 60.0F, 0.0F}));
    add(placed(tPose(), {0.0F, -60.0F, 0.0F})).look.opacity = 0.5F;
    EXPECT_EQ(shoot().pixels, empty.pixels);
}

TEST_F(RendererTest, LightsFromAboveWhereTheLightHasNoDirection) {
    add(grounded(tPose(), mesh()));
    scene.light.towards = {0.0F, 0.0F, 1.0F};
    const Image above = shoot();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    for (const glm::vec3& towards : {glm::vec3(0.0F), glm::vec3(kNan)}) {
        scene.light.towards = towards;
        EXPECT_EQ(shoot().pixels, above.pixels);
    }
    // From below the horizon there would be no shadow on the floor.
    scene.light.towards = {0.0F, 0.0F, -1.0F};
    EXPECT_EQ(shoot().pixels, above.pixels);
}

TEST_F(RendererTest, LeavesOutAxesThatHaveNoSizeOrDirection) {
    const Image empty = shoot();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const glm::vec3 place{0.0F, 0.0F, 1.0F};
    const glm::quat upright(1.0F, 0.0F, 0.0F, 0.0F);
    axes = {{place, upright, 0.0F},
            {place, upright, -0.4F},
            {place, upright, kNan},
            {place, upright, 0.4F, 0.0F},
            {place, glm::quat(kNan, 0.0F, 0.0F, 0.0F), 0.4F}};
    EXPECT_EQ(shoot().pixels, empty.pixels);
}

TEST_F(RendererTest, DrawsNoMarksBehindTheEye) {
    const Image empty = shoot();
    const glm::vec3 behind = scene.camera.eye() - scene.camera.forward();
    const std::array<LineInstance, 1> lines{{{behind, behind + scene.camera.right(), glm::vec4(1, 0, 1, 1)}}};
    const std::array<PointInstance, 1> points{{{behind, glm::vec4(1, 0, 1, 1), 40.0F}}};
    scene.lines = lines;
    scene.points = points;
    EXPECT_EQ(shoot().pixels, empty.pixels);
    // A line that comes from behind the eye is seen from where it passes it.
    const std::array<LineInstance, 1> passing{
        {{behind, behind + 6.0F * scene.camera.forward() + 0.2F * scene.camera.right(),
          glm::vec4(1, 0, 1, 1)}}};
    scene.lines = passing;
    EXPECT_NE(shoot().pixels, empty.pixels);
}

TEST_F(RendererTest, WidensMarksWithThePixelRatio) {
    const std::array<PointInstance, 1> points{{{{0.0F, 0.0F, 0.9F}, glm::vec4(1, 0, 1, 1), 20.0F}}};
    const auto magentaPixels = [](const Image& image) {
        int count = 0;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const glm::ivec3 colour = pixel(image, x, y);
                count += colour.x > 150 && colour.y < 60 && colour.z > 150 ? 1 : 0;
            }
        }
        return count;
    };
    const int single = magentaPixels(shootMarks(points, 1.0F));
    EXPECT_NEAR(single, 314, 60);
    EXPECT_NEAR(magentaPixels(shootMarks(points, 2.0F)), 4 * single, single);
}

TEST(RenderQualityTest, SparesSoftwareRenderersAndUsesGraphicsProcessors) {
    EXPECT_TRUE(isSoftwareRenderer("llvmpipe (LLVM 15.0.6, 256 bits)"));
    EXPECT_TRUE(isSoftwareRenderer("softpipe"));
    EXPECT_FALSE(isSoftwareRenderer("Mesa Intel(R) UHD Graphics 620 (KBL GT2)"));
    EXPECT_EQ(interactiveQuality("NVIDIA GeForce RTX 3060/PCIe/SSE2"), RenderQuality{});
    EXPECT_GT(interactiveQuality("llvmpipe (LLVM 15.0.6, 256 bits)").charactersAtOnce, 0)
        << "256 characters took 600 MB of triangles";
}

} // namespace
} // namespace posewire::render::test
