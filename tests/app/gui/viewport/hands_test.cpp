// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/bodies.h"

#include "core/model/body/segments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace posewire::gui {
namespace {

model::CharacterPose poseWith(int props, int fingers) {
    model::CharacterPose pose;
    pose.layout = {model::kBodySegmentCount, props, fingers};
    pose.segments.resize(static_cast<std::size_t>(pose.layout.count()));
    pose.sources.assign(pose.segments.size(), {model::Provenance::Sent, model::Provenance::Sent});
    for (std::size_t i = 0; i < pose.segments.size(); ++i) {
        pose.segments[i].position = {static_cast<double>(i), 0.0, 0.0};
    }
    return pose;
}

TEST(Hands, ComeAfterBodyAndPropsTheLeftOneFirst) {
    const PosedHands hands = handsOf(poseWith(2, 40));
    EXPECT_EQ(hands.left().positions[0].x, 25.0F);
    EXPECT_EQ(hands.left().positions[19].x, 44.0F);
    EXPECT_EQ(hands.right().positions[0].x, 45.0F);
}

TEST(Hands, AreLeftOutWhereNothingIsKnownOfTheirFingers) {
    const PosedHands none = handsOf(poseWith(0, 0));
    EXPECT_FALSE(none.left().isPresent());
    EXPECT_FALSE(none.right().isPresent());
    const PosedHands leftOnly = handsOf(poseWith(0, 20));
    EXPECT_TRUE(leftOnly.left().isPresent());
    EXPECT_FALSE(leftOnly.right().isPresent());
    model::CharacterPose cut = poseWith(0, 40);
    cut.sources.resize(30);
    const PosedHands some = handsOf(cut);
    EXPECT_TRUE(some.left().isPresent());
    EXPECT_FALSE(some.right().isPresent());
    EXPECT_EQ(some.left().positions[6].x, 29.0F);
    EXPECT_TRUE(std::isnan(some.left().positions[7].x));
}

class FingerOrigins : public testing::Test {
protected:
    void add(const char* name, const Eigen::Vector3d& position) {
        m_pose.segments.push_back({name, position});
    }
    void addBody() {
        for (const model::Segment& segment : model::bodySegments()) {
            add(std::string(segment.name).c_str(),
                {0.0, segment.side == model::Side::Left ? 0.7 : -0.7, 1.4});
        }
    }

    model::NullPose m_pose;
    model::BodyOrigins m_body{model::referenceOrigins()};
};

TEST_F(FingerOrigins, AreUnknownWithoutFingersInTheScaleMessage) {
    addBody();
    for (const glm::vec3& origin : fingerOriginsOf(m_pose, m_body)) {
        EXPECT_TRUE(std::isnan(origin.x));
    }
}

TEST_F(FingerOrigins, HangOnTheHandsOfTheBodyThatIsDrawn) {
    addBody();
    add("LeftSecondPP", {0.03, 0.79, 1.41});
    add("RightCarpus", {0.01, -0.7, 1.4});
    add("LeftSixthPP", {0.0, 0.0, 0.0});
    const render::FingerOrigins origins = fingerOriginsOf(m_pose, m_body);
    const Eigen::Vector3d& left = m_body.places[model::segment::kLeftHand];
    const Eigen::Vector3d& right = m_body.places[model::segment::kRightHand];
    EXPECT_NEAR(origins[5].x, left.x() + 0.03, 1e-6);
    EXPECT_NEAR(origins[5].y, left.y() + 0.09, 1e-6);
    EXPECT_NEAR(origins[5].z, left.z() + 0.01, 1e-6);
    EXPECT_NEAR(origins[20].x, right.x() + 0.01, 1e-6);
    EXPECT_EQ(std::ranges::count_if(origins, [](const glm::vec3& at) { return std::isnan(at.x); }), 38);
}

} // namespace
} // namespace posewire::gui
