// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose_findings.h"

#include "core/model/body/null_pose_measures.h"
#include "core/model/body/points.h"
#include "core/model/body/reference_body.h"
#include "core/model/body/spaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

NullPose poseOf(const ReferenceBody& body) {
    NullPose pose;
    for (int index = 0; index < kBodySegmentCount; ++index) {
        pose.segments.push_back(
            {std::string(bodySegments()[static_cast<std::size_t>(index)].name), body.nullPoseOrigin(index)});
    }
    const auto points = anatomicalPoints();
    for (std::size_t i = 0; i < points.size(); ++i) {
        pose.points.push_back(
            {points[i].segment + 1, points[i].localId, std::string(points[i].name), 0, body.points[i]});
    }
    pose.partsReceived = pose.partsExpected = 1;
    return pose;
}

class NullPoseFindings : public testing::Test {
protected:
    std::vector<NullPoseFinding> find() {
        evidence.record.pose = &pose;
        return findContradictions(evidence);
    }
    const NullPoseFinding* only(NullPoseFault fault) {
        findings = find();
        const auto found = std::ranges::find(findings, fault, &NullPoseFinding::fault);
        EXPECT_EQ(findings.size(), found == findings.end() ? 0U : 1U)
            << (findings.empty() ? "" : findings[0].what);
        return found == findings.end() ? nullptr : &*found;
    }
    const NullPoseFinding* among(NullPoseFault fault) {
        findings = find();
        const auto found = std::ranges::find(findings, fault, &NullPoseFinding::fault);
        return found == findings.end() ? nullptr : &*found;
    }

    NullPose pose = poseOf(makeReferenceBody({.stature = 1.68, .legs = 1.03}));
    NullPoseEvidence evidence;
    std::vector<NullPoseFinding> findings;
};

TEST_F(NullPoseFindings, APlausibleBodyHasNone) {
    evidence.layout = SegmentLayout{};
    EXPECT_TRUE(find().empty());
    EXPECT_EQ(findingsSummary({}), "");
}

TEST_F(NullPoseFindings, NamesInAnotherOrder) {
    std::swap(pose.segments[9], pose.segments[10]);
    const auto* finding = only(NullPoseFault::NameOrder);
    ASSERT_NE(finding, nullptr);
    EXPECT_NE(finding->what.find("Right Hand at 10 (should be 11)"), std::string::npos) << finding->what;
    EXPECT_EQ(findingsSummary(findings), "1 warning");
}

TEST_F(NullPoseFindings, ANameTwice) {
    pose.segments[10].name = "RightForeArm";
    const auto* finding = among(NullPoseFault::NameTwice);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(finding->severity, Severity::Error);
    EXPECT_NE(finding->what.find("10 and 11"), std::string::npos);
}

TEST_F(NullPoseFindings, AnUnknownNameAndOneSpelledOtherwise) {
    pose.segments[3].name = "Chest";
    const auto* finding = only(NullPoseFault::UnknownName);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(finding->severity, Severity::Warning);
    EXPECT_NE(finding->what.find("4 \"Chest\""), std::string::npos);
    pose.segments[3].name = "t12 ";
    EXPECT_EQ(only(NullPoseFault::UnknownName)->severity, Severity::Note);
}

TEST_F(NullPoseFindings, AMissingPartOnceItIsOverdue) {
    NullPoseMessage message{1, {}, {}, 4, 6, {2, 4}};
    evidence.record.newest = &message;
    evidence.now = log::Stamp(500ms);
    EXPECT_TRUE(find().empty());
    evidence.now = log::Stamp(2s);
    const auto* finding = only(NullPoseFault::MissingPart);
    ASSERT_NE(finding, nullptr);
    EXPECT_NE(finding->what.find("Parts 3 and 5 of 6"), std::string::npos) << finding->what;
    EXPECT_EQ(finding->severity, Severity::Warning); // an earlier message was whole
    pose.partsExpected = 6;
    EXPECT_EQ(only(NullPoseFault::MissingPart)->severity, Severity::Error);
    message = {1, {}, {}, 1, 0, {}};
    EXPECT_EQ(only(NullPoseFault::MissingPart)->what,
              "The last part of the newest scale message never came; 1 part did.");
    message = {1, {}, {}, 2, 0, {1}};
    EXPECT_EQ(only(NullPoseFault::MissingPart)->what,
              "Parts 2 and the last of the newest scale message never came; 2 parts did.");
}

TEST_F(NullPoseFindings, EarlierLossesMatterWhereTheBodyIsNotWhole) {
    evidence.record.incompleteMessages = 3;
    EXPECT_EQ(only(NullPoseFault::EarlierPartMissing)->severity, Severity::Note);
    pose.partsExpected = 2;
    EXPECT_EQ(only(NullPoseFault::EarlierPartMissing)->severity, Severity::Warning);
    EXPECT_NE(findings[0].what.find("3 earlier scale messages"), std::string::npos);
}

TEST_F(NullPoseFindings, ASegmentBelowTheFloor) {
    pose.segments[segment::kLeftToe].position.z() = -0.08;
    const auto* finding = among(NullPoseFault::BelowFloor);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(finding->segment, segment::kLeftToe);
    EXPECT_NE(finding->what.find("Left Toe −80.0 mm"), std::string::npos) << finding->what;
}

TEST_F(NullPoseFindings, AnUpperBodyConfigurationHangsFromItsPelvisAndThatIsFine) {
    const Eigen::Vector3d pelvis = pose.segments[0].position;
    for (NullPose::Segment& segment : pose.segments) {
        segment.position -= pelvis;
    }
    EXPECT_EQ(only(NullPoseFault::BelowFloor)->severity, Severity::Note);
}

TEST_F(NullPoseFindings, LeftAndRightExchanged) {
    for (NullPose::Segment& segment : pose.segments) {
        segment.position.y() = -segment.position.y();
    }
    for (NullPose::Point& point : pose.points) {
        point.position.y() = -point.position.y();
    }
    const auto* finding = only(NullPoseFault::Mirrored);
    ASSERT_NE(finding, nullptr);
    EXPECT_NE(finding->what.find("right arm and leg lie towards +y"), std::string::npos);
}

TEST_F(NullPoseFindings, LengthsThatChangedInMidStream) {
    const NullPose before = poseOf(makeReferenceBody({.stature = 1.68}));
    evidence.record.before = &before;
    const auto* finding = only(NullPoseFault::LengthChanged);
    ASSERT_NE(finding, nullptr);
    EXPECT_NE(finding->what.find("4 lengths changed"), std::string::npos) << finding->what;
    EXPECT_NE(finding->what.find("right Thigh +12.3 mm"), std::string::npos) << finding->what;
}

TEST_F(NullPoseFindings, PointsOnASegmentThatDoesNotExist) {
    pose.points.push_back({40, 1, "pGhost", 0, {0, 0, 0}});
    const auto* finding = only(NullPoseFault::PointWithoutSegment);
    ASSERT_NE(finding, nullptr);
    EXPECT_NE(finding->what.find("40.1 pGhost"), std::string::npos);
}

TEST_F(NullPoseFindings, PointIdsGivenTwiceAndOtherNames) {
    pose.points.push_back(pose.points.front());
    EXPECT_NE(only(NullPoseFault::PointTwice), nullptr);
    pose.points.pop_back();
    pose.points[12].name = "pTail";
    EXPECT_NE(only(NullPoseFault::PointName), nullptr);
}

TEST_F(NullPoseFindings, JointsThatPointsPutElsewhere) {
    const auto knee = std::ranges::find_if(pose.points, [](const NullPose::Point& point) {
        return point.segment == segment::kRightUpperLeg + 1 && point.name == "jRightKnee";
    });
    ASSERT_NE(knee, pose.points.end());
    knee->position.z() += 0.05;
    const auto* finding = only(NullPoseFault::PointAgainstSegment);
    ASSERT_NE(finding, nullptr);
    EXPECT_NE(finding->what.find("jRightKnee by 50 mm"), std::string::npos) << finding->what;
}

TEST_F(NullPoseFindings, CentimetresAndMillimetres) {
    const NullPose metres = pose;
    for (const auto& [factor, unit] :
         {std::pair{100.0, "centimetres (1.7"}, std::pair{1000.0, "millimetres (1.7"}}) {
        pose = metres;
        for (NullPose::Segment& segment : pose.segments) {
            segment.position *= factor;
        }
        for (NullPose::Point& point : pose.points) {
            point.position *= factor;
        }
        const auto* finding = only(NullPoseFault::Unit);
        ASSERT_NE(finding, nullptr);
        EXPECT_NE(finding->what.find(unit), std::string::npos) << finding->what;
    }
}

TEST_F(NullPoseFindings, ABodyThatLiesAlongY) {
    for (NullPose::Segment& segment : pose.segments) {
        segment.position = yUpFromZUp(segment.position);
    }
    pose.points.clear();
    EXPECT_NE(only(NullPoseFault::AxisUp), nullptr);
}

TEST_F(NullPoseFindings, PositionsThatAreNoNumbers) {
    pose.segments[22].position.x() = std::numeric_limits<double>::quiet_NaN();
    const auto* finding = among(NullPoseFault::NotFinite);
    ASSERT_NE(finding, nullptr);
    EXPECT_NE(finding->what.find("23 Left Toe"), std::string::npos);
}

TEST_F(NullPoseFindings, AnotherNumberOfSegmentsThanInThePoses) {
    evidence.layout = SegmentLayout{23, 2, 40};
    EXPECT_TRUE(find().empty()); // the body alone
    pose.segments.push_back({"Sword", {0, 0, 1}});
    EXPECT_EQ(only(NullPoseFault::SegmentCount)->severity, Severity::Warning);
    pose.segments.push_back({"Shield", {0, 0, 1}});
    EXPECT_TRUE(find().empty());
}

TEST_F(NullPoseFindings, NoScaleMessageAlthoughPosesFlow) {
    evidence.poseSeconds = 9;
    EXPECT_TRUE(findContradictions(evidence).empty());
    evidence.poseSeconds = 12;
    ASSERT_EQ(findContradictions(evidence).size(), 1U);
    EXPECT_EQ(findContradictions(evidence)[0].severity, Severity::Warning);
    const wire::ScaleInformation scale;
    evidence.scale = &scale;
    EXPECT_EQ(findContradictions(evidence)[0].severity, Severity::Note);
}

TEST_F(NullPoseFindings, Type10OfAnotherPerformer) {
    wire::ScaleInformation scale;
    for (std::size_t i = 0; i < kBodySegmentCount; ++i) {
        scale.segments.push_back({static_cast<std::uint32_t>(i + 1),
                                  toFloats(pose.segments[i].position - referenceOrigins()[i]),
                                  {1, 0, 0, 0, 1, 0, 0, 0, 1}});
    }
    evidence.scale = &scale;
    EXPECT_TRUE(find().empty());
    scale.segments[10].offset = {0.4F, 0, 0};
    const auto* finding = only(NullPoseFault::ScaleAgainstNullPose);
    ASSERT_NE(finding, nullptr);
    EXPECT_NE(finding->what.find("Right Hand"), std::string::npos) << finding->what;
}

TEST_F(NullPoseFindings, GravestFirst) {
    pose.points.push_back({40, 1, "pGhost", 0, {0, 0, 0}});
    pose.segments[3].name = "Chest";
    findings = find();
    ASSERT_EQ(findings.size(), 2U);
    EXPECT_EQ(findings[0].severity, Severity::Error);
    EXPECT_EQ(findingsSummary(findings), "1 error, 1 warning");
}

TEST_F(NullPoseFindings, RandomBodiesAreJudgedWithoutHarm) {
    std::uint32_t random = 1;
    const auto next = [&random] { return random = random * 1664525U + 1013904223U; };
    for (int round = 0; round < 2'000; ++round) {
        NullPose odd = pose;
        for (int i = 0; i < 6; ++i) {
            const std::size_t place = next() % odd.segments.size();
            odd.segments[place].position[next() % 3] *=
                std::ldexp(1.0, static_cast<int>(next() % 4096) - 2048);
            odd.segments[next() % odd.segments.size()].name = odd.segments[place].name;
            odd.points[next() % odd.points.size()].segment = static_cast<int>(next() % 65536);
        }
        odd.segments.resize(next() % 30);
        evidence.record.pose = &odd;
        EXPECT_LT(findContradictions(evidence).size(), 60U);
    }
}

} // namespace
} // namespace posewire::model
