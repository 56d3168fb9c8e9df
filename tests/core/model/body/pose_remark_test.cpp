// SPDX-License-Identifier: MIT
#include "core/model/body/pose_remark.h"

#include "core/model/body/pose_solver.h"

#include "tests/support/facts.h"

#include <gtest/gtest.h>

namespace posewire::model {
namespace {

using Kind = words::Kind;
using Lines = std::vector<words::Fact>;

words::Fact ofSegments(Kind kind, std::vector<std::string> names) {
    return {kind, {{"segments", std::move(names)}}};
}

BodyOrigins scaled() {
    BodyOrigins body{referenceOrigins()};
    body.source = BodySource::NullPose;
    return body;
}

/// The reference body as it stands, of one type or of several.
CharacterPose standingFrom(std::vector<std::uint8_t> types) {
    CharacterPose pose;
    pose.layout = {};
    for (const Eigen::Vector3d& place : referenceOrigins()) {
        pose.segments.push_back({place, Eigen::Quaterniond::Identity()});
    }
    pose.sources.assign(kBodySegmentCount, {Provenance::Sent, Provenance::Sent});
    pose.type = types.front();
    pose.types = std::move(types);
    return pose;
}

TEST(PoseRemarks, AreNoneOfWhatWasSentWhole) {
    for (const std::vector<std::uint8_t>& types : {std::vector<std::uint8_t>{2}, {1}, {5}, {21, 22}}) {
        const PoseRemark remark = remarkOn(standingFrom(types), scaled());
        EXPECT_TRUE(remark.isEmpty());
        EXPECT_FALSE(remark.isAssumed);
        EXPECT_TRUE(remark.reason.isNothing());
    }
}

TEST(PoseRemarks, NameWhatIsMissing) {
    CharacterPose pose = standingFrom({2});
    pose.sources[segment::kLeftForeArm] = {Provenance::Solved, Provenance::Solved};
    EXPECT_EQ(remarkOn(pose, scaled()).lines, (Lines{ofSegments(Kind::SegmentsSolved, {"Left Forearm"})}));
    EXPECT_FALSE(remarkOn(pose, scaled()).isAssumed);
    EXPECT_TRUE(remarkOn(pose, scaled()).brief.isNothing());
    pose.sources[segment::kLeftHand] = {Provenance::Assumed, Provenance::Assumed};
    const PoseRemark remark = remarkOn(pose, scaled());
    EXPECT_TRUE(remark.isAssumed);
    EXPECT_EQ(remark.reason, ofSegments(Kind::SegmentsAssumed, {"Left Hand"}));
    EXPECT_EQ(remark.brief.kind, Kind::PartlyAssumed);
    EXPECT_EQ(remark.lines.size(), 2U);
}

TEST(PoseRemarks, NameAFewSegmentsAndCountTheRest) {
    CharacterPose pose = standingFrom({2});
    for (std::size_t i = 0; i < 8; ++i) {
        pose.sources[i].orientation = Provenance::Solved;
    }
    EXPECT_EQ(say(remarkOn(pose, scaled()).lines.front(), words::Form::Headline),
              "Not sent, solved from the others: Pelvis, L5, L3 and 5 more");
}

TEST(PoseRemarks, TellWhatATypeAloneLacks) {
    CharacterPose positions = standingFrom({21});
    positions.sources[segment::kHead].orientation = Provenance::Assumed;
    EXPECT_EQ(remarkOn(positions, scaled()).reason.kind, Kind::NoOrientations);
    CharacterPose orientations = standingFrom({22});
    orientations.isPlaceAssumed = true;
    orientations.sources[segment::kPelvis].position = Provenance::Assumed;
    const PoseRemark remark = remarkOn(orientations, scaled());
    EXPECT_TRUE(remark.isAssumed);
    EXPECT_EQ(remark.lines, (Lines{{Kind::NoPositions}}));
    EXPECT_FALSE(remarkOn(standingFrom({3}), scaled()).isAssumed);
}

TEST(PoseRemarks, TellWhoseBodyIsDrawn) {
    BodyOrigins body{referenceOrigins()};
    EXPECT_EQ(remarkOn(standingFrom({2}), body).lines, (Lines{{Kind::ReferenceBody}}));
    EXPECT_FALSE(remarkOn(standingFrom({2}), body).isAssumed) << "its joints were sent";
    EXPECT_TRUE(remarkOn(standingFrom({5}), body).isAssumed) << "its joints rest on the bones";
    EXPECT_TRUE(remarkOn(standingFrom({3}), body).isAssumed) << "whose markers these are is not known";
    EXPECT_EQ(remarkOn(standingFrom({3}), body).reason.kind, Kind::ReferenceBody);
    EXPECT_FALSE(remarkOn(standingFrom({21, 3}), body).isAssumed) << "its joints were sent";
    body.source = BodySource::Poses;
    EXPECT_EQ(remarkOn(standingFrom({5}), body).lines, (Lines{{Kind::BonesMeasured}}));
    body.hasMeshScale = true;
    EXPECT_EQ(remarkOn(standingFrom({5}), body).lines,
              (Lines{{Kind::BonesMeasured, {{"scale", words::Fact{Kind::MeshScale}}}}}));
    EXPECT_FALSE(remarkOn(standingFrom({5}), body).isAssumed);
}

TEST(PoseRemarks, DoubtAScaleMessageThatThePosesContradict) {
    BodyOrigins body = scaled();
    for (const double scale : {0.95, 1.0, 1.05}) { // joints are open
        body.places = referenceOrigins();
        for (Eigen::Vector3d& place : body.places) {
            place *= scale;
        }
        EXPECT_TRUE(remarkOn(standingFrom({2}), body).isEmpty()) << scale;
        EXPECT_EQ(scaleInPose(standingFrom({2}), body), 1);
    }
    for (Eigen::Vector3d& place : body.places) {
        place *= 1.6;
    }
    for (const std::vector<std::uint8_t>& types : {std::vector<std::uint8_t>{2}, {1}, {21}, {21, 22}}) {
        const PoseRemark remark = remarkOn(standingFrom(types), body);
        EXPECT_TRUE(remark.isAssumed);
        EXPECT_EQ(remark.lines.back().kind, Kind::LongerThanScale);
        EXPECT_NEAR(scaleInPose(standingFrom(types), body), 1 / (1.05 * 1.6), 0.011);
        EXPECT_EQ(remark.brief.kind, Kind::WrongScale);
    }
    CharacterPose solved = standingFrom({22});
    for (SegmentSource& source : solved.sources) {
        source.position = Provenance::Solved;
    }
    EXPECT_TRUE(remarkOn(solved, body).brief.isNothing()) << "its joints stand on these bones";
    CharacterPose one = standingFrom({2});
    one.segments[segment::kLeftHand].position.x() += 1; // a joint that jumps
    EXPECT_TRUE(remarkOn(one, scaled()).isEmpty());
}

TEST(PoseRemarks, TellOfABodyBelowTheFloor) {
    CharacterPose pose = standingFrom({2});
    EXPECT_FALSE(isBelowFloor(pose));
    for (SegmentPose& segment : pose.segments) {
        segment.position.z() -= 0.9275;
    }
    EXPECT_TRUE(isBelowFloor(pose));
    EXPECT_EQ(remarkOn(pose, scaled()).lines, (Lines{{Kind::SentBelowFloor}}));
    pose.isLifted = true;
    EXPECT_EQ(remarkOn(pose, scaled()).lines, (Lines{{Kind::PlacedOnFloor}}));
}

TEST(PoseRemarks, CallObjectsObjects) {
    CharacterPose pose = standingFrom({2});
    pose.segments.resize(3);
    pose.sources.resize(3);
    pose.isObjects = true;
    EXPECT_EQ(remarkOn(pose, scaled()).lines,
              (Lines{{Kind::TrackedObjects, {{"objects", words::counted(Kind::Objects, 3)}}}}));
}

} // namespace
} // namespace posewire::model
