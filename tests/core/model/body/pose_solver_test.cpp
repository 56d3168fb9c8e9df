// SPDX-License-Identifier: MIT
#include "core/model/body/pose_solver.h"

#include "core/performer/motion.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace posewire::model {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

const BodyOrigins kPerformer{referenceOrigins()};

/// The origins of a pose alone, each off by up to a few millimetres, as joints open in recordings.
PoseEvidence positionsOf(const performer::BodyPose& pose, double off = 0) {
    PoseEvidence evidence;
    for (std::size_t i = 0; i < pose.size(); ++i) {
        const auto way = static_cast<double>(i);
        evidence.positions[i] =
            pose[i].position + off * Vector3d(std::sin(way), std::cos(3 * way), std::sin(5 * way));
    }
    return evidence;
}

double degrees(double radians) {
    return radians * kDegreesPerRadian;
}

TEST(SolvedBodies, TurnSteadily) {
    for (const std::string_view name : performer::motionNames()) {
        const auto motion = performer::makeMotion(name, {makeReferenceBody()});
        std::optional<SolvedBody> before;
        for (double seconds = 0; seconds < 6; seconds += 1.0 / 240) {
            const SolvedBody solved = solveBody(positionsOf(motion->sample(seconds)), kPerformer);
            for (std::size_t i = 0; before && i < kBodySegmentCount; ++i) {
                const double turn =
                    before->segments[i].orientation.angularDistance(solved.segments[i].orientation);
                EXPECT_LT(degrees(turn), 4.0) << name << ' ' << i << " at " << seconds;
            }
            before = solved;
        }
    }
}

TEST(SolvedBodies, PointWithinThreeDegreesWhereJointsAreOpen) {
    const auto motion = performer::makeMotion("walk", {makeReferenceBody()});
    for (double seconds = 0; seconds < 3; seconds += 0.05) {
        const performer::BodyPose truth = motion->sample(seconds);
        const SolvedBody solved = solveBody(positionsOf(truth, 0.001), kPerformer);
        for (const int i :
             {segment::kRightUpperArm, segment::kLeftForeArm, segment::kRightUpperLeg, segment::kLeftLowerLeg,
              segment::kRightFoot, segment::kNeck, segment::kPelvis, segment::kT8}) {
            const auto place = static_cast<std::size_t>(i);
            const Vector3d bone = kPerformer.places[place + 1] - kPerformer.places[place];
            const Vector3d is = solved.segments[place].orientation * bone;
            const Vector3d should = truth[place].orientation * bone;
            EXPECT_LT(degrees(std::atan2(is.cross(should).norm(), is.dot(should))), 3.0) << i;
        }
    }
}

TEST(SolvedBodies, KnowHowBentLimbsAreTurned) {
    const auto motion = performer::makeMotion("squat", {makeReferenceBody()});
    for (double seconds = 0; seconds < 6; seconds += 0.05) {
        const performer::BodyPose truth = motion->sample(seconds);
        const SolvedBody solved = solveBody(positionsOf(truth), kPerformer);
        for (const std::size_t i : {segment::kRightUpperLeg, segment::kLeftUpperLeg}) {
            const double bend = truth[i].orientation.angularDistance(truth[i + 1].orientation);
            if (degrees(bend) > 30) {
                EXPECT_LT(degrees(truth[i].orientation.angularDistance(solved.segments[i].orientation)), 6.0)
                    << i;
                EXPECT_TRUE(solved.sources[i].isTwistAssumed) << "a knee may turn: it is no proof";
            }
        }
    }
}

TEST(SolvedBodies, AreWholeWhateverIsKnown) {
    const auto motion = performer::makeMotion("wave", {makeReferenceBody()});
    const performer::BodyPose truth = motion->sample(1.0);
    for (std::uint32_t known = 0; known < 4000; ++known) {
        PoseEvidence evidence;
        for (std::size_t i = 0; i < kBodySegmentCount; ++i) {
            const std::uint32_t dice = known * 2654435761U >> (i % 20);
            if ((dice & 1U) != 0) {
                evidence.positions[i] = truth[i].position;
            }
            if ((dice & 6U) == 0) {
                evidence.orientations[i] = truth[i].orientation;
            }
        }
        const SolvedBody solved = solveBody(evidence, kPerformer);
        for (std::size_t i = 0; i < kBodySegmentCount; ++i) {
            EXPECT_TRUE(solved.segments[i].position.allFinite());
            EXPECT_NEAR(solved.segments[i].orientation.norm(), 1.0, 1e-9);
            EXPECT_NE(solved.sources[i].weaker(), Provenance::None);
            EXPECT_EQ(solved.sources[i].position == Provenance::Sent, evidence.positions[i].has_value());
            EXPECT_LT((solved.segments[i].position - solved.segments[0].position).norm(), 2.0);
        }
    }
}

TEST(SolvedBodies, StandAtTheOriginWhereNothingIsKnown) {
    const SolvedBody solved = solveBody({}, kPerformer);
    EXPECT_TRUE(solved.isPlaceAssumed);
    for (std::size_t i = 0; i < kBodySegmentCount; ++i) {
        EXPECT_EQ(solved.sources[i].orientation, Provenance::Assumed);
        EXPECT_LT((solved.segments[i].position - kPerformer.places[i]).norm(), 0.005) << i;
    }
}

} // namespace
} // namespace posewire::model
