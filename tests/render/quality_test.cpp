// SPDX-License-Identifier: MIT
#include "render/passes/floor_shadows.h"
#include "render/quality_ladder.h"
#include "tests/render/studio.h"
#include "tests/support/images.h"

#include <algorithm>
#include <array>
#include <limits>

namespace posewire::render::test {
namespace {

/// The ways to draw the same with less.
class QualityTest : public Studio {
protected:
    void SetUp() override {
        Studio::SetUp();
        m_interactive = renderer().quality();
        const SkinnedMesh low = loadMannequin(Detail::Low);
        m_low = renderer().uploadMesh(low);
    }

    void addPair() {
        add(placed(grounded(standingPose(), mesh()), {-0.3F, -0.75F, 0.0F}, 0.35F), kBlue).lowMesh = m_low;
        add(placed(grounded(lungePose(), mesh()), {0.1F, 0.65F, 0.0F}), kOrange).lowMesh = m_low;
        look(0.25F, {0.0F, 0.0F, 0.85F}, 5.2F);
    }

    Image shootWith(const RenderQuality& quality) {
        renderer().setQuality(quality);
        return shoot();
    }

    RenderQuality withoutBackdrop() const {
        RenderQuality quality = m_interactive;
        quality.keepsBackdrop = false;
        return quality;
    }

    void expectAlike(const Image& a, const Image& b, double share) {
        const ImageDifference difference = compareImages(a, b, 2);
        EXPECT_LE(difference.shareBeyond, share);
        EXPECT_LT(difference.mean, 0.3);
    }

    RenderQuality m_interactive;
    MeshId m_low = MeshId::None;
};

TEST_F(QualityTest, AKeptBackdropIsWhatWouldBeDrawn) {
    ASSERT_TRUE(m_interactive.keepsBackdrop);
    addPair();
    for (const auto& colours : {lightSceneColours(), darkSceneColours()}) {
        scene.colours = colours;
        for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
            scene.camera.projection = projection;
            const Image drawn = shootWith(withoutBackdrop());
            const Image first = shootWith(m_interactive);
            expectAlike(first, drawn, 0.001);
            EXPECT_EQ(shoot().pixels, first.pixels) << "the first is drawn, the second copied";
        }
    }
}

TEST_F(QualityTest, AKeptBackdropIsForgottenWhenCameraSizeOrColoursChange) {
    addPair();
    shoot();
    const auto expectDrawn = [&](int width, int height) {
        renderer().setQuality(m_interactive);
        const Image kept = shoot(width, height);
        renderer().setQuality(withoutBackdrop());
        expectAlike(kept, shoot(width, height), 0.001);
    };
    scene.camera.orbit(0.3F, 0.05F);
    expectDrawn(kWidth, kHeight);
    expectDrawn(501, 333);
    scene.colours = darkSceneColours();
    expectDrawn(501, 333);
    scene.showOrigin = false;
    expectDrawn(501, 333);
    scene.showFloor = false;
    expectDrawn(501, 333);
}

TEST_F(QualityTest, TheFloorHidesWhatIsBelowItWhicheverWayItIsDrawn) {
    addPair();
    add(placed(tPose(), {-0.5F, 0.1F, -0.9275F}));
    const Image kept = shootWith(m_interactive);
    expectAlike(kept, shootWith(withoutBackdrop()), 0.001);
}

TEST_F(QualityTest, AMovingCameraSeesNearlyTheSameFloor) {
    addPair();
    RenderQuality quality = m_interactive;
    quality.plainFloor = true;
    const Image plain = shootWith(quality);
    EXPECT_LT(compareImages(plain, shootWith(m_interactive), 12).shareBeyond, 0.03);
    expectMatchesBaseline(plain, "plain_floor");
}

TEST_F(QualityTest, AMovingCameraSeesNearlyTheSameFloorOnDark) {
    addPair();
    scene.colours = darkSceneColours();
    scene.camera.pitch = 0.5F;
    RenderQuality quality = m_interactive;
    quality.plainFloor = true;
    expectMatchesBaseline(shootWith(quality), "plain_floor_dark");
}

TEST_F(QualityTest, ThePlainFloorSurvivesAnyCamera) {
    addPair();
    RenderQuality quality = m_interactive;
    quality.plainFloor = true;
    renderer().setQuality(quality);
    for (const StandardView view : {StandardView::Front, StandardView::Top, StandardView::Left}) {
        for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
            for (const float distance : {0.2F, 5.0F, 60.0F}) {
                scene.camera = facing(scene.camera, view);
                scene.camera.projection = projection;
                scene.camera.distance = distance;
                const Image plain = shoot();
                renderer().setQuality(m_interactive);
                EXPECT_LT(compareImages(plain, shoot(), 24).shareBeyond, 0.06)
                    << static_cast<int>(view) << ' ' << static_cast<int>(projection) << ' ' << distance;
                renderer().setQuality(quality);
            }
        }
    }
}

TEST_F(QualityTest, TheLastStepStillShowsTheSame) {
    addPair();
    const Image full = shootWith(m_interactive);
    const Image simple = shootWith(simplified(m_interactive, Simplification::HalfRate));
    EXPECT_LT(compareImages(simple, full, 40).shareBeyond, 0.01);
    expectMatchesBaseline(simple, "simplest");
    EXPECT_EQ(shootWith(m_interactive).pixels, full.pixels) << "nothing of it stays";
}

TEST_F(QualityTest, ShadowsTheDriverRefusesStayAsTheyWere) {
    addPair();
    const Image before = shoot();
    RenderQuality quality = m_interactive;
    quality.shadowMapSize = 1 << 20;
    EXPECT_EQ(shootWith(quality).pixels, before.pixels);
    EXPECT_EQ(renderer().quality().shadowMapSize, m_interactive.shadowMapSize);
}

TEST_F(QualityTest, SmallBodiesAreOfTheLowMesh) {
    addPair();
    scene.camera.distance = 40.0F;
    const Image small = shoot();
    for (SkinnedInstance& character : characters) {
        character.mesh = m_low;
    }
    RenderQuality quality = m_interactive;
    quality.lowShadows = true;
    EXPECT_LT(compareImages(shootWith(quality), small, 2).shareBeyond, 0.002);
}

TEST_F(QualityTest, ASelectedSegmentIsNotOfTheLowMesh) {
    add(grounded(standingPose(), mesh()), kBlue).lowMesh = m_low;
    scene.camera.distance = 3.0F;
    RenderQuality coarse = m_interactive;
    coarse.lowBodiesBelow = std::numeric_limits<float>::max();
    EXPECT_NE(shootWith(coarse).pixels, shootWith(m_interactive).pixels);
    characters[0].look.selectedSegment = T12;
    EXPECT_EQ(shootWith(coarse).pixels, shootWith(m_interactive).pixels);
}

double areaOf(std::span<const glm::vec4> rectangles) {
    double area = 0.0;
    for (const glm::vec4& one : rectangles) {
        area += static_cast<double>(one.z) * one.w;
    }
    return area;
}

bool contains(const glm::vec4& one, float x, float y) {
    return x > one.x && x < one.x + one.z && y > one.y && y < one.y + one.w;
}

TEST(DisjointRectangles, CoversTheSameOnce) {
    std::vector<glm::vec4> covered;
    for (int i = 0; i < 12; ++i) {
        covered.emplace_back(0.31F * static_cast<float>(i % 5), 0.17F * static_cast<float>(i % 7), 0.5F,
                             0.4F);
    }
    DisjointRectangles rectangles;
    const std::span<const glm::vec4> disjoint = rectangles.of(covered);
    for (int i = 0; i < 60; ++i) {
        for (int k = 0; k < 60; ++k) {
            const float x = 0.0317F * static_cast<float>(i);
            const float y = 0.0271F * static_cast<float>(k);
            const auto isIn = [&](const glm::vec4& one) { return contains(one, x, y); };
            EXPECT_EQ(std::ranges::count_if(disjoint, isIn), std::ranges::any_of(covered, isIn) ? 1 : 0)
                << x << ' ' << y;
        }
    }
}

TEST(DisjointRectangles, LeavesOutWhatHasNoSize) {
    DisjointRectangles rectangles;
    EXPECT_TRUE(rectangles.of({}).empty());
    const std::array<glm::vec4, 3> covered{{{0, 0, 0, 1}, {0, 0, 1, 0}, {0, 0, 1, 1}}};
    EXPECT_DOUBLE_EQ(areaOf(rectangles.of(covered)), 1.0);
}

} // namespace
} // namespace posewire::render::test
