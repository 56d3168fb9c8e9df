// SPDX-License-Identifier: MIT
#include "core/model/body/points.h"

#include "core/model/body/reference_body.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace posewire::model {
namespace {

using namespace segment;

Eigen::Vector3d positionOf(const AnatomicalPoint& point) {
    return Eigen::Vector3d(point.reference.data());
}

TEST(Points, CountsLocalIdsFromOneWithoutGaps) {
    std::vector<int> last(kBodySegmentCount, 0);
    for (const AnatomicalPoint& point : anatomicalPoints()) {
        EXPECT_EQ(point.localId, ++last[static_cast<std::size_t>(point.segment)]) << point.name;
        EXPECT_LE(point.localId, kMaxLocalPointId);
    }
    EXPECT_EQ(last[kPelvis], 14);
    EXPECT_EQ(last[kRightHand], 5);
    EXPECT_EQ(last[kLeftFoot], 8);
}

TEST(Points, PutsTheSacrumWhereTheSpecificationDoes) {
    const AnatomicalPoint* sacrum = findPoint("pSacrum");
    ASSERT_NE(sacrum, nullptr);
    EXPECT_EQ(encodePointId(PointIdCoding::By256, {sacrum->segment + 1, sacrum->localId}), 269U);
    EXPECT_EQ(encodePointId(PointIdCoding::By100, {sacrum->segment + 1, sacrum->localId}), 113U);
}

TEST(Points, MirrorsTheLeftSide) {
    for (const AnatomicalPoint& point : anatomicalPoints()) {
        if (bodySegments()[static_cast<std::size_t>(point.segment)].side != Side::Right) {
            continue;
        }
        const AnatomicalPoint* left = findPoint(mirrored(point.segment), point.localId);
        ASSERT_NE(left, nullptr);
        EXPECT_EQ(positionOf(*left), positionOf(point).cwiseProduct(Eigen::Vector3d(1.0, -1.0, 1.0)));
    }
}

TEST(Points, BeginsEverySegmentAtItsOrigin) {
    for (int index = 0; index < kBodySegmentCount; ++index) {
        EXPECT_EQ(positionOf(*findPoint(index, 1)), Eigen::Vector3d(0.0, 0.0, 0.0));
    }
}

TEST(Points, LetsTheSecondPointBeTheOriginOfTheNextSegment) {
    for (const int child : {kL5, kL3, kT12, kT8, kNeck, kHead, kRightUpperArm, kRightForeArm, kLeftHand,
                            kRightLowerLeg, kRightFoot, kRightToe, kLeftToe}) {
        const int parent = bodySegments()[static_cast<std::size_t>(child)].parent;
        const Eigen::Vector3d way = referenceOrigins()[static_cast<std::size_t>(child)] -
                                    referenceOrigins()[static_cast<std::size_t>(parent)];
        EXPECT_LT((positionOf(*findPoint(parent, 2)) - way).norm(), 0.0005) << child;
    }
}

TEST(Points, HoldsSixtyFourDifferentMarkers) {
    std::set<std::string_view> names;
    for (const int marker : markerPoints()) {
        const AnatomicalPoint& point = anatomicalPoints()[static_cast<std::size_t>(marker)];
        EXPECT_EQ(point.name.front(), 'p') << point.name;
        names.insert(point.name);
    }
    EXPECT_EQ(names.size(), 64U);
}

std::vector<std::uint32_t> markerIds(PointIdCoding coding) {
    std::vector<std::uint32_t> ids;
    for (const int marker : markerPoints()) {
        const AnatomicalPoint& point = anatomicalPoints()[static_cast<std::size_t>(marker)];
        ids.push_back(encodePointId(coding, {point.segment + 1, point.localId}));
    }
    return ids;
}

TEST(Points, TellsTheCodingOfAWholeDatagram) {
    EXPECT_EQ(detectPointIdCoding(markerIds(PointIdCoding::By256)), PointIdCoding::By256);
    EXPECT_EQ(detectPointIdCoding(markerIds(PointIdCoding::By100)), PointIdCoding::By100);
    EXPECT_EQ(detectPointIdCoding({}), PointIdCoding::Unknown);
    const std::vector<std::uint32_t> tags{70001, 70002};
    EXPECT_EQ(detectPointIdCoding(tags), PointIdCoding::Unknown);
}

TEST(Points, FindsTheCodingByThePointsInFrontOfTags) {
    const std::vector<std::uint32_t> withTags{269, 513, 1025, 5001, 5002};
    EXPECT_EQ(detectPointIdCoding(withTags), PointIdCoding::By256);
    const std::vector<std::uint32_t> older{113, 201, 401, 70001};
    EXPECT_EQ(detectPointIdCoding(older), PointIdCoding::By100);
    EXPECT_EQ(knownPoint(PointIdCoding::By256, 269), (PointReference{1, 13}));
    EXPECT_EQ(knownPoint(PointIdCoding::By256, 5001), std::nullopt);
}

TEST(Points, PrefersTheCodingOfLaterRevisionsForAnAmbiguousId) {
    const std::vector<std::uint32_t> one{513};
    EXPECT_EQ(detectPointIdCoding(one), PointIdCoding::By256);
    EXPECT_EQ(decodePointId(PointIdCoding::By256, 513), (PointReference{2, 1}));
    EXPECT_EQ(decodePointId(PointIdCoding::By100, 513), (PointReference{5, 13}));
    EXPECT_EQ(decodePointId(PointIdCoding::Unknown, 513), std::nullopt);
}

TEST(ReferenceBody, StandsOnTheFloorWithTheBallOfTheFootAtZeroInTheNullPose) {
    for (const double stature : {1.5, 1.75, 2.0}) {
        const ReferenceBody body = makeReferenceBody({stature, 1.04, 0.97, 1.08, 0.92});
        EXPECT_NEAR(body.nullPoseOrigin(kRightToe).z(), 0.0, 1e-12);
        EXPECT_NEAR(body.origins[kLeftToe].z(), 0.015 * stature / 1.75, 1e-12);
    }
}

TEST(ReferenceBody, KeepsTheReferenceUnchangedAtItsOwnStature) {
    const ReferenceBody body = makeReferenceBody();
    EXPECT_NEAR(body.nullPoseOrigin(kPelvis).z(), 0.9125, 1e-12);
    EXPECT_NEAR(body.nullPoseOrigin(kHead).z(), 1.5608, 1e-12);
    EXPECT_NEAR(body.legLength(), 0.8475, 1e-12);
    for (std::size_t index = 0; index < kBodySegmentCount; ++index) {
        EXPECT_TRUE(body.origins[index].isApprox(referenceOrigins()[index]) || index == kPelvis);
    }
}

TEST(ReferenceBody, StretchesLimbsAndTheirPointsAlike) {
    const ReferenceBody body = makeReferenceBody({1.75, 1.10, 0.90, 1.0, 1.0});
    EXPECT_NEAR(body.offset(kRightForeArm).norm(), 0.285 * 0.90, 1e-12);
    EXPECT_NEAR(body.offset(kLeftLowerLeg).norm(), 0.4285 * 1.10, 1e-12);
    const auto points = anatomicalPoints();
    const auto pointOf = [&](int segment, std::string_view name) {
        const auto point = std::ranges::find_if(
            points, [&](const auto& each) { return each.segment == segment && each.name == name; });
        return body.points.at(static_cast<std::size_t>(point - points.begin()));
    };
    EXPECT_TRUE(pointOf(kRightUpperArm, "jRightElbow").isApprox(body.offset(kRightForeArm)));
    EXPECT_TRUE(pointOf(kLeftUpperLeg, "jLeftKnee").isApprox(body.offset(kLeftLowerLeg)));
}

} // namespace
} // namespace posewire::model
