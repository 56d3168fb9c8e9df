// SPDX-License-Identifier: MIT
#include "core/model/body/pose_difference.h"

#include <gtest/gtest.h>

#include <numbers>

namespace posewire::model {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

CharacterPose standingWith(const SegmentLayout& layout = {}) {
    CharacterPose pose;
    pose.layout = layout;
    const auto count = static_cast<std::size_t>(layout.count());
    pose.segments.resize(count);
    pose.sources.assign(count, {Provenance::Sent, Provenance::Sent});
    for (std::size_t i = 0; i < count; ++i) {
        const auto place = static_cast<double>(i);
        pose.segments[i].position = {0.1 * place, 0.02 * place, 0.9 - 0.03 * place};
        pose.segments[i].orientation = Eigen::AngleAxisd(0.1 * place, Eigen::Vector3d(1, 2, 3).normalized());
    }
    return pose;
}

CharacterPose moved(CharacterPose pose, const SegmentPose& motion) {
    for (SegmentPose& segment : pose.segments) {
        segment = composed(motion, segment);
    }
    return pose;
}

SegmentPose turnedBy(double degrees, const Eigen::Vector3d& axis, const Eigen::Vector3d& by) {
    return {by, Eigen::Quaterniond(Eigen::AngleAxisd(degrees * kDegree, axis))};
}

PoseDifference difference(const CharacterPose& first, const CharacterPose& second, DifferenceFrame frame) {
    PoseDifference result;
    EXPECT_TRUE(differenceOf(first, second, frame, result));
    return result;
}

TEST(PoseDifferenceTest, SaysHowFarASegmentIsAndHowMuchItTurned) {
    const CharacterPose first = standingWith();
    CharacterPose second = first;
    second.segments[segment::kLeftHand].position += Eigen::Vector3d(0.006, 0, 0.008);
    second.segments[segment::kLeftHand].orientation =
        second.segments[segment::kLeftHand].orientation *
        Eigen::Quaterniond(Eigen::AngleAxisd(5 * kDegree, Eigen::Vector3d::UnitY()));
    const PoseDifference result = difference(first, second, DifferenceFrame::World);
    ASSERT_EQ(result.segments.size(), 23U);
    for (const SegmentDifference& one : result.segments) {
        const bool isIt = one.slot == segment::kLeftHand;
        EXPECT_NEAR(one.millimetres, isIt ? 10 : 0, 1e-9);
        EXPECT_NEAR(one.degrees, isIt ? 5 : 0, 1e-9);
    }
    EXPECT_NEAR(result.meanMillimetres(), 10.0 / 23, 1e-9);
}

TEST(PoseDifferenceTest, TurnsAreExactWhereSmallAndTheShortWayRound) {
    const Eigen::Quaterniond none = Eigen::Quaterniond::Identity();
    const Eigen::Quaterniond tiny(Eigen::AngleAxisd(1e-6, Eigen::Vector3d::UnitX()));
    EXPECT_NEAR(degreesBetween(none, tiny), 1e-6 / kDegree, 1e-12);
    const Eigen::Quaterniond far(Eigen::AngleAxisd(350 * kDegree, Eigen::Vector3d::UnitX()));
    EXPECT_NEAR(degreesBetween(none, far), 10, 1e-9);
    EXPECT_NEAR(degreesBetween(far, Eigen::Quaterniond(-far.w(), -far.x(), -far.y(), -far.z())), 0, 1e-9);
}

TEST(PoseDifferenceTest, OnTheSpotLeavesOutPlaceAndHeadingAlone) {
    const CharacterPose first = standingWith();
    const CharacterPose second = moved(first, turnedBy(70, Eigen::Vector3d::UnitZ(), {3, -2, 0}));
    EXPECT_GT(difference(first, second, DifferenceFrame::World).meanMillimetres(), 1000);
    const PoseDifference onTheSpot = difference(first, second, DifferenceFrame::Heading);
    EXPECT_NEAR(onTheSpot.meanMillimetres(), 0, 1e-9);
    EXPECT_NEAR(onTheSpot.meanDegrees(), 0, 1e-6);
    const CharacterPose higher = moved(second, turnedBy(0, Eigen::Vector3d::UnitZ(), {0, 0, 0.05}));
    EXPECT_NEAR(difference(first, higher, DifferenceFrame::Heading).meanMillimetres(), 50, 1e-9);
}

TEST(PoseDifferenceTest, WithoutThePelvisOnlyThePoseCounts) {
    const CharacterPose first = standingWith();
    CharacterPose second = moved(first, turnedBy(40, Eigen::Vector3d(1, 1, 2).normalized(), {3, -2, 0.4}));
    EXPECT_NEAR(difference(first, second, DifferenceFrame::Pelvis).meanMillimetres(), 0, 1e-9);
    second.segments[segment::kHead].position += Eigen::Vector3d(0, 0, 0.01);
    const PoseDifference result = difference(first, second, DifferenceFrame::Pelvis);
    EXPECT_NEAR(result.find(segment::kHead)->millimetres, 10, 1e-9);
    EXPECT_NEAR(result.find(segment::kPelvis)->millimetres, 0, 1e-9);
    // The overlay takes the second body to where it was compared.
    const SegmentPose laid = composed(result.overlay, second.segments[segment::kLeftToe]);
    EXPECT_NEAR((laid.position - first.segments[segment::kLeftToe].position).norm(), 0, 1e-9);
}

TEST(PoseDifferenceTest, FindsSegmentsByWhatTheyAreNotByTheirPlace) {
    const CharacterPose first = standingWith({23, 0, 40});
    CharacterPose second = standingWith({23, 2, 20});
    second.segments[25].position = first.segments[23].position + Eigen::Vector3d(0.003, 0, 0);
    const PoseDifference result = difference(first, second, DifferenceFrame::World);
    ASSERT_EQ(result.segments.size(), 43U); // body and left hand
    const SegmentDifference& carpus = result.segments[23];
    EXPECT_EQ(segmentName(kAllSegments, carpus.slot), segmentName(first.layout, 23));
    EXPECT_EQ(carpus.first, 23);
    EXPECT_EQ(carpus.second, 25);
    EXPECT_NEAR(carpus.millimetres, 3, 1e-9);
}

TEST(PoseDifferenceTest, ComparesWhatWasSentNotWhereTheOperatorPutIt) {
    const CharacterPose first = standingWith();
    CharacterPose second = moved(first, turnedBy(0, Eigen::Vector3d::UnitZ(), {0, 0, 0.9}));
    second.moved = {0, 0, 0.9};
    EXPECT_NEAR(difference(first, second, DifferenceFrame::World).meanMillimetres(), 0, 1e-9);
}

TEST(PoseDifferenceTest, LeavesOutWhatNobodyKnows) {
    const CharacterPose first = standingWith();
    CharacterPose second = first;
    second.sources[segment::kHead] = {Provenance::Sent, Provenance::Assumed};
    second.sources[segment::kNeck] = {};
    const PoseDifference result = difference(first, second, DifferenceFrame::World);
    EXPECT_EQ(result.segments.size(), 21U);
    EXPECT_EQ(result.find(segment::kHead), nullptr);
}

TEST(PoseDifferenceTest, SaysWhereNothingCanBeCompared) {
    const CharacterPose first = standingWith();
    PoseDifference result;
    CharacterPose objects = first;
    objects.isObjects = true;
    EXPECT_FALSE(differenceOf(first, objects, DifferenceFrame::World, result));
    CharacterPose headless = first;
    headless.sources[segment::kPelvis] = {};
    EXPECT_TRUE(differenceOf(first, headless, DifferenceFrame::World, result));
    EXPECT_FALSE(differenceOf(first, headless, DifferenceFrame::Pelvis, result));
    EXPECT_FALSE(differenceOf(first, CharacterPose(), DifferenceFrame::World, result));
    EXPECT_TRUE(result.segments.empty());
}

} // namespace
} // namespace posewire::model
