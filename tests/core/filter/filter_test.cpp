// SPDX-License-Identifier: MIT
#include "tests/core/filter/filter_fixture.h"

#include "core/model/body/joint_angles.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace posewire::filter::test {
namespace {

TEST(Filter, MatchesEverythingWithoutText) {
    EXPECT_TRUE(matches(golden("02_quaternion_counted"), ""));
    EXPECT_TRUE(matches(golden("02_quaternion_counted"), " \t\n"));
    EXPECT_TRUE(Filter().matchesEverything());
}

TEST(Filter, TakesATypeAsDigitsNumberOrName) {
    const Case packet = golden("02_quaternion_counted");
    for (const char* text : {"type == 02", "type == 2", "type == \"Pose, quaternion\"", "type in {01, 02}",
                             "type in 1..5", "type < 10 and not type == 3", "type != 3", "(type==2)"}) {
        EXPECT_TRUE(matches(packet, text)) << text;
    }
    for (const char* text : {"type == 03", "type in {1, 3, 10..25}", "type != 02", "!(type == 2)"}) {
        EXPECT_FALSE(matches(packet, text)) << text;
    }
}

wire::Datagram poseOf(std::vector<std::uint32_t> ids, wire::HeaderEra era) {
    wire::PoseQuaternion body;
    for (const std::uint32_t id : ids) {
        body.segments.push_back({id, {static_cast<float>(id), 0, 0}, {1, 0, 0, 0}});
    }
    wire::Datagram datagram;
    datagram.body = std::move(body);
    datagram.header.bodySegments = 23;
    completeHeader(datagram, era);
    return datagram;
}

TEST(Filter, KnowsTheFootAndToeOfRevisionEByTheirPrintedNumbers) {
    std::vector<std::uint32_t> ids(21);
    std::iota(ids.begin(), ids.end(), 1U);
    std::vector<std::uint32_t> later = ids;
    ids.insert(ids.end(), {23, 24, 25});
    later.insert(later.end(), {22, 23, 24});
    const Case printed(poseOf(ids, wire::HeaderEra::Reserved));
    EXPECT_TRUE(matches(printed, "segment == LeftFoot and not segment == 22"));
    EXPECT_TRUE(matches(printed, "segment == LeftToe"));
    EXPECT_TRUE(matches(printed, "segment == Prop1"));
    EXPECT_TRUE(matches(printed, "segment == LeftFoot && position.x == 23"));
    const Case usual(poseOf(later, wire::HeaderEra::Reserved));
    EXPECT_TRUE(matches(usual, "segment == LeftFoot && segment == 22"));
    EXPECT_TRUE(matches(usual, "segment == Prop1"));
}

TEST(Filter, ReadsTheFieldsOfTheHeader) {
    const Case packet = golden("02_quaternion_counted");
    const wire::Header& header = packet.datagram.header;
    const auto sample = std::to_string(header.sampleCounter);
    EXPECT_TRUE(matches(packet, "sample == " + sample));
    EXPECT_TRUE(matches(packet, "header.sample == " + sample));
    EXPECT_TRUE(matches(packet, "sample in 0.." + sample));
    EXPECT_FALSE(matches(packet, "sample > " + sample));
    EXPECT_TRUE(matches(packet, "character == " + std::to_string(header.character)));
    EXPECT_TRUE(matches(packet, "id == \"MXTP02\""));
    EXPECT_TRUE(matches(packet, "items >= 1 && datagram == 0 && last"));
    EXPECT_TRUE(matches(packet, "wire.timeCode == " + std::to_string(header.timeCode)));
}

TEST(Filter, ReadsTheHeaderOfAPacketThatCannotBeDecoded) {
    auto bytes = posewire::test::golden("02_quaternion_counted").bytes;
    const std::string sample = std::to_string(wire::decodeHeader(bytes)->sampleCounter);
    bytes.resize(bytes.size() - 1);
    const Case packet(bytes);
    ASSERT_TRUE(packet.fault);
    EXPECT_TRUE(matches(packet, "malformed && sample == " + sample + " && type == 2 && datagram == 0"));
    EXPECT_FALSE(matches(packet, "notice"));
}

TEST(Filter, ComparesAnyItemOfAList) {
    const Case packet = pose({{0, 0, 1}, {0, 0, 3}, {0, 0, 2}});
    EXPECT_TRUE(matches(packet, "position.z > 2"));
    EXPECT_TRUE(matches(packet, "segments.position.z == 3"));
    EXPECT_FALSE(matches(packet, "position.z > 3"));
    EXPECT_TRUE(matches(packet, "position.z in {7, 2.5..3.5}"));
    EXPECT_TRUE(matches(packet, "segments == 3"));
    EXPECT_TRUE(matches(packet, "orientation.w == 1 && !(orientation.x == 1)"));
}

TEST(Filter, KnowsTheComponentsOfAQuaternionByTheTablesNamesAndByLetters) {
    wire::Datagram datagram;
    datagram.body = wire::PoseQuaternion{{{1, {}, {0.5F, -0.5F, 0.5F, 0.25F}}}};
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    const Case packet(datagram);
    for (const char* text :
         {"orientation.re == 0.5 && orientation.i == -0.5 && orientation.j == 0.5 && orientation.k == 0.25",
          "orientation.w == 0.5 && orientation.x == -0.5 && orientation.y == 0.5 && orientation.z == 0.25",
          "segments.orientation.re == 0.5 && segments.orientation.w == 0.5"}) {
        EXPECT_TRUE(matches(packet, text)) << text;
    }
    EXPECT_FALSE(matches(packet, "orientation.i == 0.5"));
    EXPECT_FALSE(Filter::compile("position.re == 0"));
    EXPECT_FALSE(Filter::compile("position.w == 0"));
    EXPECT_FALSE(Filter::compile("orientation.1 == 0"));
    EXPECT_FALSE(Filter::compile("sample.re == 0"));
}

TEST(Filter, SpeaksOfOneItemWithinOneGroup) {
    const Case packet = pose({{0, 0, 1}, {0, 0, 3}});
    EXPECT_TRUE(matches(packet, "segment == L5 && position.z > 2"));
    EXPECT_FALSE(matches(packet, "segment == Pelvis && position.z > 2"));
    EXPECT_FALSE(matches(packet, "type == 2 && segment == Pelvis && size > 10 && position.z > 2"));
    EXPECT_TRUE(matches(packet, "segment == Pelvis && (position.z < 0 || position.z == 1)"));
    EXPECT_TRUE(matches(packet, "(segment == Pelvis) && (position.z == 1)"));
    EXPECT_FALSE(matches(packet, "(segment == Pelvis) && (position.z == 3)"));
}

TEST(Filter, SpeaksOfDifferentItemsInDifferentGroups) {
    const Case packet = pose({{0, 0, 1}, {0, 0, 3}});
    EXPECT_TRUE(matches(packet, "(segment == 1 && position.z == 1) && (segment == 2 && position.z == 3)"));
    EXPECT_FALSE(matches(packet, "(segment == 1 && position.z == 1) && (segment == 2 && position.z == 1)"));
}

TEST(Filter, MeansNoItemAtAllByNot) {
    const Case packet = pose({{0, 0, 1}, {0, 0, 3}});
    EXPECT_TRUE(matches(packet, "!(position.z > 3)"));
    EXPECT_FALSE(matches(packet, "!(position.z > 2)"));
    EXPECT_FALSE(matches(packet, "not segment == L5"));
}

TEST(Filter, NamesSegmentsInAnyCase) {
    const Case packet = pose(std::vector<wire::Vec3>(23));
    EXPECT_TRUE(matches(packet, "segment == LeftHand"));
    EXPECT_TRUE(matches(packet, "segment == lefthand && id == 15"));
    EXPECT_TRUE(matches(packet, "segment == \"Left Hand\" && id == 15"));
    EXPECT_TRUE(matches(packet, "segment == \"Right Forearm\" && id == 10"));
    EXPECT_TRUE(matches(packet, "segment in {LeftHand, RightHand}"));
    EXPECT_TRUE(matches(packet, "segment == 15"));
    EXPECT_FALSE(matches(packet, "segment == LeftFirstPP"));
}

TEST(Filter, NamesFingersOfAPartOfASampleByTheirPlaceInTheWhole) {
    wire::Datagram datagram = golden("02_quaternion_gloves").datagram;
    auto& segments = std::get<wire::PoseQuaternion>(datagram.body).segments;
    segments.erase(segments.begin(), segments.begin() + 20);
    datagram.header.items = static_cast<std::uint8_t>(segments.size());
    datagram.header.datagramCounter = 0x81;
    datagram.header.payloadSize = static_cast<std::uint16_t>(32 * segments.size());
    const Case packet(datagram);
    ASSERT_FALSE(packet.fault);
    for (const char* name : {"LeftToe", "LeftCarpus", "LeftFirstPP", "RightFifthDP"}) {
        EXPECT_TRUE(matches(packet, std::string("segment == ") + name)) << name;
    }
    EXPECT_FALSE(matches(packet, "segment == Pelvis"));
    EXPECT_TRUE(matches(packet, "segment == LeftToe && id == 23"));
}

TEST(Filter, NamesFingersByTheirPlace) {
    const Case packet = golden("02_quaternion_gloves");
    EXPECT_TRUE(matches(packet, "segment == LeftFirstPP"));
    EXPECT_TRUE(matches(packet, "segment == RightFifthDP"));
}

TEST(Filter, NamesTheSegmentsOfEveryMessageThatHasThem) {
    for (const char* name : {"01_euler_counted", "05_unity_counted", "21_linear_counted",
                             "22_angular_counted", "13_null_pose_segments"}) {
        EXPECT_TRUE(matches(golden(name), "segment == Pelvis")) << name;
    }
}

TEST(Filter, ReadsPointNumbersOfBothRevisions) {
    const auto points = [](std::initializer_list<std::uint32_t> ids) {
        wire::PointPositions body;
        for (const std::uint32_t id : ids) {
            body.points.push_back({id, {0, 0, 0}});
        }
        wire::Datagram datagram;
        datagram.body = std::move(body);
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        return Case(datagram);
    };
    // 513 is point 1 of segment 2, in revision E point 13 of segment 5.
    EXPECT_TRUE(matches(points({257, 513}), "segment == 2"));
    EXPECT_FALSE(matches(points({257, 513}), "segment == 5"));
    EXPECT_TRUE(matches(points({101, 513}), "segment == 5 && id == 513"));
    EXPECT_FALSE(matches(points({101, 513}), "segment == 2"));
    EXPECT_TRUE(matches(points({101, 1502}), "segment == LeftHand"));
}

TEST(Filter, NamesPointsJointsAndTrackers) {
    const auto points = [](std::uint32_t first, std::uint32_t second) {
        wire::Datagram datagram{{}, wire::PointPositions{{{first, {}}, {second, {}}}}, {}};
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        return Case(datagram);
    };
    EXPECT_TRUE(matches(points(257, 269), "point == pSacrum && point == 269 && segment == Pelvis"));
    EXPECT_TRUE(matches(points(101, 113), "point == psacrum"));
    EXPECT_FALSE(matches(points(257, 258), "point == pSacrum"));
    EXPECT_FALSE(matches(points(257, 99'999), "point == pSacrum")) << "a tag";
    EXPECT_TRUE(matches(golden("13_null_pose_points"), "point == pSacrum or point == pHipOrigin"));

    wire::JointAngles angles;
    for (const model::JointDefinition& joint : model::jointDefinitions()) {
        const auto numberOf = [](const model::PointReference& end) {
            return model::encodePointId(model::PointIdCoding::By256, end);
        };
        angles.joints.push_back({numberOf(joint.parent), numberOf(joint.child), {1, 2, 3}});
    }
    wire::Datagram datagram{{}, angles, {}};
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    const Case whole(datagram);
    EXPECT_TRUE(
        matches(whole, "joint == jRightKnee && joint == 16 && child == jRightKnee && rotation.z == 3"));
    EXPECT_TRUE(matches(whole, "joint == jRightKnee && segment == RightLowerLeg"));
    EXPECT_FALSE(matches(whole, "joint == jRightKnee && child == jLeftKnee"));
    auto& joints = std::get<wire::JointAngles>(datagram.body).joints;
    joints.erase(joints.begin(), joints.begin() + 10);
    datagram.header.datagramCounter = 0x81;
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    EXPECT_TRUE(matches(Case(datagram), "joint == jRightKnee && child == jRightKnee")) << "a later part";

    EXPECT_TRUE(matches(golden("23_trackers_68_counted"), "segment == Pelvis"));
    EXPECT_TRUE(Filter::compile("point == pSacrun").error().text.ends_with("did you mean `pSacrum`?"));
}

TEST(Filter, CountsTheItemsOfEachList) {
    EXPECT_TRUE(matches(golden("02_quaternion_counted"), "segments.count > 0 && segments.count <= 67"));
    wire::PropInformation props;
    props.props = {{24, "Sword"}, {25, "Shield"}};
    wire::Datagram datagram;
    datagram.body = props;
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    EXPECT_TRUE(matches(Case(datagram), "props.count == 2"));
    EXPECT_FALSE(matches(Case(datagram), "props.count == 1"));
}

TEST(Filter, IsFalseAboutFieldsThatAreNotThere) {
    const Case packet = golden("12_metadata_counted");
    for (const char* text :
         {"position.z == 1", "position.z != 1", "position", "segment == Pelvis", "delta > 0", "delta != 0"}) {
        EXPECT_FALSE(matches(packet, text)) << text;
    }
    EXPECT_TRUE(matches(packet, "!(position.z == 1)"));
    EXPECT_FALSE(matches(golden("24_centre_12_counted"), "velocity"));
    EXPECT_TRUE(matches(golden("24_centre_36_counted"), "velocity && position"));
    EXPECT_FALSE(matches(golden("23_trackers_44_counted"), "angularVelocity"));
    EXPECT_TRUE(matches(golden("23_trackers_68_counted"), "angularVelocity"));
}

TEST(Filter, ComparesNothingWithNan) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Case packet = pose({{0, nan, 1}});
    EXPECT_FALSE(
        matches(packet, "position.y == 0 || position.y != 0 || position.y < 1 || position.y in -9..9"));
    EXPECT_TRUE(matches(packet, "position.y == NaN"));
    EXPECT_TRUE(matches(packet, "position == NaN"));
    EXPECT_TRUE(matches(packet, "position.x != NaN"));
    EXPECT_FALSE(matches(packet, "position.x == NaN"));
    EXPECT_TRUE(matches(packet, "notice == notFinite"));
}

TEST(Filter, RoundsConstantsAsTheWireDoes) {
    const Case packet = pose({{0.1F, -1e-5F, 0}});
    EXPECT_TRUE(matches(packet, "position.x == 0.1"));
    EXPECT_TRUE(matches(packet, "position.x <= 0.1 && position.y == -1e-5"));
    EXPECT_FALSE(matches(packet, "position.x != 0.1"));
}

TEST(Filter, ReadsMetadataTags) {
    wire::Datagram datagram;
    datagram.body = wire::MetaData{true, "name:Anna Berg\nxmid:00130\ncolor:ff0000\n"};
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    const Case packet(datagram);
    for (const char* text : {"tag", "tag == \"name\"", "tag == color", "tag.name contains \"ann\"",
                             "tag.name matches \"^Anna\"", "tag.xmid == \"00130\"", "tag.name",
                             "text contains \"Berg\"", "tag.name in {\"Anna Berg\", \"Bo\"}"}) {
        EXPECT_TRUE(matches(packet, text)) << text;
    }
    for (const char* text : {"tag == \"count\"", "tag.count", "tag.name == \"Anna\"",
                             "tag.color contains \"b\"", "tag.name matches \"^anna\""}) {
        EXPECT_FALSE(matches(packet, text)) << text;
    }
}

TEST(Filter, KnowsWhereAPacketCameFrom) {
    const Case packet = golden("02_quaternion_counted");
    for (const char* text : {"source == \"192.168.1.20:4001\"", "source == 192.168.1.20:4001",
                             "source contains \"168.1\"", "source matches \"^192\\.168\\..*:4001$\"",
                             "transport == udp", "transport in {udp, tcp}", "port == 9763", "number == 41",
                             "time == 2.5", "utc > \"2026-01-31\"", "utc < \"2100-01-01T00:00:00Z\""}) {
        EXPECT_TRUE(matches(packet, text)) << text;
    }
    EXPECT_FALSE(matches(packet, "transport == tcp || port == 1 || source == \"192.168.1.2\""));
}

TEST(Filter, KnowsWhatADigestKnows) {
    Case packet = golden("02_quaternion_counted");
    EXPECT_FALSE(matches(packet, "gap || duplicate || reordered || restart || drops || error || malformed"));
    packet.digest.gap = 2;
    packet.digest.isDuplicate = true;
    packet.digest.deltaS = 0.25F;
    packet.packet.kernelDropsBefore = 7;
    EXPECT_TRUE(matches(packet, "gap && gap == 2 && duplicate && delta > 0.1 && drops == 7 && problem"));
    EXPECT_TRUE(matches(packet, "duplicate == true && reordered == false"));
    EXPECT_FALSE(matches(packet, "duplicate == false"));
}

TEST(Filter, KnowsWhyAPacketCannotBeRead) {
    auto bytes = posewire::test::golden("02_quaternion_reserved").bytes;
    bytes.resize(100);
    const Case packet(bytes);
    ASSERT_TRUE(packet.fault);
    EXPECT_TRUE(matches(packet, "error && malformed && type == 2 && size == 100"));
    EXPECT_TRUE(matches(packet, "error == \"itemsTruncated\""));
    EXPECT_TRUE(matches(packet, "error contains truncated && error != badMagic"));
    EXPECT_FALSE(matches(packet, "foreign || position.z > -99"));
    const Case foreign(std::vector<std::byte>(30, std::byte{7}));
    EXPECT_TRUE(matches(foreign, "foreign && error == badMagic && !malformed"));
    EXPECT_FALSE(matches(foreign, "type == 0 || sample == 0 || character == 0"));
}

TEST(Filter, TellsFieldsOfOneNameApartByTheirConstant) {
    const Case packet = golden("25_time_code_counted");
    const auto& text = std::get<wire::TimeCode>(packet.datagram.body);
    EXPECT_TRUE(matches(packet, "timeCode == \"" + std::string(text.view()) + "\""));
    EXPECT_TRUE(matches(packet, "wire.timeCode == " + std::to_string(packet.datagram.header.timeCode)));
}

TEST(Filter, BindsAndTighterThanOr) {
    const Case packet = golden("02_quaternion_counted");
    EXPECT_TRUE(matches(packet, "type == 2 || type == 3 && size == 0"));
    EXPECT_FALSE(matches(packet, "(type == 2 || type == 3) && size == 0"));
    EXPECT_TRUE(matches(packet, "!type == 3 && type == 2"));
}

TEST(Filter, AnswersHostileExpressionsInLinearTime) {
    wire::Datagram datagram;
    datagram.body = wire::MetaData{true, "name:" + std::string(50'000, 'a') + "\n"};
    wire::completeHeader(datagram, wire::HeaderEra::Reserved);
    EXPECT_FALSE(matches(Case(datagram), "text matches \"(a*)*(a|aa)+b$\""));
}

} // namespace
} // namespace posewire::filter::test
