// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose_measures.h"

#include "core/model/body/points.h"
#include "core/model/body/reference_body.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace posewire::model {
namespace {

NullPose nullPoseOf(const ReferenceBody& body, bool hasPoints = true) {
    NullPose pose;
    for (int index = 0; index < kBodySegmentCount; ++index) {
        pose.segments.push_back(
            {std::string(bodySegments()[static_cast<std::size_t>(index)].name), body.nullPoseOrigin(index)});
    }
    const auto points = anatomicalPoints();
    for (std::size_t i = 0; hasPoints && i < points.size(); ++i) {
        pose.points.push_back(
            {points[i].segment + 1, points[i].localId, std::string(points[i].name), 0, body.points[i]});
    }
    return pose;
}

const SegmentLength& lengthOf(const NullPoseMeasures& measures, std::string_view name) {
    return *std::ranges::find(measures.lengths, name, &SegmentLength::name);
}

TEST(NullPoseMeasures, HeightAndSpanComeFromThePoints) {
    const NullPoseMeasures measures = measure(nullPoseOf(makeReferenceBody()));
    ASSERT_TRUE(measures.height && measures.armSpan);
    EXPECT_NEAR(*measures.height, 1.75, 0.005);
    EXPECT_NEAR(*measures.armSpan, 2 * (0.685 + 0.186), 0.002);
    EXPECT_FALSE(measures.isEstimated);
}

TEST(NullPoseMeasures, WithoutPointsTheyAreEstimated) {
    const NullPoseMeasures measures = measure(nullPoseOf(makeReferenceBody({.stature = 1.6}), false));
    ASSERT_TRUE(measures.height && measures.armSpan);
    EXPECT_NEAR(*measures.height, 1.6, 0.001);
    EXPECT_NEAR(*measures.armSpan, 2 * 0.871 * 1.6 / 1.75, 0.002);
    EXPECT_TRUE(measures.isEstimated);
}

TEST(NullPoseMeasures, SidesAreComparedAndMarkedFromFiveMillimetres) {
    NullPose pose = nullPoseOf(makeReferenceBody());
    pose.segments[segment::kLeftFoot].position.z() -= 0.004;
    EXPECT_FALSE(lengthOf(measure(pose), "Shank").isAsymmetric());
    pose.segments[segment::kLeftFoot].position.z() -= 0.002;
    const NullPoseMeasures measures = measure(pose);
    EXPECT_TRUE(lengthOf(measures, "Shank").isAsymmetric());
    EXPECT_NEAR(*lengthOf(measures, "Shank").difference(), 0.006, 1e-9);
    EXPECT_NEAR(*lengthOf(measures, "Thigh").rightMetres, 0.4285, 1e-9);
    EXPECT_EQ(lengthOf(measures, "Hip").right, segment::kRightUpperLeg);
    EXPECT_EQ(lengthOf(measures, "Neck").left, -1);
}

TEST(NullPoseMeasures, NamesDecideWhereAllAreThereElseTheOrder) {
    NullPose pose = nullPoseOf(makeReferenceBody());
    std::swap(pose.segments[9], pose.segments[10]);
    EXPECT_EQ(bodyPlaces(pose)[9], 10);
    EXPECT_EQ(bodySegmentAt(bodyPlaces(pose), 9), 10);
    pose.segments[0].name = "Root";
    EXPECT_EQ(bodyPlaces(pose)[9], 9);
    pose.segments.resize(4);
    EXPECT_EQ(bodyPlaces(pose)[9], -1);
    EXPECT_FALSE(measure(pose).armSpan);
}

TEST(NullPoseMeasures, PointsGoWithTheirSegmentWhereverThatIsInTheMessage) {
    NullPose pose = nullPoseOf(makeReferenceBody());
    const NullPoseMeasures measures = measure(pose);
    std::ranges::reverse(pose.segments);
    EXPECT_NEAR(measure(pose).floor, measures.floor, 1e-9);
    EXPECT_NEAR(*measure(pose).height, *measures.height, 1e-9);
    EXPECT_NEAR(bodyOf(pose).floor, measures.floor, 1e-9);
}

TEST(NullPoseMeasures, DistancesToAnEarlierMessageAreAsSent) {
    const NullPose before = nullPoseOf(makeReferenceBody());
    NullPose pose = before;
    pose.segments[6].position.z() += 0.02;
    std::swap(pose.segments[1], pose.segments[2]);
    const Distances distances = distancesTo(pose, before);
    EXPECT_NEAR(distances[6]->z(), 0.02, 1e-12);
    EXPECT_EQ(distances[1]->norm(), 0.0);
    pose.segments.push_back({"Sword", {0, 0, 1}});
    EXPECT_FALSE(distancesTo(pose, before)[23]);
}

TEST(NullPoseMeasures, DistancesToTheReferenceBodyAreThoseOfOneAsTall) {
    for (const double stature : {1.5, 1.75, 2.0}) {
        NullPose pose = nullPoseOf(makeReferenceBody({.stature = stature}));
        for (NullPose::Segment& segment : pose.segments) {
            segment.position += Eigen::Vector3d(0.1, 0.2, -0.8);
        }
        for (const auto& distance : distancesToReference(pose, stature)) {
            EXPECT_LT(distance->norm(), 1e-9);
        }
    }
    NullPose pelvis;
    pelvis.segments = {{"Pelvis", {0, 0, 0}}};
    EXPECT_FALSE(distancesToReference(pelvis, 1.7)[0]);
}

} // namespace
} // namespace posewire::model
