// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose_findings.h"

#include "core/model/body/null_pose_measures.h"
#include "core/model/body/points.h"
#include "core/model/body/reference_body.h"
#include "core/model/body/spaces.h"
#include "tests/support/facts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;
using words::namesIn;
using words::numberIn;
using words::partOf;
using K = words::Kind;
using Names = std::vector<std::string>;

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
    const NullPoseFinding* only(K kind) {
        const NullPoseFinding* found = among(kind);
        EXPECT_EQ(findings.size(), found == nullptr ? 0U : 1U)
            << (findings.empty() ? words::Fact() : findings[0].fact);
        return found;
    }
    const NullPoseFinding* among(K kind) {
        findings = find();
        const auto found = std::ranges::find(
            findings, kind, [](const NullPoseFinding& finding) { return finding.fact.kind; });
        return found == findings.end() ? nullptr : &*found;
    }

    NullPose pose = poseOf(makeReferenceBody({.stature = 1.68, .legs = 1.03}));
    NullPoseEvidence evidence;
    std::vector<NullPoseFinding> findings;
};

TEST_F(NullPoseFindings, APlausibleBodyHasNone) {
    evidence.layout = SegmentLayout{};
    EXPECT_TRUE(find().empty());
}

TEST_F(NullPoseFindings, NamesInAnotherOrder) {
    std::swap(pose.segments[9], pose.segments[10]);
    const auto* finding = only(K::NamesMoved);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(namesIn(finding->fact, "names").front(), "Right Hand at 10 (should be 11)");
}

TEST_F(NullPoseFindings, ANameTwice) {
    pose.segments[10].name = "RightForeArm";
    const auto* finding = among(K::NameTwice);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(finding->severity(), Severity::Error);
    EXPECT_EQ(numberIn(finding->fact, "from"), 10);
    EXPECT_EQ(numberIn(finding->fact, "to"), 11);
}

TEST_F(NullPoseFindings, AnUnknownNameAndOneSpelledOtherwise) {
    pose.segments[3].name = "Chest";
    const auto* finding = only(K::NamesUnknown);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(finding->severity(), Severity::Warning);
    EXPECT_EQ(namesIn(finding->fact, "names"), Names{"4 \"Chest\""});
    pose.segments[3].name = "t12 ";
    EXPECT_EQ(only(K::NamesRespelled)->severity(), Severity::Note);
}

TEST_F(NullPoseFindings, AMissingPartOnceItIsOverdue) {
    NullPoseMessage message{1, {}, {}, 4, 6, {2, 4}};
    evidence.record.newest = &message;
    evidence.now = log::Stamp(500ms);
    EXPECT_TRUE(find().empty());
    evidence.now = log::Stamp(2s);
    const auto* finding = only(K::PartsMissingNow);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(namesIn(finding->fact, "parts"), (Names{"3", "5"}));
    EXPECT_EQ(numberIn(finding->fact, "all"), 6);
    EXPECT_EQ(finding->severity(), Severity::Warning); // an earlier message was whole
    pose.partsExpected = 6;
    EXPECT_EQ(only(K::PartsMissing)->severity(), Severity::Error);
    message = {1, {}, {}, 1, 0, {}};
    EXPECT_EQ(say(only(K::PartsMissing)->fact, words::Form::Sentence),
              "The last part of the newest scale message never came; 1 part did.");
    message = {1, {}, {}, 2, 0, {1}};
    EXPECT_EQ(namesIn(only(K::PartsMissing)->fact, "parts"), (Names{"2", "the last"}));
    EXPECT_EQ(numberIn(findings[0].fact, "all"), std::nullopt);
}

TEST_F(NullPoseFindings, EarlierLossesMatterWhereTheBodyIsNotWhole) {
    evidence.record.incompleteMessages = 3;
    EXPECT_EQ(only(K::EarlierPartsMissed)->severity(), Severity::Note);
    pose.partsExpected = 2;
    EXPECT_EQ(only(K::EarlierPartsMissing)->severity(), Severity::Warning);
    EXPECT_EQ(numberIn(findings[0].fact, "n"), 3);
}

TEST_F(NullPoseFindings, ASegmentBelowTheFloor) {
    pose.segments[segment::kLeftToe].position.z() = -0.08;
    const auto* finding = among(K::BelowFloor);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(finding->segment, segment::kLeftToe);
    EXPECT_EQ(namesIn(finding->fact, "names"), Names{"Left Toe −80.0 mm"});
}

TEST_F(NullPoseFindings, AnUpperBodyConfigurationHangsFromItsPelvisAndThatIsFine) {
    const Eigen::Vector3d pelvis = pose.segments[0].position;
    for (NullPose::Segment& segment : pose.segments) {
        segment.position -= pelvis;
    }
    EXPECT_EQ(only(K::PelvisAtOrigin)->severity(), Severity::Note);
}

TEST_F(NullPoseFindings, LeftAndRightExchanged) {
    for (NullPose::Segment& segment : pose.segments) {
        segment.position.y() = -segment.position.y();
    }
    for (NullPose::Point& point : pose.points) {
        point.position.y() = -point.position.y();
    }
    EXPECT_NE(only(K::Mirrored), nullptr);
}

TEST_F(NullPoseFindings, LengthsThatChangedInMidStream) {
    const NullPose before = poseOf(makeReferenceBody({.stature = 1.68}));
    evidence.record.before = &before;
    const auto* finding = only(K::LengthsChanged);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(numberIn(finding->fact, "n"), 4);
    EXPECT_EQ(namesIn(finding->fact, "names").front(), "right Thigh +12.3 mm");
}

TEST_F(NullPoseFindings, PointsOnASegmentThatDoesNotExist) {
    pose.points.push_back({40, 1, "pGhost", 0, {0, 0, 0}});
    const auto* finding = only(K::PointsWithoutSegment);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(namesIn(finding->fact, "names"), Names{"40.1 pGhost"});
}

TEST_F(NullPoseFindings, PointIdsGivenTwiceAndOtherNames) {
    pose.points.push_back(pose.points.front());
    EXPECT_NE(only(K::PointIdsTwice), nullptr);
    pose.points.pop_back();
    pose.points[12].name = "pTail";
    EXPECT_NE(only(K::PointNames), nullptr);
}

TEST_F(NullPoseFindings, JointsThatPointsPutElsewhere) {
    const auto knee = std::ranges::find_if(pose.points, [](const NullPose::Point& point) {
        return point.segment == segment::kRightUpperLeg + 1 && point.name == "jRightKnee";
    });
    ASSERT_NE(knee, pose.points.end());
    knee->position.z() += 0.05;
    const auto* finding = only(K::JointsApart);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(namesIn(finding->fact, "names"), Names{"jRightKnee by 50 mm"});
}

TEST_F(NullPoseFindings, CentimetresAndMillimetres) {
    const NullPose metres = pose;
    for (const auto& [factor, unit] : {std::pair{100.0, K::Centimetres}, std::pair{1000.0, K::Millimetres}}) {
        pose = metres;
        for (NullPose::Segment& segment : pose.segments) {
            segment.position *= factor;
        }
        for (NullPose::Point& point : pose.points) {
            point.position *= factor;
        }
        const auto* finding = only(K::OtherUnit);
        ASSERT_NE(finding, nullptr);
        EXPECT_EQ(partOf(finding->fact, "looks").kind, unit);
        EXPECT_NEAR(numberIn(finding->fact, "metres").value_or(0), 1.7, 0.1);
    }
}

TEST_F(NullPoseFindings, ABodyThatLiesAlongY) {
    for (NullPose::Segment& segment : pose.segments) {
        segment.position = yUpFromZUp(segment.position);
    }
    pose.points.clear();
    EXPECT_NE(only(K::StandsAskew), nullptr);
}

TEST_F(NullPoseFindings, PositionsThatAreNoNumbers) {
    pose.segments[22].position.x() = std::numeric_limits<double>::quiet_NaN();
    const auto* finding = among(K::NotNumbers);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(namesIn(finding->fact, "names"), Names{"23 Left Toe"});
}

TEST_F(NullPoseFindings, AnotherNumberOfSegmentsThanInThePoses) {
    evidence.layout = SegmentLayout{23, 2, 40};
    EXPECT_TRUE(find().empty()); // the body alone
    pose.segments.push_back({"Sword", {0, 0, 1}});
    EXPECT_EQ(only(K::MoreSegments)->severity(), Severity::Warning);
    pose.segments.push_back({"Shield", {0, 0, 1}});
    EXPECT_TRUE(find().empty());
}

TEST_F(NullPoseFindings, NoScaleMessageAlthoughPosesFlow) {
    evidence.poseSeconds = 9;
    EXPECT_TRUE(findContradictions(evidence).empty());
    evidence.poseSeconds = 12;
    ASSERT_EQ(findContradictions(evidence).size(), 1U);
    EXPECT_EQ(findContradictions(evidence)[0].severity(), Severity::Warning);
    const wire::ScaleInformation scale;
    evidence.scale = &scale;
    EXPECT_EQ(findContradictions(evidence)[0].severity(), Severity::Note);
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
    const auto* finding = only(K::ScalesDisagree);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(namesIn(finding->fact, "segments"), Names{"Right Hand"});
}

TEST_F(NullPoseFindings, GravestFirst) {
    pose.points.push_back({40, 1, "pGhost", 0, {0, 0, 0}});
    pose.segments[3].name = "Chest";
    findings = find();
    ASSERT_EQ(findings.size(), 2U);
    EXPECT_EQ(findings[0].severity(), Severity::Error);
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
