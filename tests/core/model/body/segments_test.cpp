// SPDX-License-Identifier: MIT
#include "core/model/body/segments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace posewire::model {
namespace {

using namespace segment;

TEST(Segments, NumbersTheBodyFromOneWithParentsBeforeTheirChildren) {
    for (int index = 0; index < kBodySegmentCount; ++index) {
        const Segment& row = bodySegments()[static_cast<std::size_t>(index)];
        EXPECT_EQ(row.id, index + 1);
        EXPECT_LT(row.parent, index);
        EXPECT_EQ(row.parent < 0, index == kPelvis);
    }
}

TEST(Segments, NamesBodySegmentsAsType13Does) {
    EXPECT_EQ(bodySegments()[kRightUpperArm].name, "RightUpperArm");
    EXPECT_EQ(bodySegments()[kRightUpperArm].displayName, "Right Upper Arm");
    EXPECT_EQ(bodySegments()[kLeftForeArm].displayName, "Left Forearm");
    EXPECT_EQ(bodySegments()[kT12].displayName, "T12");
    EXPECT_EQ(findBodySegment("LeftToe"), kLeftToe);
    EXPECT_EQ(findBodySegment("Sword"), std::nullopt);
}

TEST(Segments, AreCalledAsTheSpecificationPrintsThem) {
    constexpr SegmentLayout kGloves{23, 1, 40};
    EXPECT_EQ(segmentTitle(kGloves, kLeftForeArm), "Left Forearm");
    EXPECT_EQ(segmentTitle(kGloves, 23), "Prop1");
    EXPECT_EQ(segmentTitle(kGloves, 24), "Left Carpus");
    EXPECT_EQ(segmentTitle(kGloves, 25), "Left First MC");
    EXPECT_EQ(segmentTitle(kGloves, 63), "Right Fifth DP");
    EXPECT_EQ(segmentTitle(kGloves, 64), "");
    EXPECT_EQ(segmentTitle("RightUpperArm"), "Right Upper Arm");
    EXPECT_EQ(segmentTitle("RightFifthDP"), "Right Fifth DP");
    EXPECT_EQ(segmentTitle("Sword"), "");
}

TEST(Segments, HangsLimbsOnTheTrunkAsTheSpecificationDoes) {
    EXPECT_EQ(bodySegments()[kRightShoulder].parent, kT8);
    EXPECT_EQ(bodySegments()[kLeftShoulder].parent, kT8);
    EXPECT_EQ(bodySegments()[kRightUpperLeg].parent, kPelvis);
    EXPECT_EQ(bodySegments()[kLeftUpperLeg].parent, kPelvis);
    EXPECT_EQ(bodySegments()[kNeck].parent, kT8);
}

TEST(Segments, ListsTheUnityOrderOfTable2) {
    using testing::ElementsAre;
    EXPECT_THAT(unityOrder(),
                ElementsAre(kPelvis, kRightUpperLeg, kRightLowerLeg, kRightFoot, kRightToe, kLeftUpperLeg,
                            kLeftLowerLeg, kLeftFoot, kLeftToe, kL5, kL3, kT12, kT8, kLeftShoulder,
                            kLeftUpperArm, kLeftForeArm, kLeftHand, kRightShoulder, kRightUpperArm,
                            kRightForeArm, kRightHand, kNeck, kHead));
    for (int place = 0; place < kBodySegmentCount; ++place) {
        const int body = unityOrder()[static_cast<std::size_t>(place)];
        EXPECT_EQ(unityPlaces()[static_cast<std::size_t>(body)], place);
    }
}

TEST(Segments, UnityOrderHasParentsBeforeTheirChildren) {
    for (int index = 1; index < kBodySegmentCount; ++index) {
        const auto place = static_cast<std::size_t>(index);
        const auto parent = static_cast<std::size_t>(bodySegments()[place].parent);
        EXPECT_LT(unityPlaces()[parent], unityPlaces()[place]);
    }
}

TEST(Segments, FindsPropsAndFingersByPosition) {
    const SegmentLayout layout{kBodySegmentCount, 2, kFingerSegmentCount};
    EXPECT_EQ(layout.count(), 65);
    EXPECT_EQ(segmentName(layout, 22), "LeftToe");
    EXPECT_EQ(segmentName(layout, 23), "Prop1");
    EXPECT_EQ(segmentName(layout, 24), "Prop2");
    EXPECT_EQ(segmentName(layout, 25), "LeftCarpus");
    EXPECT_EQ(segmentName(layout, 44), "LeftFifthDP");
    EXPECT_EQ(segmentName(layout, 45), "RightCarpus");
    EXPECT_EQ(segmentName(layout, 64), "RightFifthDP");
    EXPECT_EQ(segmentName(layout, 65), "");
    EXPECT_EQ(segmentName(layout, -1), "");
}

TEST(Segments, ShiftsFingersByThePropCount) {
    for (int props = 0; props <= kMaxPropCount; ++props) {
        const SegmentLayout layout{kBodySegmentCount, props, kFingerSegmentCount};
        EXPECT_EQ(segmentName(layout, kBodySegmentCount + props), "LeftCarpus");
        EXPECT_EQ(segmentParent(layout, kBodySegmentCount + props), kLeftHand);
        EXPECT_EQ(segmentParent(layout, kBodySegmentCount + props + kHandSegmentCount), kRightHand);
        const int firstMetacarpal = kBodySegmentCount + props + kHandSegmentCount + 1;
        EXPECT_EQ(segmentParent(layout, firstMetacarpal), firstMetacarpal - 1);
    }
}

TEST(Segments, FreesPropsFromAnyParent) {
    const SegmentLayout layout{kBodySegmentCount, 1, 0};
    EXPECT_EQ(segmentParent(layout, kBodySegmentCount), -1);
    EXPECT_EQ(placeOf(layout, kBodySegmentCount)->kind, SegmentKind::Prop);
}

TEST(Segments, GivesEveryItemOfTheLargestDatagramItsOwnName) {
    const SegmentLayout layout{kBodySegmentCount, kMaxPropCount, kFingerSegmentCount};
    ASSERT_EQ(layout.count(), kMaxSegmentCount);
    std::set<std::string> names;
    for (int position = 0; position < layout.count(); ++position) {
        EXPECT_LT(segmentParent(layout, position), position);
        names.emplace(segmentName(layout, position));
    }
    EXPECT_EQ(names.size(), static_cast<std::size_t>(kMaxSegmentCount));
}

TEST(Segments, SurvivesCountsThatNoSenderHas) {
    const SegmentLayout layout{200, 9, 250};
    for (int position = -2; position < layout.count() + 2; ++position) {
        static_cast<void>(segmentName(layout, position));
        EXPECT_LT(segmentParent(layout, position), std::max(position, 0));
    }
    EXPECT_EQ(placeOf(layout, 50), std::nullopt);
}

TEST(Segments, MirrorsLimbsAndLeavesTheTrunk) {
    EXPECT_EQ(mirrored(kHead), kHead);
    EXPECT_EQ(mirrored(kRightHand), kLeftHand);
    EXPECT_EQ(mirrored(kLeftToe), kRightToe);
    for (int index = 0; index < kBodySegmentCount; ++index) {
        EXPECT_EQ(mirrored(mirrored(index)), index);
    }
}

} // namespace
} // namespace posewire::model
