// SPDX-License-Identifier: MIT
#include "core/export/protocol_reference.h"

#include "core/wire/type_table.h"

#include <gmock/gmock.h>

namespace posewire::exporting {
namespace {

using testing::HasSubstr;
using wire::TypeInfo;
using wire::typeTable;
using wire::typeTitle;

std::string sectionOf(std::uint8_t type) {
    const std::string reference = protocolReference();
    const std::size_t start = reference.find("\n## " + typeTitle(type) + "\n");
    EXPECT_NE(start, std::string::npos) << typeTitle(type);
    const std::size_t end = reference.find("\n## ", start + 4);
    return start == std::string::npos ? std::string() : reference.substr(start, end - start);
}

TEST(ProtocolReference, HasASectionForEveryType) {
    for (const TypeInfo& info : typeTable()) {
        EXPECT_THAT(sectionOf(info.type), HasSubstr("Section " + std::string(info.section)));
    }
}

TEST(ProtocolReference, HasTheTotalsOfTheSpecification) {
    const std::vector<std::pair<std::uint8_t, std::string>> totals{
        {1, "28"},  {2, "32"},  {3, "16"},  {4, "16"},  {5, "32"}, {10, "52"},
        {20, "20"}, {21, "40"}, {22, "44"}, {23, "68"}, {23, "44"}};
    for (const auto& [type, total] : totals) {
        EXPECT_THAT(sectionOf(type), HasSubstr("Each item, " + total + " bytes:"));
    }
}

TEST(ProtocolReference, ShowsEveryFieldOfTheHeaderAtItsOffset) {
    const std::string reference = protocolReference();
    EXPECT_THAT(reference, HasSubstr("| 0 | 6 | id | characters |"));
    EXPECT_THAT(reference, HasSubstr("| 6 | 4 | sample | uint32 |"));
    EXPECT_THAT(reference, HasSubstr("| 10 | 1 | datagramCounter | uint8 |"));
    EXPECT_THAT(reference, HasSubstr("| 12 | 4 | timeCode | uint32 | ms |"));
    EXPECT_THAT(reference, HasSubstr("| 22 | 2 | payloadSize | uint16 | bytes |"));
}

TEST(ProtocolReference, ShowsUnitsAndBothForms) {
    EXPECT_THAT(sectionOf(1), HasSubstr("| 4 | 12 | position | 3 × float32 | cm |"));
    EXPECT_THAT(sectionOf(2), HasSubstr("| 4 | 12 | position | 3 × float32 | m |"));
    EXPECT_THAT(sectionOf(23), HasSubstr("| 44 | 12 | angularVelocity | 3 × float32 | rad/s |"));
    EXPECT_THAT(sectionOf(24), HasSubstr("The short form:"));
    EXPECT_THAT(sectionOf(25), HasSubstr("Without the length:"));
    EXPECT_THAT(sectionOf(13), HasSubstr("uint32 count, then items (at most 4096)"));
}

std::string part(const std::string& heading) {
    const std::string reference = protocolReference();
    const std::size_t start = reference.find("\n## " + heading + "\n");
    EXPECT_NE(start, std::string::npos) << heading;
    return reference.substr(start, reference.find("\n## ", start + 4) - start);
}

TEST(ProtocolReference, ListsAllTypesInOneTableWithLinks) {
    const std::string overview = part("Overview");
    for (const TypeInfo& info : typeTable()) {
        const std::string title = typeTitle(info.type);
        EXPECT_THAT(overview, HasSubstr("| [" + title + "](#" + headingAnchor(title) + ") |"));
    }
    EXPECT_THAT(overview, HasSubstr("(#02-pose-quaternion) | 32 | Z-up, right-handed | yes | E–N |"));
    EXPECT_THAT(overview, HasSubstr("| 68 or 44 |"));
    EXPECT_THAT(overview, HasSubstr("| 36 in all or 12 in all |"));
}

TEST(ProtocolReference, TellsWhatDiffersBetweenRevisions) {
    const std::string differences = part("What differs between revisions");
    EXPECT_THAT(differences,
                HasSubstr("| header, bytes 17 to 23 | reserved, zero | reserved, zero | counts"));
    EXPECT_THAT(differences, HasSubstr("| type 23, bytes an item | – | 68 | 44 in the text"));
    EXPECT_THAT(differences, HasSubstr("| type 12 | the bare text |"));
    EXPECT_THAT(differences, testing::Not(HasSubstr("|  |"))); // a difference that says nothing
}

TEST(ProtocolReference, ExplainsTransportCountersAndTags) {
    EXPECT_THAT(part("Transport"), testing::AllOf(HasSubstr("9763"), HasSubstr("the sender connects")));
    EXPECT_THAT(part("Header"), testing::AllOf(HasSubstr("0, 1 and 0x82"), HasSubstr("q and −q")));
    EXPECT_THAT(sectionOf(12), HasSubstr("Known tags: `name` `xmid` `color`"));
}

TEST(ProtocolReference, ListsWhatTheIdentifiersStandFor) {
    EXPECT_THAT(part("Segments"), HasSubstr("| 22 | Left Foot | LeftFoot | Left Lower Leg | 8 |"));
    EXPECT_THAT(part("Fingers"), HasSubstr("| 24 | 44 | Carpus | hand |"));
    EXPECT_THAT(part("Points"), HasSubstr("| Pelvis | 13 | pSacrum | yes |"));
    EXPECT_THAT(part("Joints"), HasSubstr("| 1 | jL5S1 | 1.2 (258) | 2.1 (513) |"));
}

} // namespace
} // namespace posewire::exporting
