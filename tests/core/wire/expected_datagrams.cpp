// SPDX-License-Identifier: MIT
#include "tests/core/wire/expected_datagrams.h"

#include <functional>
#include <map>

namespace posewire::wire::test {
namespace {

/// The goldens' vectors: of item k, vector number s.
Vec3 vec(unsigned k, unsigned s) {
    const auto item = static_cast<float>(k);
    const auto slot = static_cast<float>(s);
    return {item + slot * 0.125F, -(item + 0.5F), slot * 10.0F + 0.25F};
}

Quat quat(unsigned k) {
    constexpr std::array<Quat, 3> turns{
        {{0.5F, -0.5F, 0.5F, 0.5F}, {0.6F, 0.0F, 0.8F, 0.0F}, {0.0F, 0.28F, 0.0F, -0.96F}}};
    return turns[k % 3];
}

template <class Message, class Item>
Message listOf(unsigned count, std::vector<Item> Message::*list, const std::function<Item(unsigned)>& item) {
    Message message;
    for (unsigned k = 1; k <= count; ++k) {
        (message.*list).push_back(item(k));
    }
    return message;
}

PoseEuler euler(unsigned count) {
    return listOf<PoseEuler, SegmentEuler>(count, &PoseEuler::segments, [](unsigned k) {
        return SegmentEuler{k, vec(k, 0), vec(k, 1)};
    });
}
template <class Message>
Message quaternions(unsigned count) {
    return listOf<Message, SegmentQuaternion>(count, &Message::segments, [](unsigned k) {
        return SegmentQuaternion{k, vec(k, 0), quat(k)};
    });
}
template <class Message>
Message points(unsigned count, unsigned firstId) {
    return listOf<Message, Point>(count, &Message::points, [=](unsigned k) {
        return Point{firstId + k, vec(k, 0)};
    });
}
ScaleInformation scale(unsigned count) {
    return listOf<ScaleInformation, SegmentScale>(count, &ScaleInformation::segments, [](unsigned k) {
        const auto n = static_cast<float>(k);
        return SegmentScale{k, vec(k, 0), {n, 0, 0, 0, n + 0.5F, 0, 0.125F, 0, -n}};
    });
}
PropInformation props() {
    return {{{24, "Sword"}, {25, "Dagger \u00e9"}}};
}
MetaData metaData(bool hasLengthPrefix) {
    return {hasLengthPrefix, "name:J\u00f6rg: take 2\nxmid:0080A1B2\ncolor:e96417\n"};
}
std::vector<NullPoseSegment> nullPoseSegments() {
    return {{"Pelvis", vec(1, 0)}, {"L5", vec(2, 0)}, {"L\u00e4nge 3", vec(3, 0)}};
}
std::vector<NullPosePoint> nullPosePoints(const std::string& second) {
    return {{1, 13, "pSacrum", 0x80000001U, vec(1, 1)}, {2, 14, second, 0x80000002U, vec(2, 1)}};
}
JointAngles joints(unsigned count) {
    return listOf<JointAngles, Joint>(count, &JointAngles::joints, [](unsigned k) {
        return Joint{256 * k + 2, 256 * (k + 1) + 1, vec(k, 0)};
    });
}
LinearKinematics linear(unsigned count) {
    return listOf<LinearKinematics, LinearSegment>(count, &LinearKinematics::segments, [](unsigned k) {
        return LinearSegment{k, vec(k, 0), vec(k, 1), vec(k, 2)};
    });
}
AngularKinematics angular(unsigned count) {
    return listOf<AngularKinematics, AngularSegment>(count, &AngularKinematics::segments, [](unsigned k) {
        return AngularSegment{k, quat(k), vec(k, 1), vec(k, 2)};
    });
}
TrackerKinematics trackers(unsigned count, bool isLong) {
    auto message = listOf<TrackerKinematics, Tracker>(count, &TrackerKinematics::trackers, [=](unsigned k) {
        return Tracker{k,        quat(k), vec(k, 1), isLong ? vec(k, 2) : Vec3{}, isLong ? vec(k, 3) : Vec3{},
                       vec(k, 4)};
    });
    message.hasInertialData = isLong;
    return message;
}
CentreOfMass centre(bool isLong) {
    return {isLong, vec(1, 0), isLong ? vec(1, 1) : Vec3{}, isLong ? vec(1, 2) : Vec3{}};
}
TimeCode timeCode(bool hasLengthPrefix, std::int32_t length) {
    return {hasLengthPrefix, length, {'1', '2', ':', '3', '4', ':', '5', '6', '.', '7', '8', '9'}};
}
RawBody raw(std::initializer_list<int> values) {
    RawBody body;
    for (const int value : values) {
        body.bytes.push_back(static_cast<std::byte>(value));
    }
    return body;
}
RawBody counting(int from, int end) {
    RawBody body;
    for (int value = from; value < end; ++value) {
        body.bytes.push_back(static_cast<std::byte>(value));
    }
    return body;
}

struct Row {
    std::uint8_t items;
    std::uint16_t payloadSize; ///< 0: the reserved header
    Body body;
    std::vector<Notice> notices{};
};

const std::map<std::string, Row>& rows() {
    const std::vector<NullPosePoint> none;
    static const std::map<std::string, Row> all{
        {"01_euler_counted", {23, 23 * 28, euler(23)}},
        {"01_euler_reserved", {3, 0, euler(3)}},
        {"02_quaternion_counted", {23, 23 * 32, quaternions<PoseQuaternion>(23)}},
        {"02_quaternion_gloves", {67, 67 * 32, quaternions<PoseQuaternion>(67)}},
        {"02_quaternion_reserved", {3, 0, quaternions<PoseQuaternion>(3)}},
        {"03_points_counted", {5, 5 * 16, points<PointPositions>(5, 256)}},
        {"03_points_reserved", {2, 0, points<PointPositions>(2, 256)}},
        {"04_tags_reserved", {3, 0, points<TagPositions>(3, 1000)}},
        {"04_tags_counted", {2, 32, points<TagPositions>(2, 1000)}},
        {"04_unpublished", {2, 22, counting(0x10, 0x26), {{NoticeCode::UnknownLayout, 24, 1}}}},
        {"05_unity_counted", {23, 23 * 32, quaternions<PoseUnity>(23)}},
        {"05_unity_reserved", {2, 0, quaternions<PoseUnity>(2)}},
        {"10_scale_reserved", {2, 0, scale(2)}},
        {"10_scale_counted", {1, 52, scale(1)}},
        {"11_props_reserved", {2, 0, props()}},
        {"11_props_counted", {2, 24, props()}},
        {"11_props_none", {0, 0, PropInformation{}}},
        {"12_metadata_counted", {1, 50, metaData(true)}},
        {"12_metadata_reserved", {1, 0, metaData(true)}},
        {"12_metadata_bare", {1, 0, metaData(false)}},
        {"12_metadata_bare_counted", {1, 46, metaData(false)}},
        {"13_null_pose_segments", {0, 72, NullPose{nullPoseSegments(), none}}},
        {"13_null_pose_points", {0, 68, NullPose{{}, nullPosePoints("jL5S1")}}},
        {"13_null_pose_last", {0, 8, NullPose{}}},
        {"13_null_pose_reserved", {0, 0, NullPose{nullPoseSegments(), nullPosePoints("")}}},
        {"20_joints_counted", {28, 28 * 20, joints(28)}},
        {"20_joints_reserved", {2, 0, joints(2)}},
        {"21_linear_counted", {23, 23 * 40, linear(23)}},
        {"21_linear_reserved", {2, 0, linear(2)}},
        {"22_angular_counted", {23, 23 * 44, angular(23)}},
        {"22_angular_reserved", {2, 0, angular(2)}},
        {"23_trackers_68_counted", {17, 17 * 68, trackers(17, true)}},
        {"23_trackers_68_reserved", {3, 0, trackers(3, true)}},
        {"23_trackers_44_counted", {17, 17 * 44, trackers(17, false)}},
        {"23_trackers_44_reserved", {3, 0, trackers(3, false)}},
        {"24_centre_36_counted", {1, 36, centre(true)}},
        {"24_centre_36_reserved", {1, 0, centre(true)}},
        {"24_centre_12_counted", {1, 12, centre(false)}},
        {"24_centre_12_reserved", {1, 0, centre(false)}},
        {"25_time_code_counted", {1, 16, timeCode(true, 12)}},
        {"25_time_code_reserved", {1, 0, timeCode(true, 12)}},
        {"25_time_code_bare", {1, 0, timeCode(false, 12)}},
        {"25_time_code_bare_counted", {1, 12, timeCode(false, 12)}},
        {"25_time_code_wrong_length", {1, 16, timeCode(true, 0), {{NoticeCode::LengthDisagrees, 24, 1}}}},
        {"25_time_code_miscounted",
         {1,
          12,
          timeCode(true, 0),
          {{NoticeCode::SizeDisagrees, 36, 4}, {NoticeCode::LengthDisagrees, 24, 1}}}},
        {"77_unknown_counted", {2, 5, raw({0xde, 0xad, 0xbe, 0xef, 0}), {{NoticeCode::UnknownType, 4, 1}}}},
        {"77_unknown_reserved", {2, 0, raw({0xde, 0xad, 0xbe, 0xef, 0}), {{NoticeCode::UnknownType, 4, 1}}}},
    };
    return all;
}

/// Sample counter 0 and time code 0 are the mark of types 12 and 13.
Header headerOf(const std::string& name, const Row& row) {
    const auto type = static_cast<std::uint8_t>(std::stoi(name.substr(0, 2)));
    const bool isInformation = type == MetaData::kType || type == NullPose::kType;
    Header header;
    header.setType(type);
    header.sampleCounter = isInformation ? 0 : 0x01020304;
    header.timeCode = isInformation ? 0 : 27837;
    header.items = row.items;
    header.character = 3;
    header.payloadSize = row.payloadSize;
    header.bodySegments = row.payloadSize != 0 ? 23 : 0;
    if (name == "02_quaternion_gloves") {
        header.props = 4;
        header.fingerSegments = 40;
    }
    const std::map<std::string, std::uint8_t> counters{
        {"13_null_pose_segments", 0}, {"13_null_pose_points", 1}, {"13_null_pose_last", 0x82}};
    const auto counter = counters.find(name);
    header.datagramCounter = counter != counters.end() ? counter->second : 0x80;
    return header;
}

} // namespace

Datagram expectedDatagram(const std::string& name) {
    const auto row = rows().find(name);
    return row == rows().end() ? Datagram{}
                               : Datagram{headerOf(name, row->second), row->second.body, row->second.notices};
}

} // namespace posewire::wire::test
