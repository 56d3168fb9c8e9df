// SPDX-License-Identifier: MIT
#include "core/model/session/metadata.h"

#include "core/wire/messages.h"

#include <gtest/gtest.h>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

TEST(Metadata, KeepsTagsThatALaterPacketDoesNotRepeat) {
    Metadata metadata;
    metadata.add({true, "name:Ana\ncolor:2f72c4\n"}, 1, log::Stamp(100ns));
    metadata.add({true, "xmid:00B42C51\n"}, 2, log::Stamp(200ns));
    EXPECT_EQ(metadata.value("name", 2), "Ana");
    EXPECT_EQ(metadata.value("xmid", 2), "00B42C51");
    EXPECT_EQ(metadata.value("xmid", 1), "");
}

TEST(Metadata, RemembersEachChangeWithItsPacket) {
    Metadata metadata;
    metadata.add({true, "name:Ana\n"}, 1, log::Stamp(100ns));
    metadata.add({true, "name:Ana\n"}, 5, log::Stamp(500ns));
    metadata.add({true, "name:Bo\n"}, 9, log::Stamp(900ns));
    const MetadataTag* tag = metadata.find("name");
    ASSERT_EQ(tag->values.size(), 2U);
    EXPECT_EQ(tag->at(8)->text, "Ana");
    EXPECT_EQ(tag->at(9)->text, "Bo");
    EXPECT_EQ(tag->lastSeen, log::Stamp(900ns));
}

TEST(Metadata, MarksTagsThatAreNotKnown) {
    Metadata metadata;
    metadata.add({true, "name:a:b\nshoeSize:42\n"}, 1, log::Stamp(1ns));
    EXPECT_EQ(metadata.value("name", 1), "a:b");
    EXPECT_TRUE(metadata.find("name")->isKnown);
    EXPECT_FALSE(metadata.find("shoeSize")->isKnown);
}

TEST(Metadata, StaysBoundedWhateverIsSent) {
    Metadata metadata;
    for (std::uint64_t i = 0; i < 2'000; ++i) {
        metadata.add({true, "tag" + std::to_string(i) + ":x\nname:" + std::to_string(i) + "\n"}, i, {});
    }
    EXPECT_EQ(metadata.tags().size(), Metadata::kMaxTags);
    EXPECT_EQ(metadata.find("name")->values.size(), Metadata::kMaxValues);
    EXPECT_EQ(metadata.find("name")->dropped, 2000 - Metadata::kMaxValues);
    EXPECT_EQ(metadata.find("tag1999"), nullptr);
    EXPECT_EQ(metadata.value("name", 1'999), "1999");
}

TEST(ParseColour, IsTheInverseOfItsText) {
    for (const char* text : {"#000000", "#e96417", "#ffffff"}) {
        EXPECT_EQ(colourText(parseColour(text).value()), text);
    }
    EXPECT_EQ(colourText({-1, 0.5F, 2}), "#0080ff");
}

TEST(ParseColour, ReadsSixHexadecimalDigitsOnly) {
    ASSERT_TRUE(parseColour("e96417").has_value());
    EXPECT_NEAR(parseColour("#e96417")->green, 0x64 / 255.0, 1e-6);
    for (const char* bad : {"", "e9641", "e964170", "e9641g", "0xe964", "-96417"}) {
        EXPECT_FALSE(parseColour(bad).has_value()) << bad;
    }
}

} // namespace
} // namespace posewire::model
