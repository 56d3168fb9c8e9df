// SPDX-License-Identifier: MIT
#include "render/mesh/null_pose_fit.h"
#include "tests/render/studio.h"

#include <gtest/gtest-spi.h>

namespace posewire::render::test {
namespace {

class Picture : public Studio {
protected:
    /// Two characters side by side, as the operator sees them.
    void addPair() {
        const Pose standing = placed(grounded(standingPose(), mesh()), {-0.3F, -0.75F, 0.0F}, 0.35F);
        const Pose lunging = placed(grounded(lungePose(), mesh()), {0.1F, 0.65F, 0.0F});
        add(standing, kBlue);
        add(lunging, kOrange);
        m_poses = {standing, lunging};
        look(0.25F, {0.0F, 0.0F, 0.85F}, 5.2F);
    }

    const std::vector<Pose>& poses() const { return m_poses; }

private:
    std::vector<Pose> m_poses;
};

TEST_F(Picture, ShowsTheTPose) {
    add(grounded(tPose(), mesh()));
    expectMatchesBaseline(shoot(), "t_pose");
}

TEST_F(Picture, ShowsTheTPoseOnDark) {
    add(grounded(tPose(), mesh()));
    scene.colours = darkSceneColours();
    expectMatchesBaseline(shoot(), "t_pose_dark");
}

TEST_F(Picture, ShowsALunge) {
    add(grounded(lungePose(), mesh()));
    look(0.57F, {0.0F, 0.0F, 0.75F}, 4.0F);
    expectMatchesBaseline(shoot(), "lunge");
}

TEST_F(Picture, ShowsASquat) {
    add(grounded(squatPose(), mesh()), kOrange);
    look(0.785F, {0.1F, 0.0F, 0.55F}, 3.6F);
    expectMatchesBaseline(shoot(), "squat");
}

TEST_F(Picture, ShowsBentElbowsFromBehind) {
    add(grounded(elbowPose(), mesh()));
    look(2.4F, {0.05F, 0.0F, 0.6F}, 3.6F);
    expectMatchesBaseline(shoot(), "elbows_behind");
}

TEST_F(Picture, ShowsLocalAxesThroughTheBody) {
    addPair();
    for (const Pose& pose : poses()) {
        addAxes(pose);
    }
    scene.colours = darkSceneColours();
    expectMatchesBaseline(shoot(), "axes_dark");
}

TEST_F(Picture, FadesAndStripesStaleCharacters) {
    addPair();
    characters[0].look.dim = 0.6F;
    characters[0].look.isHatched = true;
    characters[1].look.dim = 0.6F;
    expectMatchesBaseline(shoot(), "stale");
}

TEST_F(Picture, MarksTheSelectedSegment) {
    addPair();
    characters[0].look.selectedSegment = RightForeArm;
    characters[1].look.selectedSegment = T8;
    scene.colours = darkSceneColours();
    expectMatchesBaseline(shoot(), "selected_dark");
}

TEST_F(Picture, OutlinesTheSelectedCharacter) {
    addPair();
    characters[0].look.isSelected = true;
    characters[0].look.selectedSegment = LeftForeArm;
    expectMatchesBaseline(shoot(), "selected");
}

TEST_F(Picture, ShowsTheHeadAndTheCollarFromNear) {
    add(tPose());
    look(0.6F, {0.0F, 0.0F, 1.56F}, 1.1F);
    expectMatchesBaseline(shoot(), "head");
}

TEST_F(Picture, ShowsTheHeadFromBehind) {
    add(tPose());
    look(2.5F, {0.0F, 0.0F, 1.56F}, 1.1F);
    expectMatchesBaseline(shoot(), "head_behind");
}

TEST_F(Picture, RelaxesHandsWhoseFingersAreNotKnown) {
    add(standingPose());
    look(0.5F, {0.0F, 0.33F, 0.80F}, 0.7F);
    expectMatchesBaseline(shoot(), "hand_relaxed");
}

TEST_F(Picture, PosesFingersAsTheyAreSent) {
    add(tPose()).palette = addPalette(fist(tPose()));
    look(1.2F, {0.0F, 0.76F, 1.40F}, 0.6F);
    scene.camera.pitch = 0.5F;
    expectMatchesBaseline(shoot(), "hand_fist");
}

TEST_F(Picture, ShowsShoesOnTheFloorOfBothThemes) {
    add(grounded(standingPose(), mesh()));
    look(0.7F, {0.08F, 0.0F, 0.08F}, 1.2F);
    scene.camera.pitch = 0.25F;
    expectMatchesBaseline(shoot(), "shoes");
    scene.colours = darkSceneColours();
    expectMatchesBaseline(shoot(), "shoes_dark");
}

TEST_F(Picture, KeepsTheFormOfShoulders) {
    add(shrugPose());
    look(0.4F, {0.0F, 0.0F, 1.42F}, 1.5F);
    expectMatchesBaseline(shoot(), "shrug");
}

TEST_F(Picture, KeepsTheFormOfRaisedArms) {
    add(raisedArmsPose());
    look(0.3F, {0.0F, 0.0F, 1.45F}, 2.0F);
    expectMatchesBaseline(shoot(), "raised_arms");
}

TEST_F(Picture, OpensArmpitsUnderRaisedArms) {
    add(raisedArmsPose(), kOrange);
    look(0.7F, {0.0F, 0.1F, 1.38F}, 1.2F);
    expectMatchesBaseline(shoot(), "overhead_near");
}

TEST_F(Picture, RoundsTheTrapeziusOfAShrugFromBehind) {
    add(shrugPose(), kOrange);
    look(2.7F, {0.0F, 0.0F, 1.44F}, 1.0F);
    expectMatchesBaseline(shoot(), "shrug_near");
}

TEST_F(Picture, RoundsKneesAndSeatOfASitter) {
    add(grounded(sittingPose(), mesh()), kOrange);
    look(1.2F, {0.15F, 0.0F, 0.42F}, 1.3F);
    expectMatchesBaseline(shoot(), "sit_near");
}

TEST_F(Picture, RoundsTheKnucklesOfAFist) {
    add(tPose()).palette = addPalette(fist(tPose()));
    look(0.6F, {0.0F, 0.77F, 1.40F}, 0.32F);
    scene.camera.pitch = 0.35F;
    expectMatchesBaseline(shoot(), "fist_near");
}

TEST_F(Picture, KeepsTheFormOfHipsInASplit) {
    add(grounded(spreadLegsPose(), mesh()));
    look(0.2F, {0.0F, 0.0F, 0.5F}, 1.9F);
    expectMatchesBaseline(shoot(), "spread_legs");
}

TEST_F(Picture, KeepsTheCollarOfANoddingHead) {
    add(nodPose());
    look(1.3F, {0.0F, 0.0F, 1.5F}, 1.2F);
    expectMatchesBaseline(shoot(), "nod");
}

TEST_F(Picture, FadesSolvedSegmentsAndHatchesAssumedOnes) {
    addPair();
    for (const Segment segment : {RightForeArm, RightHand, LeftUpperLeg}) {
        characters[0].look.provenance[segment] = Provenance::Solved;
    }
    for (const Segment segment : {LeftUpperArm, LeftForeArm, LeftHand, RightLowerLeg, RightFoot, RightToe}) {
        characters[0].look.provenance[segment] = Provenance::Assumed;
    }
    characters[1].look.provenance.fill(Provenance::Assumed);
    characters[1].look.dim = 0.6F;
    characters[1].look.isHatched = true;
    expectMatchesBaseline(shoot(), "provenance");
}

TEST_F(Picture, ShowsAGhostBesideALiveCharacter) {
    addPair();
    characters[0].look.opacity = 0.35F;
    expectMatchesBaseline(shoot(), "ghost");
}

TEST_F(Picture, DrawsLinesAndPoints) {
    addPair();
    std::vector<PointInstance> points;
    std::vector<LineInstance> lines;
    for (std::size_t segment = 0; segment < kSegmentCount; ++segment) {
        points.push_back({poses()[0].positions[segment], {1.0F, 0.8F, 0.2F, 1.0F}});
        const int parent = kSegmentParents[segment];
        if (parent >= 0) {
            lines.push_back({poses()[1].positions[segment],
                             poses()[1].positions[static_cast<std::size_t>(parent)],
                             {0.1F, 0.2F, 0.3F, 1.0F}});
        }
    }
    scene.points = points;
    scene.lines = lines;
    expectMatchesBaseline(shoot(), "lines_and_points");
}

TEST_F(Picture, ShowsTheFloorFromAboveOrthographically) {
    addPair();
    scene.camera = facing(scene.camera, StandardView::Top);
    scene.camera.projection = Projection::Orthographic;
    scene.camera.target = {0.0F, 0.0F, 0.0F};
    expectMatchesBaseline(shoot(), "top");
}

TEST_F(Picture, KeepsTheSuitOnAFittedPerformer) {
    NullPose child = kReferenceNullPose;
    for (glm::vec3& origin : child) {
        origin *= 0.68F;
    }
    const BodyFit fit = fitBody(child);
    const Pose pose = poseFrom({}, fit.origins);
    SkinnedInstance& instance = add(tPose(), {0.70F, 0.30F, 0.55F});
    instance.palette = addPalette(paletteOf(pose, fit.origins));
    instance.fit = fit.stretches;
    look(0.30F, {0.0F, 0.0F, 0.6F}, 3.4F);
    expectMatchesBaseline(shoot(), "fitted_child");
}

TEST_F(Picture, ShowsEachPropInItsShape) {
    for (std::size_t i = 0; i < kPropShapeCount; ++i) {
        const MeshId id = renderer().uploadMesh(static_cast<PropShape>(i));
        ASSERT_NE(id, MeshId::None);
        const glm::vec3 place(0.0F, 1.0F - 0.32F * static_cast<float>(i), i % 2 == 0 ? 0.75F : 0.25F);
        const glm::quat turn = glm::angleAxis(-0.6F, glm::vec3(0, 0, 1));
        const std::vector<DualQuaternion> motion{rigidMotion(turn, glm::vec3(0.0F), place)};
        SkinnedInstance& instance = add(tPose());
        instance.mesh = id;
        instance.palette = addPalette(motion);
    }
    look(0.25F, {0.2F, 0.0F, 0.45F}, 3.8F);
    expectMatchesBaseline(shoot(), "props");
}

TEST_F(Picture, IsMultisampledWhereTheQualityAsksForIt) {
    addPair();
    scene.characters = characters;
    auto still = OffscreenRenderer::create(RenderQuality{.samples = 4, .edgeSmoothing = false});
    ASSERT_TRUE(still.has_value()) << still.error();
    ASSERT_EQ(still->renderer().uploadMesh(mesh()), meshId());
    expectMatchesBaseline(still->render(scene, kWidth, kHeight), "still_quality");
}

TEST_F(Picture, IsTheSameToTheBitInASecondContext) {
    addPair();
    addAxes(poses()[0]);
    const Image first = shoot();
    auto second = OffscreenRenderer::create();
    ASSERT_TRUE(second.has_value()) << second.error();
    ASSERT_EQ(second->renderer().uploadMesh(mesh()), meshId());
    const Image& again = second->render(scene, kWidth, kHeight);
    EXPECT_EQ(first.pixels, again.pixels);
}

TEST_F(Picture, FailsWithoutItsBaseline) {
    static Image image;
    image = shoot(32, 24);
    if (std::getenv("POSEWIRE_UPDATE_BASELINES") != nullptr) {
        GTEST_SKIP() << "baselines are being rewritten";
    }
    EXPECT_NONFATAL_FAILURE(expectMatchesBaseline(image, "there_is_no_such_baseline"), "no baseline");
}

TEST_F(Picture, FailsWhereTheBaselineShowsSomethingElse) {
    static Image image;
    look(0.40F, {0.0F, 0.0F, 0.9F}, 4.6F);
    image = shoot();
    if (std::getenv("POSEWIRE_UPDATE_BASELINES") != nullptr) {
        GTEST_SKIP() << "baselines are being rewritten";
    }
    EXPECT_NONFATAL_FAILURE(expectMatchesBaseline(image, "t_pose"), "% of the pixels");
}

} // namespace
} // namespace posewire::render::test
