// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/comparison.h"
#include "app/gui/viewport/scene.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/viewport/camera_motion.h"
#include "app/gui/viewport/picking.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "tests/app/gui/models/stage.h"

#include <gtest/gtest.h>

#include <cmath>

namespace posewire::gui {
namespace {

class SceneBuilderTest : public testing::Test {
protected:
    void perform(int characters) { perform(sending(characters, {2, 12, 13})); }
    void perform(const performer::PerformerSettings& settings) {
        performer::Performer performer(settings);
        stage.perform(performer, 0, 3);
        stage.follow();
    }
    SceneFrame build() {
        SceneFrame frame;
        builder.build(axes, overlays, frame);
        return frame;
    }

    Stage stage;
    AxesMode axes = AxesMode::All;
    Overlays overlays;
    SceneBuilder builder{stage.session, render::Detail::Medium};
};

TEST_F(SceneBuilderTest, WithoutCharactersTheSceneIsEmpty) {
    const SceneFrame frame = build();
    EXPECT_TRUE(frame.figures.empty());
    EXPECT_TRUE(frame.axes.empty());
}

TEST_F(SceneBuilderTest, EachCharacterHasAFigureInItsMetadataColour) {
    perform(3);
    const SceneFrame frame = build();
    ASSERT_EQ(frame.figures.size(), 3U);
    for (const Figure& figure : frame.figures) {
        const model::Colour colour = stage.session.roster().colour(figure.key);
        EXPECT_EQ(figure.look.colour, glm::vec3(colour.red, colour.green, colour.blue));
        EXPECT_EQ(figure.look.dim, 0.0F);
        EXPECT_FALSE(figure.look.isHatched);
    }
    EXPECT_NE(frame.figures[0].look.colour, frame.figures[1].look.colour);
}

TEST_F(SceneBuilderTest, ThePaletteTakesEachSegmentWhereThePoseHasIt) {
    perform(1);
    const SceneFrame frame = build();
    const model::CharacterPose* pose = stage.session.messages().pose(stage.key());
    ASSERT_NE(pose, nullptr);
    for (std::size_t i = 0; i < render::kSegmentCount; ++i) {
        const glm::vec3 place =
            render::transformPoint(frame.figures[0].palette[i], frame.figures[0].body->fit.origins[i]);
        EXPECT_NEAR(place.x, pose->segments[i].position.x(), 1e-4);
        EXPECT_NEAR(place.y, pose->segments[i].position.y(), 1e-4);
        EXPECT_NEAR(place.z, pose->segments[i].position.z(), 1e-4);
    }
}

TEST_F(SceneBuilderTest, ACorruptSegmentDoesNotLeadTheCameraAway) {
    perform(1);
    const render::Bounds well = build().figures[0].bounds;
    performer::Performer performer(sending(1, {2}));
    wire::Datagram datagram = performer.frame(3).front();
    std::get<wire::PoseQuaternion>(datagram.body).segments[10].position[0] = 700.0F;
    stage.send(datagram, stage.now + 4ms);
    stage.follow();
    const Figure figure = build().figures.at(0);
    EXPECT_NEAR(stage.session.messages().pose(stage.key())->segments[10].position.x(), 700, 0.1)
        << "it is drawn as sent";
    EXPECT_LT(glm::distance(figure.bounds.centre(), well.centre()), 0.2F);
    EXPECT_LT(figure.bounds.radius(), 1.5F * well.radius());
}

TEST_F(SceneBuilderTest, TheLabelOfWhoIsUpsideDownIsAboveAllOfTheBody) {
    perform(1);
    const Figure upright = build().figures.at(0);
    EXPECT_GT(upright.labelPosition.z, upright.bounds.max.z);
    performer::Performer performer(sending(1, {2}));
    wire::Datagram datagram = performer.frame(3).front();
    for (wire::SegmentQuaternion& segment : std::get<wire::PoseQuaternion>(datagram.body).segments) {
        auto& [w, x, y, z] = segment.orientation; // half a turn about x
        segment.position = {segment.position[0], -segment.position[1], 1.9F - segment.position[2]};
        segment.orientation = {-x, w, -z, y};
    }
    stage.send(datagram, stage.now + 4ms);
    stage.follow();
    const Figure figure = build().figures.at(0);
    EXPECT_LT(stage.session.messages().pose(stage.key())->segments[render::Head].position.z(), 0.6);
    EXPECT_GT(figure.labelPosition.z, figure.bounds.max.z + 0.1F);
    EXPECT_NEAR(figure.labelPosition.x, figure.bounds.centre().x, 0.01F);
}

TEST_F(SceneBuilderTest, TheLabelSaysWhoIsHiddenBehindSomebodyElse) {
    perform(2);
    SceneFrame frame = build();
    const QSizeF view(800, 600);
    const auto headOf = [&frame](std::size_t figure) {
        return frame.figures.at(figure).labelPosition - glm::vec3(0, 0, 0.2F);
    };
    const auto behind = [&] {
        std::vector<bool> all;
        for (const ViewportLabel& label : labelsOf(frame, stage.session, view)) {
            all.push_back(label.isBehind);
        }
        return all;
    };
    const glm::vec3 between = headOf(1) - headOf(0);
    frame.camera.target = headOf(1);
    frame.camera.pitch = 0;
    frame.camera.distance = 9;
    frame.camera.yaw = std::atan2(-between.y, -between.x);
    ASSERT_LT(glm::dot(headOf(0) - frame.camera.eye(), frame.camera.forward()), 9) << "the first is nearer";
    EXPECT_EQ(behind(), (std::vector{false, true}));
    frame.camera.yaw += 1.5F;
    EXPECT_EQ(behind(), (std::vector{false, false}));
}

/// Sends the frames from second to second, as a character of each of the IDs.
void performAs(Stage& stage, const std::vector<int>& ids, int fromSecond, int toSecond) {
    constexpr int kRate = 240;
    performer::Performer performer(sending(1, {2, 12, 13}));
    for (int frame = fromSecond * kRate; frame < toSecond * kRate; ++frame) {
        for (wire::Datagram datagram : performer.frame(static_cast<std::uint64_t>(frame))) {
            for (const int id : ids) {
                datagram.header.character = static_cast<std::uint8_t>(id);
                stage.send(datagram, Stage::kStart + log::durationOf(static_cast<double>(frame) / kRate));
            }
        }
    }
    stage.follow();
}

TEST_F(SceneBuilderTest, WhoGoesOnUnderAnotherIdLeavesNoFigureBehind) {
    performAs(stage, {0}, 0, 2);
    EXPECT_EQ(build().figures.size(), 1U);
    performAs(stage, {30}, 2, 4);
    const SceneFrame frame = build();
    ASSERT_EQ(frame.figures.size(), 1U);
    EXPECT_EQ(frame.figures[0].key, stage.key(30));
    EXPECT_EQ(stage.session.roster().listed().size(), 1U) << "it is the same performer";
    stage.session.follow(stage.now + 5s);
    EXPECT_EQ(build().figures.size(), 1U) << "also where that one falls silent too";
    performAs(stage, {0, 30}, 4, 5);
    EXPECT_EQ(build().figures.size(), 2U) << "it is back";
}

TEST_F(SceneBuilderTest, WhoFallsSilentStaysWhileANamesakeGoesOn) {
    performAs(stage, {0, 30}, 0, 3);
    performAs(stage, {30}, 3, 5);
    const SceneFrame frame = build();
    ASSERT_EQ(frame.figures.size(), 2U);
    EXPECT_TRUE(frame.figures[0].look.isHatched);
}

TEST_F(SceneBuilderTest, PropsLookLikeWhatTheyAreCalled) {
    performer::PerformerSettings settings = sending(1, {2, 12, 13});
    settings.props = 4;
    perform(settings);
    const model::CharacterPose* pose = stage.session.messages().pose(stage.key());
    ASSERT_NE(pose, nullptr);
    const std::vector<FigureProp> props = build().figures.at(0).props;
    ASSERT_EQ(props.size(), 4U);
    using render::PropShape;
    const std::array wanted{PropShape::Sword, PropShape::Stick, PropShape::Generic, PropShape::GolfClub};
    for (std::size_t i = 0; i < props.size(); ++i) {
        EXPECT_EQ(props[i].shape, wanted[i]) << i;
        const glm::vec3 place = render::transformPoint(props[i].motion[0], glm::vec3(0.0F));
        EXPECT_NEAR(place.x, pose->segments[23 + i].position.x(), 1e-4);
        EXPECT_NEAR(place.z, pose->segments[23 + i].position.z(), 1e-4);
    }
}

TEST_F(SceneBuilderTest, APropIsPickedAtItsPlaceInThePictureWhileTheStreamGoesOn) {
    wire::PoseQuaternion pose;
    for (std::uint32_t id = 1; id <= 24; ++id) {
        pose.segments.push_back({id, {0, 0, 0.04F * static_cast<float>(id)}, {1, 0, 0, 0}});
    }
    const auto sendWithPropAt = [&](float x, std::uint32_t sample) {
        pose.segments[23].position = {x, 1, 1};
        wire::Datagram datagram;
        datagram.body = pose;
        datagram.header.sampleCounter = sample;
        datagram.header.bodySegments = 23;
        datagram.header.props = 1;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        stage.send(datagram, Stage::kStart + 4ms * sample);
        stage.follow();
    };
    sendWithPropAt(-0.5F, 0);
    const SceneFrame drawn = build();
    sendWithPropAt(0.5F, 1);
    const QSizeF view(640, 480);
    const auto pickedAt = [&](float x) {
        const auto screen = drawn.camera.project({x, 1, 1}, 640.0F / 480.0F);
        return screen ? pickIn(drawn, pointerAt(*screen, view), view) : std::nullopt;
    };
    EXPECT_EQ(pickedAt(-0.5F), (PickedSegment{stage.key(), 23}));
    EXPECT_EQ(pickedAt(0.5F), std::nullopt) << "it is not drawn there yet";
}

TEST_F(SceneBuilderTest, PropsWithoutANameAreDrawnAllTheSame) {
    performer::PerformerSettings settings = sending(1, {2});
    settings.props = 2;
    perform(settings);
    const std::vector<FigureProp> props = build().figures.at(0).props;
    ASSERT_EQ(props.size(), 2U);
    EXPECT_EQ(props[0].shape, render::PropShape::Generic);
}

TEST_F(SceneBuilderTest, FollowsASenderThatAddsAndDropsPropsAndFingers) {
    performer::PerformerSettings settings = sending(1, {2, 12, 13});
    performer::Performer bare(settings);
    settings.props = 2;
    settings.fingers = true;
    performer::Performer equipped(settings);
    std::uint64_t frame = 0;
    for (performer::Performer* performer : {&bare, &equipped, &bare, &equipped}) {
        stage.perform(*performer, frame, frame + 30);
        frame += 30;
        stage.follow();
        const bool isEquipped = performer == &equipped;
        const model::CharacterPose* pose = stage.session.messages().pose(stage.key());
        ASSERT_NE(pose, nullptr);
        EXPECT_EQ(pose->layout.count(), isEquipped ? 65 : 23) << frame;
        const SceneFrame scene = build();
        ASSERT_EQ(scene.figures.size(), 1U);
        EXPECT_EQ(scene.figures[0].props.size(), isEquipped ? 2U : 0U) << frame;
        const glm::vec3 hand = render::transformPoint(scene.figures[0].palette[render::LeftHand],
                                                      scene.figures[0].body->fit.origins[render::LeftHand]);
        EXPECT_NEAR(hand.z, pose->segments[render::LeftHand].position.z(), 1e-3) << frame;
    }
}

TEST_F(SceneBuilderTest, PropsOfRevisionEAreNamedByTheirOwnMessage) {
    performer::PerformerSettings settings = sending(1, {2, 11});
    settings.props = 1;
    settings.revision = performer::Revision::E;
    perform(settings);
    const std::vector<FigureProp> props = build().figures.at(0).props;
    ASSERT_EQ(props.size(), 1U);
    EXPECT_EQ(props[0].shape, render::PropShape::Sword);
}

TEST_F(SceneBuilderTest, MotionGridTagsArePointsThatFadeWithTheirAge) {
    stage.send(wire::TagPositions{{{900, {0, 100, 50}}, {901, {10, 0, 0}}}}, 1, 0, Stage::kStart);
    stage.send(wire::TagPositions{{{901, {20, 0, 0}}}}, 2, 0, Stage::kStart + 12s);
    stage.follow();
    SceneFrame frame = build();
    ASSERT_EQ(frame.points.size(), 2U) << "a sender without a pose has them as well";
    EXPECT_EQ(frame.points[0].position, glm::vec3(0.5F, 0, 1));
    EXPECT_EQ(frame.points[1].position, glm::vec3(0, 0.2F, 0));
    EXPECT_LT(frame.points[0].colour.a, frame.points[1].colour.a);
    ASSERT_EQ(frame.texts.size(), 2U);
    EXPECT_EQ(frame.texts[0].text, QStringLiteral("900 · 12 s"));
    EXPECT_EQ(frame.texts[1].text, QStringLiteral("901"));
    stage.session.setHidden(stage.key(), true);
    EXPECT_TRUE(build().points.empty());
}

TEST_F(SceneBuilderTest, FingersOfThePoseMoveTheMesh) {
    performer::PerformerSettings settings = sending(1, {2, 12, 13});
    settings.fingers = true;
    perform(settings);
    const SceneFrame frame = build();
    const model::CharacterPose* pose = stage.session.messages().pose(stage.key());
    ASSERT_NE(pose, nullptr);
    ASSERT_EQ(pose->layout.fingers, 40);
    ASSERT_EQ(frame.figures.size(), 1U);
    EXPECT_TRUE(frame.lines.empty());
    const auto first = static_cast<std::size_t>(pose->layout.body + pose->layout.props);
    for (std::size_t i = 0; i < render::kFingerJointCount; ++i) {
        const glm::vec3 place =
            render::transformPoint(frame.figures[0].palette[render::kFirstFingerJoint + i],
                                   frame.figures[0].body->fit.fingerOrigins[i]);
        EXPECT_NEAR(place.x, pose->segments[first + i].position.x(), 1e-4);
        EXPECT_NEAR(place.y, pose->segments[first + i].position.y(), 1e-4);
        EXPECT_NEAR(place.z, pose->segments[first + i].position.z(), 1e-4);
    }
}

TEST_F(SceneBuilderTest, AxesAreDrawnForAllForTheSelectedOrForNone) {
    perform(2);
    EXPECT_EQ(build().axes.size(), 2U * 23);
    axes = AxesMode::Selected;
    EXPECT_TRUE(build().axes.empty());
    stage.session.setSelection({stage.sender(), stage.key(1), -1});
    EXPECT_EQ(build().axes.size(), 23U);
    axes = AxesMode::None;
    EXPECT_TRUE(build().axes.empty());
}

TEST_F(SceneBuilderTest, TheGhostStandsOnTheFloorUnderTheLivePelvisAndLooksItsWay) {
    perform(2);
    EXPECT_TRUE(build().ghosts.empty());
    stage.session.setGhostShown(true);
    stage.session.setSelection({stage.sender(), stage.key(1), 6});
    const SceneFrame frame = build();
    ASSERT_EQ(frame.ghosts.size(), 1U);
    const Figure& ghost = frame.ghosts[0];
    EXPECT_EQ(ghost.key, stage.key(1));
    EXPECT_LT(ghost.look.opacity, 1.0F);
    EXPECT_EQ(ghost.look.selectedSegment, 6);
    const auto at = [&](render::Segment segment) {
        return render::transformPoint(ghost.palette[segment], ghost.body->fit.origins[segment]);
    };
    const model::SegmentPose& pelvis = stage.session.messages().pose(stage.key(1))->segments[0];
    EXPECT_NEAR(at(render::Pelvis).x, pelvis.position.x(), 1e-4);
    EXPECT_NEAR(at(render::Pelvis).y, pelvis.position.y(), 1e-4);
    EXPECT_NEAR(at(render::RightToe).z, 0.015, 0.004); // the ball of the foot, over the sole
    const glm::vec3 leftwards = glm::normalize(at(render::LeftHand) - at(render::RightHand));
    const Eigen::Vector3d ahead = pelvis.orientation * Eigen::Vector3d::UnitX();
    EXPECT_NEAR(leftwards.x * ahead.x() + leftwards.y * ahead.y(), 0.0, 1e-3);
    EXPECT_GT(ahead.x() * leftwards.y - ahead.y() * leftwards.x, 0.0);
}

TEST_F(SceneBuilderTest, WithoutANullPoseThereIsNoGhost) {
    performer::Performer performer(sending(1, {2}));
    stage.perform(performer, 0, 3);
    stage.follow();
    stage.session.setGhostShown(true);
    EXPECT_TRUE(build().ghosts.empty());
}

TEST_F(SceneBuilderTest, TheSelectedSegmentIsMarkedOnItsCharacterOnly) {
    perform(2);
    stage.session.setSelection({stage.sender(), stage.key(1), 6});
    const SceneFrame frame = build();
    EXPECT_EQ(frame.figures[0].look.selectedSegment, -1);
    EXPECT_EQ(frame.figures[1].look.selectedSegment, 6);
}

TEST_F(SceneBuilderTest, HiddenCharactersAreLeftOut) {
    perform(2);
    stage.session.setHidden(stage.key(0), true);
    const SceneFrame frame = build();
    ASSERT_EQ(frame.figures.size(), 1U);
    EXPECT_EQ(frame.figures[0].key, stage.key(1));
    EXPECT_EQ(frame.axes.size(), 23U);
}

TEST_F(SceneBuilderTest, DataThatStopFadeAndAreStripedAfterASecond) {
    perform(1);
    const log::Stamp newest = stage.now;
    stage.session.follow(newest + 300ms);
    const SceneFrame fading = build();
    EXPECT_GT(fading.figures[0].look.dim, 0.1F);
    EXPECT_FALSE(fading.figures[0].look.isHatched);
    stage.session.follow(newest + 1100ms);
    const SceneFrame stale = build();
    EXPECT_GT(stale.figures[0].look.dim, fading.figures[0].look.dim);
    EXPECT_TRUE(stale.figures[0].look.isHatched);
}

TEST_F(SceneBuilderTest, TheMeshIsMadeOnceForANullPose) {
    perform(1);
    EXPECT_EQ(build().figures[0].body, build().figures[0].body);
}

TEST_F(SceneBuilderTest, ABodyThatItsScaleMessageContradictsHasTheSizeOfItsPoses) {
    perform(sending(1, {12, 13}));
    wire::PoseQuaternion child;
    std::uint32_t id = 0;
    for (const Eigen::Vector3d& place : model::referenceOrigins()) {
        const Eigen::Vector3f position = (0.6 * place).cast<float>();
        child.segments.push_back({++id, {position.x(), position.y(), position.z()}, {1, 0, 0, 0}});
    }
    for (std::uint32_t sample = 10; sample < 14; ++sample) {
        stage.send(child, sample, 4 * sample, stage.now + 4ms);
    }
    stage.follow();
    stage.session.setGhostShown(true);
    stage.session.setSelection({stage.sender(), stage.key(), 0});
    const SceneFrame frame = build();
    const auto thigh = [](const Figure& figure) {
        const render::NullPose& origins = figure.body->fit.origins;
        return glm::distance(origins[render::RightUpperLeg], origins[render::RightLowerLeg]);
    };
    EXPECT_NEAR(thigh(frame.figures.at(0)), 0.6 * 0.4285, 0.025);
    EXPECT_GT(thigh(frame.ghosts.at(0)), 0.38) << "the ghost is the scale message as it was sent";
}

TEST(DimFor, IsNothingForLiveDataAndNeverFalls) {
    EXPECT_EQ(dimFor(0), 0.0F);
    EXPECT_EQ(dimFor(kSilentAge - 0.01), 0.0F);
    float before = 0;
    for (double age = kSilentAge; age < 3; age += 0.05) {
        EXPECT_GE(dimFor(age), before);
        before = dimFor(age);
    }
    EXPECT_LT(before, 1.0F);
}

TEST_F(SceneBuilderTest, ASecondRecordingIsDrawnThroughWithLinesToWhereItDiffers) {
    perform(1);
    Stage second;
    performer::Performer performer(sending(1, {2, 12, 13}));
    second.perform(performer, 0, 200);
    second.follow();
    ComparisonState state;
    state.isOpen = true;
    state.name = "take-2.pcapng";
    state.second = &second.session;
    state.pair.emplace(stage.key(), second.key());
    const auto compare = [&](model::DifferenceFrame frame) {
        state.choice.frame = frame;
        state.atCursor.emplace();
        ASSERT_TRUE(model::differenceOf(*stage.session.messages().pose(stage.key()),
                                        *second.session.messages().pose(second.key()), frame,
                                        *state.atCursor));
    };
    EXPECT_TRUE(build().ghosts.empty());
    builder.setComparison(&state);
    EXPECT_TRUE(build().ghosts.empty()) << "no partner";

    compare(model::DifferenceFrame::World);
    const auto placeOf = [](const Figure& figure, int segment) {
        const auto place = static_cast<std::size_t>(segment);
        return render::transformPoint(figure.palette[place], figure.body->fit.origins[place]);
    };
    SceneFrame frame = build();
    ASSERT_EQ(frame.ghosts.size(), 1U);
    EXPECT_LT(frame.ghosts[0].look.opacity, 1);
    EXPECT_EQ(frame.lines.size(), 23U);
    EXPECT_EQ(frame.points.size(), 23U);
    ASSERT_EQ(frame.texts.size(), 1U);
    EXPECT_TRUE(frame.texts[0].text.startsWith("take-2.pcapng · "));
    const auto sent = second.session.messages().pose(second.key())->segments[model::segment::kHead].position;
    EXPECT_NEAR(placeOf(frame.ghosts[0], model::segment::kHead).x, sent.x(), 1e-4);

    compare(model::DifferenceFrame::Pelvis);
    frame = build();
    EXPECT_NEAR(glm::length(placeOf(frame.ghosts[0], 0) - placeOf(frame.figures[0], 0)), 0, 1e-4);

    state.choice.isBeside = true;
    stage.session.setSelection({stage.sender(), stage.key(), model::segment::kHead});
    frame = build();
    EXPECT_NEAR(glm::length(placeOf(frame.ghosts[0], 0) - placeOf(frame.figures[0], 0)), 1.2, 1e-3);
    EXPECT_TRUE(frame.lines.empty());
    EXPECT_EQ(frame.points.size(), 46U);
    ASSERT_EQ(frame.texts.size(), 2U);
    EXPECT_TRUE(frame.texts[0].text.contains(" °") || frame.texts[1].text.contains(" °"));
    stage.session.setHidden(stage.key(), true);
    EXPECT_TRUE(build().ghosts.empty());
}

} // namespace
} // namespace posewire::gui
