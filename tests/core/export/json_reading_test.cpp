// SPDX-License-Identifier: MIT
#include "core/export/json.h"
#include "core/wire/codec.h"
#include "tests/support/golden.h"

#include <gtest/gtest.h>

namespace posewire::exporting {
namespace {

using Kind = JsonFault::Kind;

std::string faultOf(std::string_view line) {
    const auto bytes = datagramFromJson(line);
    EXPECT_FALSE(bytes) << line;
    return bytes ? "" : bytes.error().text;
}

TEST(DatagramFromJson, NeedsOnlyTypeAndBody) {
    const auto bytes = datagramFromJson(
        R"({"type":"02","body":{"segments":[{"id":1,"position":[0,1,2.5],"orientation":[1,0,0,0]}]}})");
    ASSERT_TRUE(bytes) << bytes.error().text;
    const auto datagram = wire::decode(*bytes);
    ASSERT_TRUE(datagram);
    EXPECT_EQ(datagram->header.items, 1);
    EXPECT_EQ(datagram->header.payloadSize, 32);
    EXPECT_EQ(datagram->header.datagramCounter, 0x80);
    EXPECT_EQ(std::get<wire::PoseQuaternion>(datagram->body).segments[0].position, (wire::Vec3{0, 1, 2.5F}));
}

TEST(DatagramFromJson, PutsALengthBeforeTextsUnlessTheSizeSaysOtherwise) {
    const std::string body = R"("body":{"timeCode":"01:02:03.004"}})";
    EXPECT_EQ(datagramFromJson(R"({"type":"25",)" + body)->size(), 40U);
    EXPECT_EQ(datagramFromJson(R"({"type":"25","size":40,)" + body)->size(), 40U);
    EXPECT_EQ(datagramFromJson(R"({"type":"25","size":36,)" + body)->size(), 36U);
    EXPECT_EQ(datagramFromJson(R"({"type":"25","payloadSize":0,)" + body)->size(), 36U);
    EXPECT_EQ(datagramFromJson(R"({"type":"25","size":40,"payloadSize":0,)" + body)->size(), 40U);
    const std::string tags = R"("body":{"tags":[["name","x"]]}})";
    EXPECT_EQ(datagramFromJson(R"({"type":"12",)" + tags)->size(), 24U + 4 + 7);
    EXPECT_EQ(datagramFromJson(R"({"type":"12","size":31,)" + tags)->size(), 24U + 7);
    EXPECT_EQ(datagramFromJson(R"({"type":"12","payloadSize":0,)" + tags)->size(), 24U + 7);
}

TEST(DatagramFromJson, TakesTheFormOfTrackersAndCentreFromTheirKeys) {
    EXPECT_EQ(datagramFromJson(R"({"type":"24","body":{"position":[1,2,3]}})")->size(), 24U + 12);
    EXPECT_EQ(datagramFromJson(R"({"type":"23","body":{"trackers":[]}})")->size(), 24U);
    EXPECT_EQ(datagramFromJson(R"({"type":"23","body":{"trackers":[{"id":1,"orientation":[1,0,0,0],)"
                               R"("freeAcceleration":[0,0,0],"magneticField":[1,0,0]}]}})")
                  ->size(),
              24U + 44);
}

TEST(DatagramFromJson, NamesThePlaceOfTheFault) {
    EXPECT_EQ(faultOf(R"({"body":{}})"), "type: is missing");
    EXPECT_EQ(faultOf(R"({"type":"2x","body":{}})"), "type: needs two digits, such as \"02\"");
    EXPECT_EQ(faultOf(R"({"type":2,"body":{}})"), "type: needs a string of 2 characters");
    EXPECT_EQ(faultOf(R"({"type":"02"})"), "body: needs an object in braces");
    EXPECT_EQ(faultOf(R"({"type":"02","body":{}})"), "body.segments: needs a list");
    EXPECT_EQ(faultOf(R"({"type":"02","items":256,"body":{"segments":[]}})"),
              "items: needs a whole number from 0 to 255");
    EXPECT_EQ(faultOf(R"({"type":"02","items":-1,"body":{"segments":[]}})"),
              "items: needs a whole number from 0 to 255");
    EXPECT_EQ(faultOf(R"({"type":"02","datagram":128,"body":{"segments":[]}})"),
              "datagram: needs a whole number from 0 to 127");
    EXPECT_EQ(faultOf(R"({"type":"02","last":1,"body":{"segments":[]}})"), "last: needs true or false");
    EXPECT_EQ(faultOf(R"({"type":"03","body":{"points":[{"id":1,"position":[0,0,0]},{"id":1}]}})"),
              "body.points[1].position: is missing");
    EXPECT_EQ(faultOf(R"({"type":"03","body":{"points":[{"id":1,"position":[0,0]}]}})"),
              "body.points[0].position: needs 3 numbers in brackets");
    EXPECT_EQ(faultOf(R"({"type":"03","body":{"points":[{"id":1,"position":[0,"nan",0]}]}})"),
              "body.points[0].position[1]: needs a number, or \"NaN\", \"Infinity\" or \"-Infinity\"");
    EXPECT_EQ(faultOf(R"({"type":"03","body":{"points":[7]}})"), "body.points[0]: needs an object in braces");
    EXPECT_EQ(faultOf(R"({"type":"12","body":{"tags":[["name"]]}})"),
              "body.tags: needs a list of [name, value] pairs");
    EXPECT_EQ(faultOf(R"({"type":"77","body":{"raw":"0g"}})"),
              "body.raw: needs two hexadecimal digits for each byte");
    EXPECT_EQ(faultOf(R"({"type":"77","body":{}})"), "body.raw: is missing");
    EXPECT_EQ(faultOf(R"({"type":"25","body":{"timeCode":"1:2"}})"),
              "body.timeCode: needs a string of 12 characters");
    EXPECT_EQ(faultOf(R"({"bytes":"123"})"), "bytes: needs two hexadecimal digits for each byte");
}

TEST(DatagramFromJson, TellsFaultsOfFormFromObjectsWithoutADatagram) {
    for (const char* line : {"", "{", "7", "[]", "null", "{} {}", "{\"type\":\"02\"", "\xff"}) {
        EXPECT_EQ(datagramFromJson(line).error().kind, Kind::NotJson) << line;
    }
    EXPECT_EQ(datagramFromJson(skippedJson({}, 5)).error().kind, Kind::NotDatagram);
    EXPECT_EQ(datagramFromJson(datagramJson({}, {})).error().kind, Kind::NotDatagram);
    EXPECT_EQ(datagramFromJson(R"({"type":"02"})").error().kind, Kind::BadField);
}

TEST(DatagramFromJson, RefusesListsThatNoDatagramHolds) {
    std::string line = R"({"type":"03","body":{"points":[)";
    for (int i = 0; i < 256; ++i) {
        line += std::string(i == 0 ? "" : ",") + R"({"id":1,"position":[0,0,0]})";
    }
    const std::string fault = faultOf(line + "]}}");
    EXPECT_NE(fault.find("says 256 items, has room for 255"), std::string::npos) << fault;
}

TEST(DatagramFromJson, SurvivesALineCutAnywhere) {
    const std::string line = datagramJson({}, posewire::test::golden("13_null_pose_reserved").bytes);
    for (std::size_t length = 0; length < line.size(); ++length) {
        EXPECT_FALSE(datagramFromJson(std::string_view(line).substr(0, length))) << length;
    }
}

TEST(DatagramFromJson, SurvivesDeepNesting) {
    EXPECT_FALSE(datagramFromJson(std::string(200000, '[')));
    EXPECT_FALSE(datagramFromJson(std::string(200000, '[') + std::string(200000, ']')));
}

} // namespace
} // namespace posewire::exporting
