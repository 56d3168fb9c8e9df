// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace posewire::gui {
namespace {

class BodyFitsTest : public testing::Test {
protected:
    /// A body of its own for each number.
    static render::NullPose poseOf(int number) {
        render::NullPose pose = render::kReferenceNullPose;
        pose[render::Head].z += 0.0001F * static_cast<float>(number);
        return pose;
    }
    static bool isOf(const FigureBody& body, int number) {
        return std::abs(body.fit.origins[render::Head].z - poseOf(number)[render::Head].z) < 1e-5F;
    }

    BodyFits m_fits{render::Detail::Medium};
};

TEST_F(BodyFitsTest, FitEachBodyOnceForAllWhoHaveIt) {
    const auto body = m_fits.of(poseOf(1));
    EXPECT_EQ(m_fits.of(poseOf(1)), body);
    EXPECT_NE(m_fits.of(poseOf(2)), body);
    EXPECT_TRUE(isOf(*body, 1));
    EXPECT_FALSE(isOf(*body, 2));
}

TEST_F(BodyFitsTest, ShareTheMannequin) {
    EXPECT_EQ(m_fits.of(poseOf(1))->mannequin, m_fits.of(poseOf(2))->mannequin);
}

TEST_F(BodyFitsTest, KeepNoMoreHoweverManyAreShownOrHaveBeen) {
    for (int number = 0; number < 400; ++number) {
        EXPECT_TRUE(isOf(*m_fits.of(poseOf(number)), number));
        EXPECT_LE(m_fits.memoryBytes(), m_fits.mostBytes());
    }
    EXPECT_LE(m_fits.mostBytes(), std::size_t{8} << 20);
}

TEST_F(BodyFitsTest, MakeABodyThatIsNoNumberOnce) {
    render::NullPose broken = poseOf(1);
    broken[render::LeftHand].x = std::numeric_limits<float>::quiet_NaN();
    const auto body = m_fits.of(broken);
    EXPECT_EQ(m_fits.of(broken), body);
}

TEST_F(BodyFitsTest, StretchWhatIsPickedWithTheBody) {
    render::NullPose tall = render::kReferenceNullPose;
    for (glm::vec3& origin : tall) {
        origin *= 1.1F;
    }
    const auto reference = m_fits.of(render::kReferenceNullPose);
    const auto body = m_fits.of(tall);
    for (std::size_t segment = 0; segment < render::kSegmentCount; ++segment) {
        EXPECT_NEAR(body->capsules[segment].radius, 1.1F * reference->capsules[segment].radius, 1e-4F);
        EXPECT_NEAR(body->capsules[segment].to.z, 1.1F * reference->capsules[segment].to.z, 1e-4F);
    }
}

} // namespace
} // namespace posewire::gui
