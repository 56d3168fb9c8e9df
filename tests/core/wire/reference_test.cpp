// SPDX-License-Identifier: MIT
#include "core/wire/reference.h"

#include "core/wire/codec.h"
#include "core/wire/type_table.h"

#include <gmock/gmock.h>

namespace posewire::wire {
namespace {

using testing::HasSubstr;

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

} // namespace
} // namespace posewire::wire
