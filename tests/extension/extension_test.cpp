// SPDX-License-Identifier: MIT
#include "core/export/json.h"
#include "core/export/protocol_reference.h"
#include "core/filter/filter.h"
#include "core/performer/performer.h"
#include "core/performer/sending.h"
#include "core/wire/codec.h"
#include "core/wire/field_tree.h"
#include "core/wire/header.h"
#include "core/wire/type_table.h"
#include "tests/support/golden.h"
#include "tests/support/paths.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace posewire {
namespace {

using testing::HasSubstr;

std::vector<std::byte> bytes() {
    return test::readHexadecimal(test::sourcePath("tests/extension/26_probes.hex"));
}

wire::Probe expected() {
    return {258, {{1, 22.5F, {1, -1.5F, 0.25F}, -2}, {22, -5, {0, 0, 2}, 3}}};
}

TEST(FurtherMessage, IsDecodedAndEncoded) {
    const auto datagram = wire::decode(bytes());
    ASSERT_TRUE(datagram);
    EXPECT_EQ(std::get<wire::Probe>(datagram->body), expected());
    EXPECT_TRUE(datagram->notices.empty());
    EXPECT_EQ(wire::encode(*datagram).value(), bytes());
    EXPECT_EQ(wire::datagramExtent(bytes(), false),
              (wire::Extent{wire::Extent::State::Known, bytes().size()}));
    for (std::size_t size = 24; size < bytes().size(); ++size) {
        EXPECT_FALSE(wire::decode(wire::Bytes(bytes()).first(size))) << size;
    }
}

TEST(FurtherMessage, IsFramedWithoutAPayloadSize) {
    std::vector<std::byte> older = bytes();
    std::fill(older.begin() + 17, older.begin() + 24, std::byte{0});
    EXPECT_EQ(wire::datagramExtent(older, false), (wire::Extent{wire::Extent::State::Known, older.size()}));
}

TEST(FurtherMessage, IsChecked) {
    std::vector<std::byte> odd = bytes();
    odd[24 + 2 + 4] = std::byte{0x7f};
    odd[24 + 2 + 5] = std::byte{0xc0};
    odd[24 + 2 + 24] = std::byte{1};
    EXPECT_EQ(wire::decode(odd)->notices,
              (std::vector<wire::Notice>{{wire::NoticeCode::NotFinite, 26, 1},
                                         {wire::NoticeCode::SegmentOutOfRange, 50, 1}}));
}

TEST(FurtherMessage, GoesThroughJson) {
    const std::string json = exporting::datagramJson({}, bytes());
    EXPECT_THAT(json, HasSubstr(R"("station":258,"readings":[{"id":1,"temperature":22.5,)"));
    EXPECT_THAT(json, HasSubstr(R"("level":-2})"));
    EXPECT_THAT(json, testing::Not(HasSubstr("\"bytes\"")));
    EXPECT_EQ(exporting::datagramFromJson(json).value(), bytes());
}

TEST(FurtherMessage, IsInTheReferences) {
    const std::string reference = exporting::protocolReference();
    EXPECT_THAT(reference,
                HasSubstr("| [26 Probes](#26-probes) | 24 | Z-up, right-handed | yes | N | P 1 |"));
    EXPECT_THAT(reference, HasSubstr("\n## 26 Probes\n"));
    EXPECT_THAT(reference, HasSubstr("| 4 | 4 | temperature | float32 | a.u. | of the air | P 1.2 |"));
    EXPECT_THAT(filter::filterReference(), HasSubstr("temperature"));
}

TEST(FurtherMessage, IsFiltered) {
    const std::vector<std::byte> held = bytes();
    log::Packet packet;
    packet.bytes = held;
    const auto datagram = wire::decode(held);
    model::PacketDigest digest;
    digest.type = wire::Probe::kType;
    const filter::Candidate candidate{packet, digest, &*datagram};
    for (const char* text : {"type == 26 && temperature > 22", "level < -1", "wind.z == 2", "readings == 2",
                             "segment == LeftFoot", "type == \"Probes\"", "station == 258"}) {
        EXPECT_TRUE(filter::Filter::compile(text)->matches(candidate)) << text;
    }
    for (const char* text : {"type == 26 && temperature > 23", "segment == LeftToe", "level == 0"}) {
        EXPECT_FALSE(filter::Filter::compile(text)->matches(candidate)) << text;
    }
}

TEST(FurtherMessage, HasAFieldTree) {
    const std::vector<std::byte> held = bytes();
    const wire::FieldTree tree = wire::fieldTree(held, wire::FieldDetail::Parts);
    const auto node = std::find_if(tree.nodes.begin(), tree.nodes.end(),
                                   [](const wire::FieldNode& one) { return one.name == "temperature"; });
    ASSERT_NE(node, tree.nodes.end());
    EXPECT_EQ(node->offset, 30U);
    EXPECT_EQ(node->value, "22.5");
    EXPECT_EQ(node->scalar, wire::Scalar::Float32);
    EXPECT_EQ(tree.path(static_cast<std::int32_t>(node - tree.nodes.begin())), "readings[0].temperature");
    std::size_t told = 0;
    for (const wire::FieldNode& leaf : wire::fieldTree(held).nodes) {
        told += leaf.kind == wire::NodeKind::Field ? leaf.length : 0;
    }
    EXPECT_EQ(told, held.size());
}

TEST(FurtherMessage, IsPerformedSplitAndJoined) {
    performer::PerformerSettings settings;
    settings.characters = 1;
    EXPECT_THAT(performer::typesOf(settings.revision), testing::Contains(wire::Probe::kType));
    settings.types = {wire::Probe::kType};
    ASSERT_EQ(performer::findProblem(settings), std::nullopt);
    const auto datagrams = performer::Performer(settings).frame(240);
    ASSERT_EQ(datagrams.size(), 1U);
    EXPECT_EQ(std::get<wire::Probe>(datagrams[0].body).readings[0].temperature, 21.0F);

    const auto parts = performer::splitSample(wire::encode(datagrams[0]).value(), 3);
    ASSERT_EQ(parts.size(), 3U);
    wire::Datagram whole = wire::decode(parts[0]).value();
    for (std::size_t part = 1; part < parts.size(); ++part) {
        wire::appendPart(whole, wire::decode(parts[part]).value());
    }
    EXPECT_EQ(std::get<wire::Probe>(whole.body), std::get<wire::Probe>(datagrams[0].body));
}

TEST(FurtherMessage, IsKnownBySchema) {
    EXPECT_TRUE(wire::countsSegments(wire::Probe::kType));
    EXPECT_EQ(wire::typeTable().back().type, wire::Probe::kType);
}

} // namespace
} // namespace posewire
