// SPDX-License-Identifier: MIT
#include "core/export/json.h"
#include "core/wire/byte_order.h"
#include "core/wire/codec.h"
#include "tests/support/golden.h"
#include "tests/support/paths.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <bit>

namespace posewire::exporting {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::vector<std::byte> withWord(const std::string& name, std::size_t place, std::uint32_t word) {
    std::vector<std::byte> bytes = posewire::test::golden(name).bytes;
    wire::store32(bytes.data() + place, word);
    return bytes;
}

std::string jsonOf(const std::vector<std::byte>& bytes) {
    return datagramJson({}, bytes);
}

TEST(DatagramJson, IsWordForWordWhatTheGoldensExpect) {
    for (const auto& golden : posewire::test::goldens()) {
        const auto expected =
            posewire::test::readBytes(posewire::test::sourcePath("tests/golden/" + golden.name + ".json"));
        ASSERT_FALSE(expected.empty()) << golden.name;
        const std::string text(reinterpret_cast<const char*>(expected.data()), expected.size());
        EXPECT_EQ(jsonOf(golden.bytes) + "\n", text) << golden.name;
    }
}

TEST(DatagramJson, SaysWhereTheDatagramWasFound) {
    const DatagramPlace place{7, 4096, log::WallTime(log::Duration(1700000000123456789)), "10.0.0.2:40001"};
    EXPECT_THAT(datagramJson(place, posewire::test::golden("24_centre_12_counted").bytes),
                StartsWith(R"({"index":7,"offset":4096,"size":36,"stampNs":1700000000123456789,)"
                           R"("source":"10.0.0.2:40001","type":"24",)"));
}

TEST(DatagramJson, WritesFloatsThatReadBackToTheSame32Bits) {
    const std::vector<std::pair<std::uint32_t, std::string>> values{
        {0x3dcccccd, "0.1"},           {0x80000000, "-0.0"},         {0x00000001, "1e-45"},
        {0x7f7fffff, "3.4028235e+38"}, {0x7fc00000, "\"NaN\""},      {0x7f800000, "\"Infinity\""},
        {0xff800000, "\"-Infinity\""}, {0x4b800000, "1.6777216e+07"}};
    for (const auto& [bits, text] : values) {
        const auto bytes = withWord("24_centre_12_counted", 24, bits);
        const std::string json = jsonOf(bytes);
        EXPECT_THAT(json, HasSubstr("\"position\":[" + text + ",-1.5,0.25]"));
        EXPECT_THAT(json, Not(HasSubstr("\"bytes\"")));
        EXPECT_EQ(*datagramFromJson(json), bytes);
    }
}

TEST(DatagramJson, WritesFloatsAsDocumentsAreDumped) {
    using Floats = nlohmann::basic_json<nlohmann::ordered_map, std::vector, std::string, bool, std::int64_t,
                                        std::uint64_t, float>;
    constexpr std::uint32_t kInfinity = 0x7f800000;
    std::uint32_t bits = 0;
    for (int i = 0; i < 200'000; ++i) {
        bits = bits * 1'664'525 + 1'013'904'223;
        // Every size, and half of them with few bits: 30619.0625 has two shortest numbers that are as near.
        const std::uint32_t word = i % 2 == 0 ? bits : bits & 0xffffff00;
        if ((word & kInfinity) != kInfinity) {
            const std::string dumped = Floats(std::bit_cast<float>(word)).dump();
            const std::string json = jsonOf(withWord("24_centre_12_counted", 24, word));
            ASSERT_THAT(json, HasSubstr("\"position\":[" + dumped + ",-1.5,0.25]"));
        }
    }
}

TEST(DatagramJson, KeepsTheWholeDatagramWhereTheValuesWouldNotGiveItBack) {
    const std::vector<std::vector<std::byte>> odd{
        withWord("24_centre_12_counted", 24, 0x7fc00001),      // another NaN
        withWord("24_centre_12_counted", 20, 0x0100000c),      // reserved bytes in use
        withWord("25_time_code_counted", 28, 0xfffefdfc),      // not UTF-8
        withWord("12_metadata_counted", 28 + 42, 0x62626262)}; // no newline at the end
    for (const auto& bytes : odd) {
        const std::string json = jsonOf(bytes);
        EXPECT_THAT(json, HasSubstr("],\"bytes\":\"4d58545"));
        EXPECT_EQ(*datagramFromJson(json), bytes);
    }
}

TEST(DatagramJson, HasNamesBesideIdsWhereTheyAreAskedFor) {
    const auto named = [](const std::string& name) {
        const auto& bytes = posewire::test::golden(name).bytes;
        const std::string json = datagramJson({}, bytes, {.hasNames = true});
        EXPECT_EQ(*datagramFromJson(json), bytes) << "names change no bytes";
        return json;
    };
    EXPECT_THAT(named("02_quaternion_counted"), HasSubstr(R"(],"name":"RightUpperArm"})"));
    EXPECT_THAT(named("01_euler_counted"), HasSubstr(R"("name":"Pelvis"})"));
    EXPECT_THAT(named("05_unity_counted"), HasSubstr(R"("name":"Pelvis"})"));
    EXPECT_THAT(named("03_points_counted"), HasSubstr(R"("name":"p)"));
    EXPECT_THAT(named("20_joints_counted"), HasSubstr(R"("name":"j)"));
    EXPECT_THAT(named("23_trackers_68_counted"), HasSubstr(R"("name":"Pelvis"})"));
    EXPECT_THAT(named("04_tags_counted"), Not(HasSubstr("\"name\"")));
    EXPECT_EQ(named("13_null_pose_points"), jsonOf(posewire::test::golden("13_null_pose_points").bytes));
}

TEST(DatagramJson, HasAnErrorInsteadOfABody) {
    const auto& whole = posewire::test::golden("24_centre_12_counted").bytes;
    const std::vector<std::byte> cut(whole.begin(), whole.end() - 2);
    EXPECT_EQ(
        jsonOf(cut),
        R"_({"index":0,"offset":0,"size":34,"stampNs":null,"source":null,"type":"24","sample":16909060,)_"
        R"_("datagram":0,"last":true,"items":1,"timeCode":27837,"character":3,"bodySegments":23,"props":0,)_"
        R"_("fingerSegments":0,"payloadSize":12,"error":{"code":"payloadTruncated","offset":34,"need":36,)_"
        R"_("have":34,"text":"shorter than its header announces (byte 34: needs 36 bytes, has 34)"},)_"
        R"_("notices":[]})_");
}

TEST(DatagramJson, KeepsTheHeaderFieldsThatCouldBeRead) {
    const auto& whole = posewire::test::golden("02_quaternion_counted").bytes;
    const auto cutAt = [&](std::size_t size) { return jsonOf({whole.begin(), whole.begin() + size}); };
    EXPECT_THAT(cutAt(5), HasSubstr(R"("source":null,"error":{"code":"headerTruncated")"));
    EXPECT_THAT(cutAt(6), HasSubstr(R"("source":null,"type":"02","error":)"));
    EXPECT_THAT(cutAt(13), HasSubstr(R"("last":true,"items":23,"error":)"));
    EXPECT_THAT(cutAt(23), HasSubstr(R"("fingerSegments":0,"error":)"));
}

TEST(DatagramJson, ShowsForeignBytesAsAnErrorWithoutAHeader) {
    const std::string_view text = R"({"type":"transport","value":"record"})";
    EXPECT_THAT(
        datagramJson({}, std::as_bytes(std::span(text))),
        StartsWith(
            R"({"index":0,"offset":0,"size":37,"stampNs":null,"source":null,"error":{"code":"badMagic")"));
}

TEST(DatagramJson, KeepsATextWithControlCharactersOnOneLine) {
    wire::Datagram datagram;
    datagram.body = wire::MetaData{true, std::string("name:a\0\t\"\\\n", 11)};
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    const auto bytes = *wire::encode(datagram);
    EXPECT_THAT(jsonOf(bytes), HasSubstr(R"({"tags":[["name","a\u0000\t\"\\"]]})"));
    EXPECT_EQ(*datagramFromJson(jsonOf(bytes)), bytes);
}

TEST(SkippedJson, IsWordForWordAsPromised) {
    EXPECT_EQ(skippedJson({3, 1000, {}, {}}, 17), R"({"index":3,"offset":1000,"size":17,"skipped":true})");
}

} // namespace
} // namespace posewire::exporting
