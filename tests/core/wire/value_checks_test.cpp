// SPDX-License-Identifier: MIT
#include "tests/core/wire/generated_datagrams.h"

#include <gtest/gtest.h>

#include <limits>

namespace posewire::wire {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

using Notices = std::vector<Notice>;

std::vector<Notice> noticesOf(const Body& body) {
    Datagram datagram;
    datagram.body = body;
    completeHeader(datagram, HeaderEra::Counted);
    const auto read = decode(encode(datagram).value());
    EXPECT_TRUE(read);
    return read ? read->notices : std::vector<Notice>{};
}

/// Three items of a list, each good; `spoil` is done to the second.
template <class Message, class Item>
std::vector<Notice> noticesOfThree(std::vector<Item> Message::*list, const Item& good, auto spoil) {
    Message message;
    (message.*list).assign(3, good);
    spoil((message.*list)[1]);
    return noticesOf(message);
}

/// A unit quaternion made `factor` times as long.
Quat scaled(float factor) {
    return {0.5F * factor, -0.5F * factor, 0.5F * factor, 0.5F * factor};
}

TEST(ValueChecks, TakeAQuaternionWithinOneHundredthOfUnitLength) {
    for (const float length : {0.991F, 0.999F, 1.0F, 1.001F, 1.009F}) {
        EXPECT_TRUE(noticesOf(PoseQuaternion{{{1, {}, scaled(length)}}}).empty()) << length;
    }
    for (const float length : {0.0F, 0.5F, 0.988F, 1.012F, 2.0F, 1e19F}) {
        EXPECT_EQ(noticesOf(PoseQuaternion{{{1, {}, scaled(length)}}}),
                  (Notices{{NoticeCode::NotUnitQuaternion, 24, 1}}))
            << length;
    }
}

TEST(ValueChecks, FindTheQuaternionInEveryTypeThatHasOne) {
    const auto spoil = [](auto& item) { item.orientation = scaled(1.5F); };
    const auto oddAt = [](std::uint32_t offset) {
        return Notices{{NoticeCode::NotUnitQuaternion, offset, 1}};
    };
    const SegmentQuaternion segment{1, {1, 2, 3}, scaled(1)};
    EXPECT_EQ(noticesOfThree(&PoseQuaternion::segments, segment, spoil), oddAt(24 + 32));
    EXPECT_EQ(noticesOfThree(&PoseUnity::segments, segment, spoil), oddAt(24 + 32));
    EXPECT_EQ(noticesOfThree(&AngularKinematics::segments, {1, scaled(1), {}, {}}, spoil), oddAt(24 + 44));
    EXPECT_EQ(noticesOfThree(&TrackerKinematics::trackers, {1, scaled(1), {}, {}, {}, {}}, spoil),
              oddAt(24 + 68));
}

TEST(ValueChecks, FindTheQuaternionOfAShortTracker) {
    TrackerKinematics message{false, {{1, scaled(1)}, {5, scaled(0.1F)}, {7, scaled(1)}}};
    EXPECT_EQ(noticesOf(message), (Notices{{NoticeCode::NotUnitQuaternion, 24 + 44, 1}}));
    message.trackers[2].magneticField[2] = kNaN;
    EXPECT_EQ(noticesOf(message),
              (Notices{{NoticeCode::NotFinite, 24 + 88, 1}, {NoticeCode::NotUnitQuaternion, 24 + 44, 1}}));
}

/// What is not a number has no length: one notice says enough.
TEST(ValueChecks, CountAQuaternionThatIsNotFiniteOnce) {
    EXPECT_EQ(noticesOf(PoseQuaternion{{{1, {}, {kNaN, 0, 0, 0}}}}),
              (Notices{{NoticeCode::NotFinite, 24, 1}}));
    EXPECT_EQ(noticesOf(PoseQuaternion{{{1, {}, {kInfinity, 0, -kInfinity, 0}}}}),
              (Notices{{NoticeCode::NotFinite, 24, 2}}));
}

TEST(ValueChecks, AcceptTheSegments1To67) {
    for (const std::uint32_t id : {1U, 23U, 24U, 67U}) {
        EXPECT_TRUE(noticesOf(PoseQuaternion{{{id, {}, {1, 0, 0, 0}}}}).empty()) << id;
    }
    for (const std::uint32_t id : {0U, 68U, 256U, 0x80000000U, 0xffffffffU}) {
        EXPECT_EQ(noticesOf(PoseQuaternion{{{id, {}, {1, 0, 0, 0}}}}),
                  (Notices{{NoticeCode::SegmentOutOfRange, 24, 1}}))
            << id;
    }
}

TEST(ValueChecks, FindTheSegmentInEveryTypeThatNamesOne) {
    const auto spoil = [](auto& item) { item.id = 68; };
    const auto oddAt = [](std::uint32_t offset) {
        return Notices{{NoticeCode::SegmentOutOfRange, offset, 1}};
    };
    const SegmentQuaternion segment{1, {}, {1, 0, 0, 0}};
    EXPECT_EQ(noticesOfThree(&PoseEuler::segments, {1, {}, {}}, spoil), oddAt(24 + 28));
    EXPECT_EQ(noticesOfThree(&PoseUnity::segments, segment, spoil), oddAt(24 + 32));
    EXPECT_EQ(noticesOfThree(&ScaleInformation::segments, {1, {}, {}}, spoil), oddAt(24 + 52));
    EXPECT_EQ(noticesOfThree(&LinearKinematics::segments, {1, {}, {}, {}}, spoil), oddAt(24 + 40));
    EXPECT_EQ(noticesOfThree(&AngularKinematics::segments, {1, {1, 0, 0, 0}, {}, {}}, spoil), oddAt(24 + 44));
    EXPECT_EQ(noticesOfThree(&TrackerKinematics::trackers, {1, {1, 0, 0, 0}, {}, {}, {}, {}}, spoil),
              oddAt(24 + 68));
}

TEST(ValueChecks, LeaveTheNumbersOfPointsTagsJointsAndPropsAlone) {
    EXPECT_TRUE(noticesOf(PointPositions{{{0, {}}, {0xffffffff, {}}}}).empty());
    EXPECT_TRUE(noticesOf(TagPositions{{{0, {}}, {100'000, {}}}}).empty());
    EXPECT_TRUE(noticesOf(JointAngles{{{0, 0xffffffff, {}}}}).empty());
    EXPECT_TRUE(noticesOf(PropInformation{{{0, "x"}, {999, "y"}}}).empty());
}

/// As revision E has it where no props are counted.
std::vector<Notice> noticesOf(const Body& body, std::uint8_t props) {
    Datagram datagram;
    datagram.header.bodySegments = 23;
    datagram.header.props = props;
    datagram.body = body;
    completeHeader(datagram, props == 0 ? HeaderEra::Reserved : HeaderEra::Counted);
    return decode(encode(datagram).value()).value().notices;
}

TEST(ValueChecks, TakeTagsInThePlacesOfPropsForTags) {
    PoseQuaternion quaternions;
    PoseEuler angles;
    for (std::uint32_t i = 0; i < 27; ++i) {
        const std::uint32_t id = i < 25 ? i + 1 : 1209 + i;
        quaternions.segments.push_back({id, {1, 2, 3}, {1, 0, 0, 0}});
        angles.segments.push_back({id, {1, 2, 3}, {}});
    }
    EXPECT_TRUE(noticesOf(quaternions, 0).empty());
    EXPECT_TRUE(noticesOf(angles, 0).empty());
    EXPECT_EQ(noticesOf(quaternions, 4), (Notices{{NoticeCode::SegmentOutOfRange, 24 + 25 * 32, 2}}));
    quaternions.segments[26].orientation = {0, 1, 0, 0};
    EXPECT_EQ(noticesOf(quaternions, 0), (Notices{{NoticeCode::SegmentOutOfRange, 24 + 26 * 32, 1}}));
    angles.segments[25].position[0] = kNaN;
    EXPECT_EQ(noticesOf(angles, 0), (Notices{{NoticeCode::NotFinite, 24 + 25 * 28, 1}}));
}

TEST(ValueChecks, FindWhatIsNotFiniteInEveryType) {
    const auto oddAt = [](std::uint32_t offset, std::uint32_t count) {
        return Notices{{NoticeCode::NotFinite, offset, count}};
    };
    const auto spoilPosition = [](auto& item) { item.position = {kNaN, 0, kInfinity}; };
    const auto spoilRotation = [](auto& item) { item.rotation[1] = -kInfinity; };
    EXPECT_EQ(noticesOfThree(&PoseEuler::segments, {1, {}, {}}, spoilPosition), oddAt(24 + 28, 2));
    EXPECT_EQ(noticesOfThree(&PoseEuler::segments, {1, {}, {}}, spoilRotation), oddAt(24 + 28, 1));
    EXPECT_EQ(noticesOfThree(&PointPositions::points, {1, {}}, spoilPosition), oddAt(24 + 16, 2));
    EXPECT_EQ(noticesOfThree(&TagPositions::points, {1, {}}, spoilPosition), oddAt(24 + 16, 2));
    EXPECT_EQ(noticesOfThree(&JointAngles::joints, {257, 513, {}}, spoilRotation), oddAt(24 + 20, 1));
    EXPECT_EQ(noticesOfThree(&LinearKinematics::segments, {1, {}, {}, {}}, spoilPosition), oddAt(24 + 40, 2));
    EXPECT_EQ(noticesOfThree(&ScaleInformation::segments, {1, {}, {}},
                             [](SegmentScale& item) { item.matrix.fill(kNaN); }),
              oddAt(24 + 52, 9));
    EXPECT_EQ(noticesOfThree(&TrackerKinematics::trackers, {1, {1, 0, 0, 0}, {}, {}, {}, {}},
                             [](Tracker& item) { item.acceleration = item.angularVelocity = {kNaN}; }),
              oddAt(24 + 68, 2));
    EXPECT_EQ(noticesOf(CentreOfMass{true, {}, {}, {0, 0, kNaN}}), oddAt(24, 1));
    EXPECT_EQ(noticesOf(CentreOfMass{false, {kNaN, kNaN, kNaN}, {}, {}}), oddAt(24, 3));
}

TEST(ValueChecks, NameThePlaceInANullPose) {
    const NullPoseSegment good{"Pelvis", {0, 0, 1}};
    const std::uint32_t second = 24 + 4 + (4 + 6 + 12);
    EXPECT_EQ(noticesOf(NullPose{{good, {"L5", {kNaN, 0, 0}}, good}, {}}),
              (Notices{{NoticeCode::NotFinite, second, 1}}));
    const NullPosePoint point{1, 13, "pSacrum", 0, {1, 2, 3}};
    const NullPosePoint odd{1, 13, "", 0, {1, kInfinity, 3}};
    const std::uint32_t points = second + 4;
    EXPECT_EQ(noticesOf(NullPose{{good}, {point, odd}}),
              (Notices{{NoticeCode::NotFinite, points + (2 + 2 + 4 + 7 + 4 + 12), 1}}));
}

/// Several places of a kind are one notice with the first of them.
TEST(ValueChecks, AddUpWhatIsOddOverAllItems) {
    PoseQuaternion message;
    message.segments.assign(10, {1, {}, {1, 0, 0, 0}});
    message.segments[3].position = {kNaN, kNaN, 0};
    message.segments[5].position = {0, 0, kInfinity};
    message.segments[4].orientation = scaled(3);
    message.segments[9].orientation = scaled(0);
    message.segments[2].id = 0;
    message.segments[5].id = 70;
    message.segments[7].id = 71;
    EXPECT_EQ(noticesOf(message), (Notices{{NoticeCode::NotFinite, 24 + 3 * 32, 3},
                                           {NoticeCode::NotUnitQuaternion, 24 + 4 * 32, 2},
                                           {NoticeCode::SegmentOutOfRange, 24 + 2 * 32, 3}}));
}

/// Values so large that their squares or sums overflow are finite all the same.
TEST(ValueChecks, DoNotTakeLargeNumbersForInfinite) {
    const float large = std::numeric_limits<float>::max();
    EXPECT_TRUE(noticesOf(PointPositions{{{1, {large, large, -large}}, {2, {large, large, large}}}}).empty());
    EXPECT_TRUE(noticesOf(CentreOfMass{true, {large, large, large}, {}, {}}).empty());
    const float tiny = std::numeric_limits<float>::denorm_min();
    EXPECT_TRUE(noticesOf(PoseEuler{{{1, {tiny, -tiny, tiny}, {}}}}).empty());
}

TEST(ValueChecks, CompareTheCountsOnlyInWholeSamplesOfSegments) {
    Datagram datagram;
    datagram.body = PoseEuler{std::vector<SegmentEuler>(3, {1, {}, {}})};
    completeHeader(datagram, HeaderEra::Counted);
    const auto isOdd = [&] { return !decode(encode(datagram).value())->notices.empty(); };
    EXPECT_FALSE(isOdd()) << "older senders leave the counts 0";
    datagram.header.bodySegments = 2;
    EXPECT_TRUE(isOdd());
    datagram.header.props = 1;
    EXPECT_FALSE(isOdd());
    datagram.header.fingerSegments = 40;
    EXPECT_TRUE(isOdd());
    datagram.header.datagramCounter = 0x00; // the first of several
    EXPECT_FALSE(isOdd());
    datagram.header.datagramCounter = 0x81;
    EXPECT_FALSE(isOdd());
}

TEST(ValueChecks, CountTheBytesBehindTheAnnouncedPayload) {
    Datagram datagram;
    datagram.body = PoseQuaternion{{{1, {}, {1, 0, 0, 0}}}};
    completeHeader(datagram, HeaderEra::Counted);
    auto bytes = encode(datagram).value();
    for (std::uint32_t more = 1; more < 100; ++more) {
        bytes.push_back(std::byte{0xff});
        const auto read = decode(bytes);
        ASSERT_TRUE(read);
        EXPECT_EQ(read->notices, (Notices{{NoticeCode::SizeDisagrees, 24 + 32, more}}));
        EXPECT_TRUE(read->body == datagram.body);
    }
}

TEST(ValueChecks, CountTheBytesBehindTheLastField) {
    Datagram datagram;
    datagram.body = PoseQuaternion{{{1, {}, {1, 0, 0, 0}}}};
    completeHeader(datagram, HeaderEra::Reserved);
    auto bytes = encode(datagram).value();
    for (std::uint32_t more = 1; more < 100; ++more) {
        bytes.push_back(std::byte{0xff});
        const auto read = decode(bytes);
        ASSERT_TRUE(read);
        EXPECT_EQ(read->notices, (Notices{{NoticeCode::TrailingBytes, 24 + 32, more}}));
    }
}

} // namespace
} // namespace posewire::wire
