// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/overlays.h"

#include "app/gui/viewport/picking.h"
#include "core/model/body/character_pose.h"
#include "core/model/session/messages.h"
#include "tests/app/gui/models/stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace posewire::gui {
namespace {

class OverlayTest : public testing::Test {
protected:
    void perform(const std::vector<std::uint8_t>& types, std::uint64_t frames = 60) {
        performer::Performer performer(sending(2, types));
        stage.perform(performer, 0, frames);
        stage.follow();
    }
    void select(std::uint8_t character, int segment = -1) {
        stage.session.setSelection({stage.sender(), stage.key(character), segment});
    }
    /// What is drawn with one overlay on, or with none.
    SceneFrame with(std::optional<Overlay> overlay) {
        Overlays on;
        if (overlay) {
            on.toggle(*overlay);
        }
        SceneFrame frame;
        builder.build(AxesMode::None, on, frame);
        return frame;
    }

    Stage stage;
    SceneBuilder builder{stage.session, render::Detail::Medium};
};

TEST_F(OverlayTest, NothingIsDrawnUnasked) {
    perform({1, 2, 3, 13, 20, 21, 23, 24});
    const SceneFrame frame = with({});
    EXPECT_TRUE(frame.lines.empty());
    EXPECT_TRUE(frame.points.empty());
    EXPECT_TRUE(frame.texts.empty());
    EXPECT_TRUE(frame.axes.empty());
}

TEST_F(OverlayTest, EachDrawsSomethingWhereItsMessagesAreOnTheAir) {
    perform({1, 2, 3, 13, 20, 21, 23, 24});
    select(1);
    for (const OverlayEntry& entry : kOverlayTable) {
        const SceneFrame frame = with(entry.overlay);
        EXPECT_GT(frame.lines.size() + frame.points.size() + frame.texts.size() + frame.axes.size(), 0U)
            << entry.key;
        for (const render::LineInstance& line : frame.lines) {
            EXPECT_TRUE(std::isfinite(line.from.x + line.to.x + line.to.z)) << entry.key;
        }
    }
}

TEST_F(OverlayTest, WhatIsNotSentIsNotDrawn) {
    perform({2, 13});
    for (const Overlay overlay : {Overlay::Markers, Overlay::Trackers, Overlay::CentreOfMass,
                                  Overlay::Velocity, Overlay::Acceleration}) {
        const SceneFrame frame = with(overlay);
        EXPECT_TRUE(frame.lines.empty() && frame.points.empty() && frame.texts.empty());
    }
}

TEST_F(OverlayTest, AreOfTheSelectedCharacterOrOfAll) {
    perform({2, 3, 13});
    EXPECT_EQ(with(Overlay::Markers).points.size(), 128U);
    EXPECT_TRUE(with(Overlay::Markers).texts.empty()) << "words of two would lie on each other";
    select(0);
    EXPECT_EQ(with(Overlay::Markers).points.size(), 64U);
    EXPECT_EQ(with(Overlay::Markers).texts.size(), 64U);
}

TEST_F(OverlayTest, NamesOfTheFarSideAreFainterAndAllHaveAPlace) {
    perform({2, 3, 13});
    EXPECT_TRUE(with(Overlay::Markers).hasNamesLeftOut) << "of two";
    select(0);
    SceneFrame frame = with(Overlay::Markers);
    EXPECT_FALSE(frame.hasNamesLeftOut);
    const model::CharacterPose& pose = *stage.session.messages().pose(stage.key());
    const Eigen::Vector3d ahead = pose.segments[0].orientation * Eigen::Vector3d::UnitX();
    frame.camera.target = pointOf(pose.segments[0].position);
    frame.camera.distance = 3;
    frame.camera.pitch = 0;
    const auto strengthOf = [&](const char* name, bool isFromAhead) {
        frame.camera.yaw =
            static_cast<float>(std::atan2(ahead.y(), ahead.x())) + (isFromAhead ? 0.0F : glm::pi<float>());
        const auto texts = textsOf(frame, {800, 800});
        const auto found = std::ranges::find(texts, QString::fromLatin1(name), &ViewportText::text);
        return found == texts.end() ? 0.0 : found->colour.alphaF();
    };
    const bool isLookedAtFromAhead = strengthOf("pPX", true) == 1.0;
    EXPECT_NE(strengthOf("pPX", true), strengthOf("pPX", false)) << "the sternum";
    EXPECT_LT(strengthOf("pSacrum", isLookedAtFromAhead), 0.6);
    EXPECT_EQ(strengthOf("pSacrum", !isLookedAtFromAhead), 1.0);
}

TEST_F(OverlayTest, MarkersAreWhereTheirSegmentsHaveThem) {
    perform({2, 3, 13});
    select(0);
    const SceneFrame frame = with(Overlay::Markers);
    const auto sacrum = std::ranges::find(frame.texts, QStringLiteral("pSacrum"), &SceneText::text);
    ASSERT_NE(sacrum, frame.texts.end());
    const model::CharacterPose& pose = *stage.session.messages().pose(stage.key());
    const auto local = stage.session.messages().bodyOrigins(stage.key()).pointOf(model::segment::kPelvis, 13);
    const Eigen::Vector3d place = pose.segments[0].position + pose.segments[0].orientation * *local;
    EXPECT_NEAR(sacrum->position.x, place.x(), 1e-4);
    EXPECT_NEAR(sacrum->position.y, place.y(), 1e-4);
    EXPECT_NEAR(sacrum->position.z, place.z(), 1e-4);
}

TEST_F(OverlayTest, TheAngleOfASelectedJointIsThatOfType20) {
    perform({2, 13, 20});
    select(0, model::segment::kRightLowerLeg);
    const SceneFrame frame = with(Overlay::JointAngles);
    ASSERT_EQ(frame.texts.size(), 1U);
    const model::Message* message = stage.session.messages().message(stage.key(), 20);
    ASSERT_NE(message, nullptr);
    const float knee = std::get<wire::JointAngles>(message->datagram.body).joints[15].rotation[2];
    EXPECT_EQ(frame.texts[0].text, QStringLiteral("%1 °").arg(knee, 0, 'f', 1));
}

TEST_F(OverlayTest, EachJointOfTheBodyHasAnAngleWhereItIsSelected) {
    perform({2, 13, 20});
    for (int segment = 1; segment < model::kBodySegmentCount; ++segment) {
        select(0, segment);
        EXPECT_EQ(with(Overlay::JointAngles).texts.size(), 1U) << segment;
    }
}

TEST_F(OverlayTest, TheAngleIsComputedFromThePoseWhereType20IsNotSent) {
    perform({2, 13, 20});
    select(0, model::segment::kRightLowerLeg);
    const QString sent = with(Overlay::JointAngles).texts.at(0).text;
    Stage other;
    performer::Performer performer(sending(2, {2, 13}));
    other.perform(performer, 0, 60);
    other.follow();
    other.session.setSelection({other.sender(), other.key(), model::segment::kRightLowerLeg});
    SceneBuilder builderOfOther{other.session, render::Detail::Medium};
    Overlays on;
    on.toggle(Overlay::JointAngles);
    SceneFrame frame;
    builderOfOther.build(AxesMode::None, on, frame);
    EXPECT_EQ(frame.texts.at(0).text, sent);
}

TEST_F(OverlayTest, ThePlumbLineOfTheCentreOfMassMeetsTheFloor) {
    perform({2, 13, 24});
    select(0);
    const SceneFrame frame = with(Overlay::CentreOfMass);
    ASSERT_EQ(frame.points.size(), 2U);
    EXPECT_LT(frame.points[0].position.z, 0.01F);
    EXPECT_GT(frame.points[1].position.z, 0.7F);
    EXPECT_EQ(frame.points[0].position.x, frame.points[1].position.x);
}

TEST_F(OverlayTest, ATrailEndsAtItsSegment) {
    perform({2, 13}, 200);
    select(0, model::segment::kRightHand);
    const SceneFrame frame = with(Overlay::Trails);
    ASSERT_GT(frame.lines.size(), 10U);
    const Eigen::Vector3d hand =
        stage.session.messages().pose(stage.key())->segments[model::segment::kRightHand].position;
    const glm::vec3 end = frame.lines.back().to;
    EXPECT_LT((Eigen::Vector3d(end.x, end.y, end.z) - hand).norm(), 0.02);
    EXPECT_LT(frame.lines.front().colour.a, frame.lines.back().colour.a) << "it fades";
}

TEST_F(OverlayTest, FollowABodyThatWasPutOnTheFloor) {
    perform({22, 24});
    select(1);
    const model::CharacterPose& pose = *stage.session.messages().pose(stage.key(1));
    EXPECT_TRUE(pose.isPlaceAssumed);
    EXPECT_EQ(pose.moved.y(), 1.0) << "those whose place is not known stand side by side";
}

TEST(Axes, KeepTheirLengthOnTheScreen) {
    SceneFrame frame;
    frame.width = 1280;
    frame.height = 720;
    frame.camera.distance = 4;
    frame.axes = {{frame.camera.target, {}, 30.0F}};
    sizeAxes(frame);
    const float near = frame.axes[0].length;
    frame.camera.distance = 6;
    frame.axes = {{frame.camera.target, {}, 30.0F}};
    sizeAxes(frame);
    EXPECT_NEAR(frame.axes[0].length / near, 1.5F, 1e-3F);
    frame.camera.distance = 100;
    frame.axes = {{frame.camera.target, {}, 30.0F}};
    sizeAxes(frame);
    EXPECT_LE(frame.axes[0].length, 0.25F) << "not longer than a forearm";
}

} // namespace
} // namespace posewire::gui
