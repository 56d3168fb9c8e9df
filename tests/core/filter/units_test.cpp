// SPDX-License-Identifier: MIT
#include "core/field/field.h"
#include "core/filter/completion.h"
#include "tests/core/filter/filter_fixture.h"

#include <gmock/gmock.h>

namespace posewire::filter::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

Case packetWith(wire::Body body, std::uint32_t timeCode = 0) {
    wire::Datagram datagram;
    datagram.body = std::move(body);
    datagram.header.timeCode = timeCode;
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    return Case(datagram);
}

Case eulerPose(const wire::Vec3& position, const wire::Vec3& rotation = {}) {
    return packetWith(wire::PoseEuler{{{1, position, rotation}}});
}

std::string errorOf(std::string_view text) {
    const auto filter = Filter::compile(text);
    return filter ? std::string()
                  : std::string(text.substr(filter.error().offset, filter.error().length)) + '|' +
                        filter.error().text;
}

TEST(FilterUnits, ComparesCentimetresAndMetresInMetres) {
    const Case centimetres = eulerPose({0, 0, 107});
    const Case metres = pose({{0, 0, 1.07F}});
    for (const Case* packet : {&centimetres, &metres}) {
        for (const char* text :
             {"position.z > 1.0", "position.z == 1.07", "position.z < 2", "position.z > 1 m",
              "position.z > 100 cm", "position.z > 100cm", "position.z == 1070 mm", "position.z in 1..2 m",
              "position.z in 100..110 cm", "position.z in {7, 1 m..110 cm}", "segments.position.z != 1"}) {
            EXPECT_TRUE(matches(*packet, text)) << text;
        }
        for (const char* text : {"position.z > 2", "position.z > 107 cm", "position.z > 1.07",
                                 "position.z in 1..2 cm", "position.z < 100 cm"}) {
            EXPECT_FALSE(matches(*packet, text)) << text;
        }
    }
}

TEST(FilterUnits, ReachesTheNumberAsItWasSent) {
    EXPECT_TRUE(matches(eulerPose({0, 0, 107}), "wire.position.z == 107 && wire.segments.position.z > 100"));
    EXPECT_FALSE(matches(pose({{0, 0, 1.07F}}), "wire.position.z > 100"));
    const Case packet = packetWith(wire::PoseQuaternion{}, 27'837);
    EXPECT_TRUE(
        matches(packet, "wire.timeCode == 27837 && wire.header.timeCode == 27837 && wire.sample == 0"));
    EXPECT_THAT(errorOf("wire.time > 1"), HasSubstr("There is no field `wire.time`; did you mean `time`?"));
    EXPECT_THAT(errorOf("wire.postion.z > 1"), HasSubstr("did you mean `wire.position.z`?"));
}

TEST(FilterUnits, TakesTheUnitThatIsKnownOfASender) {
    const Case packet = pose({{0, 0, 107}});
    Candidate candidate = packet.candidate();
    candidate.positionUnit = model::LengthUnit::Centimetre;
    const auto asked = [&](const char* text) { return Filter::compile(text)->matches(candidate); };
    EXPECT_TRUE(asked("position.z == 1.07"));
    EXPECT_TRUE(asked("position.z < 108 cm && wire.position.z == 107"));
    EXPECT_FALSE(asked("position.z > 2"));
    const Case inMetres = eulerPose({0, 0, 1.5F});
    Candidate said{inMetres.packet, inMetres.digest, &inMetres.datagram};
    EXPECT_FALSE(Filter::compile("position.z > 1")->matches(said));
    said.positionUnit = model::LengthUnit::Metre;
    EXPECT_TRUE(Filter::compile("position.z > 1")->matches(said));
}

TEST(FilterUnits, KnowsWhetherThatUnitMattersToAFilter) {
    EXPECT_TRUE(Filter::compile("type == 2 && position.z > 1")->comparesLengths());
    for (const char* text : {"", "position", "wire.position.z > 1", "time > 1 s", "velocity.x > 1 m/s"}) {
        EXPECT_FALSE(Filter::compile(text)->comparesLengths()) << text;
    }
}

TEST(FilterUnits, ComparesTimesInSeconds) {
    Case packet = packetWith(wire::PoseQuaternion{}, 27'837);
    packet.digest.deltaS = 0.25F;
    for (const char* text :
         {"timeCode == 27.837", "header.timeCode == 27837 ms", "timeCode < 1 min", "timeCode in 27 s..28 s",
          "time == 2500 ms", "time == 2.5s", "delta == 250 ms", "delta > 100000 us", "delta > 0.2"}) {
        EXPECT_TRUE(matches(packet, text)) << text;
    }
    EXPECT_FALSE(matches(packet, "timeCode > 28"));
}

TEST(FilterUnits, ComparesAnglesInDegrees) {
    const Case euler = eulerPose({}, {90, 0, 0});
    EXPECT_TRUE(matches(euler, "rotation.x == 90 && rotation.x == 90 deg && rotation.x == 90°"));
    EXPECT_TRUE(matches(euler, "rotation.x > 1.57 rad && rotation.x < 1.58 rad"));
    const Case turning = packetWith(wire::AngularKinematics{{{1, {1, 0, 0, 0}, {3.2F, 0, 0}, {1, 0, 0}}}});
    EXPECT_TRUE(matches(turning, "angularVelocity.x > 180 && angularVelocity.x > 180 deg/s"));
    EXPECT_TRUE(matches(turning, "angularVelocity.x == 3.2 rad/s && wire.angularVelocity.x == 3.2"));
    EXPECT_TRUE(matches(turning, "angularAcceleration.x > 57 °/s² && angularAcceleration.x < 58 deg/s2"));
}

TEST(FilterUnits, KnowsVelocitiesAccelerationsAndSizes) {
    const Case packet = packetWith(wire::LinearKinematics{{{1, {}, {2, 0, 0}, {0, 0, 9.9F}}}});
    EXPECT_TRUE(matches(packet, "velocity.x == 2 m/s && velocity.x > 7 km/h && velocity.x == 200 cm/s"));
    EXPECT_TRUE(
        matches(packet, "acceleration.z > 1 g && acceleration.z > 9.8 m/s² && acceleration.z < 10 m/s2"));
    EXPECT_TRUE(matches(packet, "size < 1 kB && size > 20 bytes"));
}

TEST(FilterUnits, SaysWhereAUnitDoesNotFit) {
    EXPECT_EQ(errorOf("time > 1 m"), "m|`time` is a time: write s, ms, us, µs, min or h.");
    EXPECT_EQ(errorOf("gap && time > 1m"), "m|`time` is a time: write s, ms, us, µs, min or h.");
    EXPECT_EQ(errorOf("position.z in 1..2 s"), "s|`position.z` is a length: write m, cm or mm.");
    EXPECT_EQ(errorOf("position.z > 1 mile"), "mile|`position.z` is a length: write m, cm or mm.");
    EXPECT_EQ(errorOf("sample > 5 m"), "m|`sample` has no unit.");
    EXPECT_EQ(errorOf("type == 2 s"), "s|`type` has no unit.");
    EXPECT_EQ(errorOf("orientation.w > 1 m"), "m|`orientation.w` has no unit.");
    EXPECT_EQ(errorOf("source == 5 m"), "m|`source` has no unit.");
    EXPECT_EQ(errorOf("tag.name == 5 m"), "m|Tags are text and have no unit.");
    EXPECT_EQ(errorOf("wire.position.z > 1 m"), "m|`wire.position.z` is the number as sent: write no unit.");
    EXPECT_THAT(errorOf("time > 1 s 5"), HasSubstr("5|Expected `&&` or `||`"));
    EXPECT_THAT(errorOf("time > 1 gap"), HasSubstr("gap|Expected `&&` or `||`"));
    EXPECT_THAT(errorOf("position.z in 2 m..100 cm"), HasSubstr("ends before it begins"));
}

TEST(FilterUnits, LeavesWordsThatLookLikeThemAlone) {
    wire::Datagram datagram;
    datagram.body = wire::MetaData{true, "name:10m\n"};
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    EXPECT_TRUE(matches(Case(datagram), "tag.name == 10m && (tag.name == 10m)"));
    EXPECT_TRUE(matches(pose({{0, 0, 3}}), "(position.z > 1 m)&&position.z<4 m and size > 1"));
}

std::vector<std::string> offersAt(std::string text) {
    std::vector<std::string> found;
    for (const Completion& one : completions(text, text.size())) {
        found.push_back(one.text);
    }
    return found;
}

TEST(FilterUnits, AreOfferedAfterANumber) {
    EXPECT_THAT(offersAt("position.z > 1 "), IsSupersetOf({"m", "cm", "&&"}));
    EXPECT_EQ(offersAt("delta > 20 m"), (std::vector<std::string>{"ms", "min"}));
    EXPECT_THAT(offersAt("position.z in {1 "), IsSupersetOf({"cm", "}"}));
    EXPECT_THAT(offersAt("position.z > 1 m "), Not(Contains("cm")));
    EXPECT_THAT(offersAt("wire.position.z > 1 "), Not(Contains("cm")));
    EXPECT_THAT(offersAt("sample > 1 "), Not(Contains("m")));
    EXPECT_THAT(offersAt("pos"), IsSupersetOf({"position", "wire.position"}));
    EXPECT_THAT(offersAt("wire.position"), IsSupersetOf({"wire.position.x", "wire.position.z"}));
}

TEST(FilterUnits, StandInTheReference) {
    const std::string page = filterReference();
    EXPECT_THAT(page, HasSubstr("| a length | m, cm or mm |"));
    EXPECT_THAT(page, HasSubstr("| `timeCode` | number | s | ms |"));
    EXPECT_THAT(page, HasSubstr("| `segments.angularVelocity` | x, y, z | °/s | rad/s |"));
}

TEST(FilterUnits, OfAFieldAreThoseOfOneDimension) {
    for (const field::UnitInfo& unit : field::unitTable()) {
        EXPECT_EQ(field::findUnit(unit.symbol), &unit) << "written twice";
        EXPECT_NEAR(converted(converted(3, unit, unitsOf(unit.dimension).front()),
                              unitsOf(unit.dimension).front(), unit),
                    3, 1e-12)
            << unit.symbol;
    }
}

} // namespace
} // namespace posewire::filter::test
