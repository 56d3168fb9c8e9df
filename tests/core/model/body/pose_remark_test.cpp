// SPDX-License-Identifier: MIT
#include "core/model/body/pose_remark.h"

#include "core/model/body/pose_solver.h"

#include <gtest/gtest.h>

namespace posewire::model {
namespace {

using Lines = std::vector<std::string>;

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
        EXPECT_EQ(remark.reason, "");
    }
}

TEST(PoseRemarks, NameWhatIsMissing) {
    CharacterPose pose = standingFrom({2});
    pose.sources[segment::kLeftForeArm] = {Provenance::Solved, Provenance::Solved};
    EXPECT_EQ(remarkOn(pose, scaled()).lines, (Lines{"Not sent, solved from the others: Left Forearm"}));
    EXPECT_FALSE(remarkOn(pose, scaled()).isAssumed);
    EXPECT_EQ(remarkOn(pose, scaled()).brief, "partly solved");
    pose.sources[segment::kLeftHand] = {Provenance::Assumed, Provenance::Assumed};
    const PoseRemark remark = remarkOn(pose, scaled());
    EXPECT_TRUE(remark.isAssumed);
    EXPECT_EQ(remark.reason, "Not sent, assumed: Left Hand");
    EXPECT_EQ(remark.brief, "partly assumed");
    EXPECT_EQ(remark.lines.size(), 2U);
}

TEST(PoseRemarks, NameAFewSegmentsAndCountTheRest) {
    CharacterPose pose = standingFrom({2});
    for (std::size_t i = 0; i < 8; ++i) {
        pose.sources[i].orientation = Provenance::Solved;
    }
    EXPECT_EQ(remarkOn(pose, scaled()).lines.front(),
              "Not sent, solved from the others: Pelvis, L5, L3 and 5 more");
}

TEST(PoseRemarks, TellWhatATypeAloneLacks) {
    CharacterPose positions = standingFrom({21});
    positions.sources[segment::kHead].orientation = Provenance::Assumed;
    EXPECT_EQ(remarkOn(positions, scaled()).reason,
              "Type 21 alone has no orientations: they are solved from the joints");
    CharacterPose orientations = standingFrom({22});
    orientations.isPlaceAssumed = true;
    orientations.sources[segment::kPelvis].position = Provenance::Assumed;
    const PoseRemark remark = remarkOn(orientations, scaled());
    EXPECT_TRUE(remark.isAssumed);
    EXPECT_EQ(remark.lines, (Lines{"Type 22 alone has no positions: where the body stands is assumed"}));
    EXPECT_FALSE(remarkOn(standingFrom({3}), scaled()).isAssumed);
}

TEST(PoseRemarks, TellWhoseBodyIsDrawn) {
    BodyOrigins body{referenceOrigins()};
    EXPECT_EQ(remarkOn(standingFrom({2}), body).lines,
              (Lines{"No scale message yet: the reference body of 1.75 m is drawn"}));
    EXPECT_FALSE(remarkOn(standingFrom({2}), body).isAssumed) << "its joints were sent";
    EXPECT_TRUE(remarkOn(standingFrom({5}), body).isAssumed) << "its joints rest on the bones";
    EXPECT_TRUE(remarkOn(standingFrom({3}), body).isAssumed) << "whose markers these are is not known";
    EXPECT_EQ(remarkOn(standingFrom({3}), body).reason,
              "No scale message yet: the reference body of 1.75 m is drawn");
    EXPECT_FALSE(remarkOn(standingFrom({21, 3}), body).isAssumed) << "its joints were sent";
    body.source = BodySource::Poses;
    EXPECT_EQ(remarkOn(standingFrom({5}), body).lines,
              (Lines{"No scale message yet: bone lengths are measured on poses"}));
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
        EXPECT_EQ(remark.lines.back(), "The scale message is of another body: its arms and legs are longer "
                                       "than in the poses, in whose size it is drawn");
        EXPECT_NEAR(scaleInPose(standingFrom(types), body), 1 / (1.05 * 1.6), 0.011);
        EXPECT_EQ(remark.brief, "wrong scale");
    }
    CharacterPose solved = standingFrom({22});
    for (SegmentSource& source : solved.sources) {
        source.position = Provenance::Solved;
    }
    EXPECT_EQ(remarkOn(solved, body).brief, "partly solved") << "its joints stand on these bones";
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
    EXPECT_EQ(remarkOn(pose, scaled()).lines, (Lines{"It was sent below the floor"}));
    pose.isLifted = true;
    EXPECT_EQ(remarkOn(pose, scaled()).lines, (Lines{"Placed on the floor, since it was sent below it"}));
}

TEST(PoseRemarks, CallObjectsObjects) {
    CharacterPose pose = standingFrom({2});
    pose.segments.resize(3);
    pose.sources.resize(3);
    pose.isObjects = true;
    EXPECT_EQ(remarkOn(pose, scaled()).lines, (Lines{"Tracked objects, no body: 3 objects"}));
}

} // namespace
} // namespace posewire::model
