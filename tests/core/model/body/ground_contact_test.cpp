// SPDX-License-Identifier: MIT
#include "core/model/body/pose_solver.h"

#include <gtest/gtest.h>

namespace posewire::model {
namespace {

using Eigen::Vector3d;

CharacterPose standing() {
    CharacterPose pose;
    for (const Vector3d& place : referenceOrigins()) {
        pose.segments.push_back({place, Eigen::Quaterniond::Identity()});
    }
    pose.sources.assign(kBodySegmentCount, {Provenance::Sent, Provenance::Sent});
    return pose;
}

const BodyOrigins kBody{referenceOrigins()};

TEST(SoleContacts, AreAllOfBothFeetWhereABodyStands) {
    EXPECT_EQ(soleContacts(standing(), kBody).size(), 8U);
}

TEST(SoleContacts, LeaveOutWhatIsLifted) {
    CharacterPose pose = standing();
    pose.segments[segment::kLeftFoot].position.z() += 0.1;
    pose.segments[segment::kLeftToe].position.z() += 0.1;
    const auto contacts = soleContacts(pose, kBody);
    ASSERT_EQ(contacts.size(), 4U);
    for (const Vector3d& contact : contacts) {
        EXPECT_LT(contact.y(), 0) << "of the right foot";
        EXPECT_LT(contact.z(), kContactHeight);
    }
    pose.isObjects = true;
    EXPECT_TRUE(soleContacts(pose, kBody).empty());
}

TEST(SupportPolygons, GoRoundWhatIsOutside) {
    const auto hull =
        supportPolygon({{0, 0, 0}, {1, 0, 0}, {0.5, 0.4, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0, 0}});
    ASSERT_EQ(hull.size(), 4U) << "neither what is inside nor what is on an edge";
    double area = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Vector3d& a = hull[i];
        const Vector3d& b = hull[(i + 1) % hull.size()];
        area += 0.5 * (a.x() * b.y() - b.x() * a.y());
    }
    EXPECT_DOUBLE_EQ(area, 1.0) << "counter-clockwise";
}

TEST(SupportPolygons, OfAPointOrALineAreNoArea) {
    EXPECT_EQ(supportPolygon({{1, 2, 0}}).size(), 1U);
    EXPECT_LT(supportPolygon({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}).size(), 3U);
    EXPECT_TRUE(supportPolygon({}).empty());
}

} // namespace
} // namespace posewire::model
