// SPDX-License-Identifier: MIT
#include "core/model/body/character_pose.h"
#include "core/model/body/points.h"
#include "core/model/body/reference_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

/// Which item of a pose datagram is which segment, whatever counts a sender gives.
namespace posewire::model {
namespace {

wire::Header headerOf(std::uint8_t body, std::uint8_t props, std::uint8_t fingers) {
    wire::Header header;
    header.bodySegments = body;
    header.props = props;
    header.fingerSegments = fingers;
    return header;
}

wire::Datagram poseWith(std::size_t items) {
    wire::PoseQuaternion pose;
    for (std::uint32_t i = 0; i < items; ++i) {
        pose.segments.push_back({i + 1, {static_cast<float>(i), 0, 1}, {1, 0, 0, 0}});
    }
    return {{}, std::move(pose), {}};
}

TEST(LayoutOfPose, IsThatOfTheHeaderWhereItsCountsAddUp) {
    EXPECT_EQ(segmentLayout(headerOf(23, 0, 0), 23), (SegmentLayout{23, 0, 0}));
    EXPECT_EQ(segmentLayout(headerOf(23, 4, 40), 67), (SegmentLayout{23, 4, 40}));
    EXPECT_EQ(segmentLayout(headerOf(23, 1, 20), 44), (SegmentLayout{23, 1, 20}));
    EXPECT_EQ(segmentLayout(headerOf(3, 0, 0), 3), (SegmentLayout{3, 0, 0})) << "tracked objects";
}

TEST(LayoutOfPose, IsThatOfOlderSendersWhereTheHeaderSaysNothingOrTheWrong) {
    for (const wire::Header& header : {headerOf(0, 0, 0), headerOf(23, 0, 0), headerOf(5, 5, 5)}) {
        EXPECT_EQ(segmentLayout(header, 25), (SegmentLayout{23, 2, 0}));
        EXPECT_EQ(segmentLayout(header, 63), (SegmentLayout{23, 0, 40}));
        EXPECT_EQ(segmentLayout(header, 65), (SegmentLayout{23, 2, 40}));
        EXPECT_EQ(segmentLayout(header, 7), (SegmentLayout{7, 0, 0}));
        EXPECT_EQ(segmentLayout(header, 0), (SegmentLayout{0, 0, 0}));
    }
}

TEST(LayoutOfPose, HasNoMoreSegmentsThanThereMayBe) {
    for (const wire::Header& header : {headerOf(100, 0, 0), headerOf(23, 60, 17), headerOf(255, 255, 255)}) {
        for (const std::size_t items : {std::size_t{68}, std::size_t{100}, std::size_t{765}}) {
            EXPECT_EQ(segmentLayout(header, items), (SegmentLayout{23, 4, 40})) << items;
        }
    }
    wire::Datagram datagram{headerOf(100, 0, 0), wire::LinearKinematics{}, {}};
    datagram.header.datagramCounter = 0x80;
    for (std::uint32_t id = 1; id <= 100; ++id) {
        std::get<wire::LinearKinematics>(datagram.body).segments.push_back({id, {0, 0, 1}, {}, {}});
    }
    const PosePart part{&datagram};
    CharacterPose pose;
    ASSERT_TRUE(poseFromParts({&part, 1}, {referenceOrigins()}, nullptr, 0, pose));
    EXPECT_EQ(pose.segments.size(), static_cast<std::size_t>(kMaxSegmentCount));
}

TEST(LayoutOfPose, CountsAllItemsOfAnyLegalDatagramOnce) {
    for (std::size_t items = 0; items <= static_cast<std::size_t>(kMaxSegmentCount); ++items) {
        const SegmentLayout layout = segmentLayout(headerOf(0, 0, 0), items);
        ASSERT_EQ(layout.count(), static_cast<int>(items));
        std::set<std::string_view> names;
        for (int position = 0; position < layout.count(); ++position) {
            names.insert(segmentName(layout, position));
            const int parent = segmentParent(layout, position);
            ASSERT_LT(parent, position) << "parents come before their children";
        }
        if (layout.props <= kMaxPropCount) {
            ASSERT_EQ(names.size(), items) << "each has a name of its own";
        }
        EXPECT_EQ(placeOf(layout, layout.count()), std::nullopt);
        EXPECT_EQ(placeOf(layout, -1), std::nullopt);
        EXPECT_TRUE(segmentName(layout, layout.count()).empty());
        EXPECT_EQ(segmentParent(layout, layout.count()), -1);
    }
}

TEST(ItemPlaces, BeginWithTheFirstIdInALaterPartOfASample) {
    wire::Header header;
    header.datagramCounter = 0x80;
    EXPECT_EQ(itemPlaces(header, 23, 5U).first, 0) << "a whole sample goes by place";
    header.datagramCounter = 0x00;
    EXPECT_EQ(itemPlaces(header, 9, 1U).first, 0);
    header.datagramCounter = 0x81;
    const ItemPlaces later = itemPlaces(header, 14, 10U);
    EXPECT_EQ(later.first, 9);
    EXPECT_EQ(later.layout, (SegmentLayout{23, 0, 0}));
    EXPECT_EQ(itemPlaces(header, 14, std::nullopt).first, std::nullopt);
    EXPECT_EQ(itemPlaces(header, 14, 0U).first, std::nullopt);
    EXPECT_EQ(itemPlaces(header, 14, 4'000'000'000U).first, std::nullopt);
}

TEST(ItemPlaces, NameTheBodyByIdAndTheRestByPlace) {
    wire::Header header;
    header.datagramCounter = 0x80;
    const ItemPlaces older = itemPlaces(header, 24, 1U);
    EXPECT_EQ(older.positionOf(4, 5U), 4);
    EXPECT_EQ(older.positionOf(4, 11U), 10) << "an id of the body is the segment";
    EXPECT_EQ(older.positionOf(21, 23U), segment::kLeftFoot) << "revision E";
    EXPECT_EQ(older.positionOf(22, 24U), segment::kLeftToe) << "revision E";
    EXPECT_EQ(older.positionOf(22, 23U), segment::kLeftToe);
    EXPECT_EQ(older.positionOf(23, 25U), 23) << "a prop";
    EXPECT_EQ(older.positionOf(3, std::nullopt), 3);
    header.datagramCounter = 0x81;
    EXPECT_EQ(itemPlaces(header, 4, std::nullopt).positionOf(0, std::nullopt), -1);
}

TEST(ItemPlaces, KnowThePropsAndFingersOfTheWholeSampleInEachPart) {
    wire::Header header;
    header.bodySegments = 23;
    header.props = 1;
    header.fingerSegments = 40;
    for (const std::uint8_t counter : std::initializer_list<std::uint8_t>{0x00, 0x01, 0x82}) {
        header.datagramCounter = counter;
        EXPECT_EQ(itemPlaces(header, 16, 25U).layout, (SegmentLayout{23, 1, 40}));
    }
}

TEST(LayoutOfPose, HangsHandsOnNothingWhereTheBodyHasNone) {
    const SegmentLayout hands{1, 0, 40};
    EXPECT_EQ(segmentName(hands, 1), "LeftCarpus");
    EXPECT_EQ(segmentParent(hands, 1), -1);
    EXPECT_EQ(segmentName(hands, 21), "RightCarpus");
    EXPECT_EQ(segmentParent(hands, 21), -1);
    EXPECT_EQ(segmentParent(hands, 2), 1) << "but within the hand as ever";
}

TEST(DisplayNames, AreWordsOfTheSameSegments) {
    std::set<std::string_view> names;
    for (const Segment& segment : bodySegments()) {
        std::string joined(segment.displayName);
        std::erase(joined, ' ');
        const auto isSame = [](char a, char b) { return std::tolower(a) == std::tolower(b); };
        EXPECT_TRUE(std::ranges::equal(joined, segment.name, isSame)) << joined;
        names.insert(segment.displayName);
    }
    EXPECT_EQ(names.size(), 23U);
}

TEST(SegmentNames, FindSegmentsOfTheBodyAlone) {
    const SegmentLayout layout{23, 4, 40};
    for (int position = 0; position < layout.count(); ++position) {
        EXPECT_EQ(findBodySegment(segmentName(layout, position)),
                  position < 23 ? std::optional(position) : std::nullopt);
    }
}

TEST(CharacterPoses, LeaveOutItemsThatAreNowhere) {
    wire::Datagram datagram = poseWith(23);
    auto& segments = std::get<wire::PoseQuaternion>(datagram.body).segments;
    segments[3].position[2] = std::numeric_limits<float>::quiet_NaN();
    segments[4].position[0] = std::numeric_limits<float>::infinity();
    segments[6].position[1] = -1.8e19F;     // one bit of its exponent was turned
    segments[5].orientation = {0, 0, 0, 0}; // cannot be normalized: the identity
    CharacterPose pose;
    ASSERT_TRUE(poseFromMessage(datagram, referenceOrigins(), LengthUnit::Metre, pose));
    for (std::size_t i = 0; i < 23; ++i) {
        EXPECT_EQ(pose.isPresent(i), i != 3 && i != 4 && i != 6) << i;
        EXPECT_TRUE(pose.segments[i].position.allFinite());
    }
    EXPECT_EQ(pose.segments[5].orientation.w(), 1);
}

TEST(CharacterPoses, AreReadInTheUnitOfTheSender) {
    CharacterPose pose;
    ASSERT_TRUE(poseFromMessage(poseWith(23), referenceOrigins(), LengthUnit::Centimetre, pose));
    EXPECT_DOUBLE_EQ(pose.segments[10].position.x(), 0.1);
    EXPECT_DOUBLE_EQ(pose.segments[10].position.z(), 0.01);
}

TEST(CharacterPoses, HaveNoPropsWhereTagsAre) {
    wire::Datagram datagram = poseWith(27);
    auto& items = std::get<wire::PoseQuaternion>(datagram.body).segments;
    wire::completeHeader(datagram, wire::HeaderEra::Reserved);
    CharacterPose pose;
    ASSERT_TRUE(poseFromMessage(datagram, {}, LengthUnit::Metre, pose));
    EXPECT_EQ(pose.layout, (SegmentLayout{23, 4, 0}));
    items[24].id = 900;
    items[25].id = 28; // a prop that is not turned
    items[26].id = 901;
    ASSERT_TRUE(poseFromMessage(datagram, {}, LengthUnit::Metre, pose));
    EXPECT_EQ(pose.layout, (SegmentLayout{23, 2, 0}));
    ASSERT_EQ(pose.segments.size(), 25U);
    EXPECT_EQ(pose.segments[24].position.x(), 25);
}

TEST(CharacterPoses, CarryWhatTheHeaderSays) {
    wire::Datagram datagram = poseWith(23);
    datagram.header.sampleCounter = 0xfffffffeU;
    datagram.header.timeCode = 51'451'758;
    datagram.header.setType(2);
    CharacterPose pose;
    pose.segments.resize(99); // of a pose before
    ASSERT_TRUE(poseFromMessage(datagram, referenceOrigins(), LengthUnit::Metre, pose));
    EXPECT_EQ(pose.type, 2);
    EXPECT_EQ(pose.sample, 0xfffffffeU);
    EXPECT_EQ(pose.timeCode, 51'451'758U);
    EXPECT_EQ(pose.segments.size(), 23U);
}

TEST(CharacterPoses, NeedAllSegmentsOfType05) {
    wire::PoseUnity unity;
    for (std::uint32_t i = 0; i < 22; ++i) {
        unity.segments.push_back({i + 1, {}, {1, 0, 0, 0}});
    }
    CharacterPose pose;
    wire::Datagram datagram{{}, unity, {}};
    EXPECT_FALSE(poseFromMessage(datagram, referenceOrigins(), LengthUnit::Metre, pose));
    unity.segments.push_back({23, {}, {1, 0, 0, 0}});
    datagram.body = unity;
    EXPECT_TRUE(poseFromMessage(datagram, referenceOrigins(), LengthUnit::Metre, pose));
    const std::span<const Eigen::Vector3d> tooFew(referenceOrigins().data(), 22);
    EXPECT_FALSE(poseFromMessage(datagram, tooFew, LengthUnit::Metre, pose));
    EXPECT_FALSE(
        poseFromMessage({{}, wire::CentreOfMass{}, {}}, referenceOrigins(), LengthUnit::Metre, pose));
}

TEST(CharacterPoses, OfType05HangOnTheNullPoseBoneByBone) {
    wire::PoseUnity unity;
    for (std::uint32_t i = 0; i < 23; ++i) { // the wire's positions may be anything but the pelvis'
        unity.segments.push_back({i + 1, {9, 9, 9}, {1, 0, 0, 0}});
    }
    unity.segments[0].position = {-2, 1, 3}; // Unity: (-y, z, x)
    CharacterPose pose;
    ASSERT_TRUE(poseFromMessage({{}, unity, {}}, referenceOrigins(), LengthUnit::Metre, pose));
    const auto& origins = referenceOrigins();
    const Eigen::Vector3d pelvis(3, 2, 1);
    for (std::size_t i = 0; i < 23; ++i) {
        EXPECT_LT((pose.segments[i].position - (pelvis + origins[i] - origins[0])).norm(), 1e-6) << i;
    }
}

TEST(PointIds, ComeBackFromBothCodings) {
    for (const PointIdCoding coding : {PointIdCoding::By256, PointIdCoding::By100}) {
        for (const AnatomicalPoint& point : anatomicalPoints()) {
            const PointReference reference{point.segment + 1, point.localId};
            const auto id = encodePointId(coding, reference);
            EXPECT_EQ(decodePointId(coding, id), reference);
            EXPECT_EQ(knownPoint(coding, id), reference) << point.name;
        }
    }
    EXPECT_EQ(encodePointId(PointIdCoding::By256, {1, 13}), 269U) << "pSacrum, as in the specification";
    EXPECT_EQ(encodePointId(PointIdCoding::By100, {1, 13}), 113U);
    EXPECT_EQ(encodePointId(PointIdCoding::Unknown, {1, 13}), 0U);
    EXPECT_EQ(decodePointId(PointIdCoding::Unknown, 269), std::nullopt);
}

TEST(PointIds, AreUnknownOutsideTheTables) {
    EXPECT_EQ(knownPoint(PointIdCoding::By256, 256 * 1 + 15), std::nullopt) << "the pelvis has 14";
    EXPECT_EQ(knownPoint(PointIdCoding::By256, 256 * 2 + 4), std::nullopt) << "L5 has 3";
    EXPECT_TRUE(knownPoint(PointIdCoding::By256, 256 * 67 + 14).has_value()) << "a finger may have any";
    EXPECT_EQ(knownPoint(PointIdCoding::By256, 256 * 67 + 15), std::nullopt);
    EXPECT_EQ(knownPoint(PointIdCoding::By256, 256 * 68 + 1), std::nullopt);
    EXPECT_EQ(knownPoint(PointIdCoding::By256, 7), std::nullopt) << "there is no segment 0";
    EXPECT_TRUE(knownPoint(PointIdCoding::By100, 100 * 28 + 14).has_value());
    EXPECT_EQ(knownPoint(PointIdCoding::By100, 100 * 29 + 1), std::nullopt);
    EXPECT_EQ(knownPoint(PointIdCoding::By256, 0xffffffffU), std::nullopt);
    EXPECT_EQ(findPoint(0, 99), nullptr);
    EXPECT_EQ(findPoint("pNobody"), nullptr);
}

} // namespace
} // namespace posewire::model
