// SPDX-License-Identifier: MIT
#include "core/model/body/pose_solver.h"

#include "core/performer/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

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

/// Every joint swings on its own, hips, knees, arms and head up to 70° about each axis; the spine as MVN's.
performer::BodyPose contortion(double seconds) {
    performer::BodyPose pose = performer::makeMotion("tpose", {makeReferenceBody()})->sample(0);
    for (std::size_t i = 0; i < kBodySegmentCount; ++i) {
        constexpr std::array kSpine{1.0, 0.444, 0.444, 0.333};
        const bool isSpine = i >= segment::kL5 && i <= segment::kT8;
        const bool isStiff = i == segment::kNeck || i == segment::kRightShoulder ||
                             i == segment::kLeftShoulder || i == segment::kRightToe || i == segment::kLeftToe;
        const double most = isSpine ? 0.25 * kSpine[i - segment::kL5] : isStiff ? 0.15 : 1.2;
        const double own = isSpine ? 0 : static_cast<double>(i);
        const Vector3d turn =
            most * Vector3d(std::sin(seconds * 1.3 + own), std::sin(seconds * 2.1 + 2 * own),
                            std::sin(seconds * 1.7 + 3 * own));
        const Quaterniond local(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
        pose[i].orientation = i == 0 ? local : pose[parentOf(i)].orientation * local;
        if (i != 0) {
            const SegmentPose& parent = pose[parentOf(i)];
            pose[i].position = parent.position +
                               parent.orientation * (kPerformer.places[i] - kPerformer.places[parentOf(i)]);
        }
    }
    return pose;
}

PoseEvidence::Before asBefore(const SolvedBody& solved, double seconds) {
    PoseEvidence::Before before{{}, {}, seconds};
    for (std::size_t i = 0; i < kBodySegmentCount; ++i) {
        before.orientations[i] = solved.segments[i].orientation;
        before.heldSeconds[i] = solved.sources[i].heldSeconds;
    }
    return before;
}

/// Off by up to 1 mm, and a fifth of them lost.
void addMarkers(const performer::BodyPose& truth, std::minstd_rand& dice, PoseEvidence& evidence) {
    std::uniform_real_distribution<double> off(-0.001, 0.001);
    for (const int place : markerPoints()) {
        const AnatomicalPoint& point = anatomicalPoints()[static_cast<std::size_t>(place)];
        const auto i = static_cast<std::size_t>(point.segment);
        const Vector3d local(point.reference.data());
        const Vector3d world = truth[i].position + truth[i].orientation * local;
        if (dice() % 5 != 0) {
            evidence.markers[i].push_back({local, world + Vector3d(off(dice), off(dice), off(dice))});
        }
    }
}

TEST(SolvedBodies, BearThatAFifthOfTheMarkersIsLost) {
    std::minstd_rand dice(7);
    SolvedBody solved;
    for (int frame = 0; frame < 1200; ++frame) {
        const performer::BodyPose truth = contortion(frame / 60.0);
        PoseEvidence evidence;
        addMarkers(truth, dice, evidence);
        if (frame != 0) {
            evidence.before = asBefore(solved, 1.0 / 60);
        }
        solved = solveBody(evidence, kPerformer);
        for (std::size_t i = 0; frame > 2 && i < kBodySegmentCount; ++i) {
            const SegmentPose& is = solved.segments[i];
            EXPECT_LT((is.position - truth[i].position).norm(), 0.03) << frame << ' ' << i;
            if (i != segment::kNeck) { // it has no marker
                EXPECT_LT(degrees(is.orientation.angularDistance(truth[i].orientation)), 15.0)
                    << frame << ' ' << i;
            }
        }
    }
}

TEST(SolvedBodies, NeverPopWhenLimbsStraighten) {
    std::optional<performer::BodyPose> truthBefore;
    SolvedBody before;
    for (int frame = 0; frame < 2400; ++frame) {
        const performer::BodyPose truth = contortion(frame / 60.0);
        PoseEvidence evidence = positionsOf(truth);
        if (truthBefore) {
            evidence.before = asBefore(before, 1.0 / 60);
        }
        const SolvedBody solved = solveBody(evidence, kPerformer);
        for (std::size_t i = 0; truthBefore && i < kBodySegmentCount; ++i) {
            const double own = truth[i].orientation.angularDistance((*truthBefore)[i].orientation);
            const double is = solved.segments[i].orientation.angularDistance(before.segments[i].orientation);
            EXPECT_LT(degrees(is - own), 5.0) << frame << ' ' << i;
        }
        before = solved;
        truthBefore = truth;
    }
}

/// Type 22 of a pose.
wire::Datagram turnsOf(const performer::BodyPose& pose) {
    wire::AngularKinematics message;
    for (std::uint32_t id = 1; const SegmentPose& segment : pose) {
        const Eigen::Quaternionf q = segment.orientation.cast<float>();
        message.segments.push_back({id++, {q.w(), q.x(), q.y(), q.z()}});
    }
    wire::Datagram datagram{{}, std::move(message), {}};
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    return datagram;
}

TEST(SolvedBodies, BendAsTheirLimbsHaveBentWithOrientations) {
    // An elbow that bends about an axis between its own and the vertical, as abducted ones do.
    const auto poseAt = [](double bend) {
        performer::BodyPose pose = performer::makeMotion("tpose", {makeReferenceBody()})->sample(0);
        const Quaterniond turn(Eigen::AngleAxisd(bend, Vector3d(1, 0, 1).normalized()));
        for (const std::size_t i : {segment::kRightForeArm, segment::kRightHand}) {
            const auto& upper = pose[segment::kRightForeArm].position;
            pose[i] = {upper + turn * (pose[i].position - upper), turn};
        }
        return pose;
    };
    BendMeasure measure;
    for (int i = 0; i < 1600; ++i) {
        measure.add(turnsOf(poseAt(0.5 + i / 3200.0)));
    }
    BodyOrigins body = kPerformer;
    const auto upperArmOff = [&](const BodyOrigins& one) {
        const auto truth = poseAt(1.0);
        const SolvedBody solved = solveBody(positionsOf(truth), one);
        return degrees(solved.segments[segment::kRightUpperArm].orientation.angularDistance(
            truth[segment::kRightUpperArm].orientation));
    };
    EXPECT_GT(upperArmOff(body), 30);
    body.bends = measure.bends();
    EXPECT_LT(upperArmOff(body), 3);
    EXPECT_TRUE(body.bends[1].upper.isZero()) << "the left one has not bent";
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
