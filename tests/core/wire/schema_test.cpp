// SPDX-License-Identifier: MIT
#include "core/wire/type_table.h"

#include "tests/core/wire/generated_datagrams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace posewire::wire {
namespace {

using Kind = FieldRow::Kind;

struct ItemTotals {
    std::uint8_t type;
    std::size_t size; ///< 0 where it varies
    std::size_t least;
};
/// The specification's totals for the items of the messages that have one list.
constexpr std::array<ItemTotals, 11> kItems{{{1, 28, 28},
                                             {2, 32, 32},
                                             {3, 16, 16},
                                             {4, 16, 16},
                                             {5, 32, 32},
                                             {10, 52, 52},
                                             {11, 0, 5},
                                             {20, 20, 20},
                                             {21, 40, 40},
                                             {22, 44, 44},
                                             {23, 68, 68}}};

TEST(Schema, HasAllTypesInOrder) {
    EXPECT_TRUE(std::ranges::equal(typeTable(), test::kAllTypes, {}, &TypeInfo::type));
    for (const TypeInfo& row : typeTable()) {
        EXPECT_EQ(findType(row.type), &row);
    }
}

TEST(Schema, KnowsNoOtherTypes) {
    for (unsigned type = 0; type < 256; ++type) {
        const bool isKnown = std::ranges::find(test::kAllTypes, type) != test::kAllTypes.end();
        EXPECT_EQ(findType(static_cast<std::uint8_t>(type)) != nullptr, isKnown) << type;
    }
}

TEST(Schema, GivesItemsTheSizesOfTheSpecification) {
    for (const ItemTotals& totals : kItems) {
        const auto fields = findType(totals.type)->fields();
        ASSERT_EQ(fields.size(), 1U) << int{totals.type};
        EXPECT_EQ(fields[0].kind, Kind::Items);
        EXPECT_TRUE(fields[0].isList());
        EXPECT_EQ(fields[0].size, totals.size) << int{totals.type};
        EXPECT_EQ(fields[0].least, totals.least) << int{totals.type};
        std::size_t sum = 0;
        for (const FieldRow& field : fields[0].items) {
            sum += field.size;
        }
        EXPECT_EQ(sum, totals.size != 0 ? totals.size : 4) << int{totals.type};
    }
}

TEST(Schema, GivesTheHeaderItsElevenFieldsOf24Bytes) {
    std::size_t sum = 0;
    std::set<std::string_view> names;
    for (const FieldRow& field : headerRows()) {
        EXPECT_EQ(field.kind, Kind::Value);
        EXPECT_FALSE(field.isList());
        sum += field.size;
        names.insert(field.about.name);
    }
    EXPECT_EQ(sum, kHeaderSize);
    EXPECT_EQ(names.size(), 11U);
}

TEST(Schema, ListsTheOtherFormsOfTypesThatHaveThem) {
    const std::map<std::uint8_t, std::vector<std::pair<Form, std::size_t>>> sizes{
        {12, {{Form::Standard, 0}, {Form::Bare, 0}}},
        {23, {{Form::Standard, 0}, {Form::Short, 0}}},
        {24, {{Form::Standard, 36}, {Form::Short, 12}}},
        {25, {{Form::Standard, 16}, {Form::Bare, 12}}}};
    for (const TypeInfo& message : typeTable()) {
        const auto found = sizes.find(message.type);
        if (found == sizes.end()) {
            EXPECT_EQ(message.forms.size(), 1U) << int{message.type};
            EXPECT_EQ(message.forms[0].form, Form::Standard);
            continue;
        }
        ASSERT_EQ(message.forms.size(), found->second.size()) << int{message.type};
        for (std::size_t i = 0; i < message.forms.size(); ++i) {
            EXPECT_EQ(message.forms[i].form, found->second[i].first);
            EXPECT_EQ(message.forms[i].size, found->second[i].second) << int{message.type};
        }
    }
    EXPECT_EQ(findType(23)->forms[1].fields[0].size, 44U);
}

TEST(Schema, TellsTheTwoListsOfANullPoseByTheirCounts) {
    const auto fields = findType(13)->fields();
    ASSERT_EQ(fields.size(), 2U);
    for (const FieldRow& field : fields) {
        EXPECT_EQ(field.kind, Kind::CountedItems);
        EXPECT_TRUE(field.isList());
        EXPECT_EQ(field.size, 0U) << "names vary in length";
    }
    EXPECT_EQ(fields[0].max, kMaxNullPoseSegments);
    EXPECT_EQ(fields[1].max, kMaxNullPosePoints);
    EXPECT_EQ(fields[0].least, 4U + 12);
    EXPECT_EQ(fields[1].least, 2U + 2 + 4 + 4 + 12);
    EXPECT_EQ(fields[1].items[0].scalar, Scalar::Uint16);
    EXPECT_EQ(fields[1].items[3].about.unit, Unit::Flags);
}

TEST(Schema, SaysHowTextsEnd) {
    EXPECT_EQ(findType(12)->forms[0].fields[0].textKind, TextKind::Prefixed);
    EXPECT_EQ(findType(12)->forms[1].fields[0].textKind, TextKind::ToEnd);
    EXPECT_EQ(findType(11)->fields()[0].items[1].textKind, TextKind::ZeroTerminated);
    EXPECT_EQ(findType(13)->fields()[0].items[0].textKind, TextKind::Prefixed);
    for (const TypeInfo& message : typeTable()) {
        EXPECT_EQ(message.fields()[0].kind == Kind::Text, message.type == 12) << int{message.type};
    }
}

TEST(Schema, GivesVectorsTheirComponents) {
    const auto quaternion = findType(2)->fields()[0].items;
    EXPECT_EQ(quaternion[0].components, 1);
    EXPECT_EQ(quaternion[0].scalar, Scalar::Uint32);
    EXPECT_EQ(quaternion[1].components, 3);
    EXPECT_EQ(quaternion[2].components, 4);
    EXPECT_EQ(quaternion[2].scalar, Scalar::Float32);
    EXPECT_EQ(findType(10)->fields()[0].items[2].components, 9);
    EXPECT_EQ(findType(25)->fields()[1].scalar, Scalar::Characters);
    for (const std::size_t components : {3U, 4U, 9U}) {
        EXPECT_EQ(componentNames(components).size(), components);
    }
    for (const std::size_t components : {0U, 1U, 2U, 5U, 16U}) {
        EXPECT_TRUE(componentNames(components).empty()) << components;
    }
}

/// The positions of type 02 and 21 are metres, of type 01 and 03 centimetres.
TEST(Schema, TellsMetresFromCentimetres) {
    const auto positionUnit = [](std::uint8_t type) {
        const TypeInfo* message = findType(type);
        const auto items = message->fields()[0].items;
        const auto place =
            std::ranges::find_if(items, [](const FieldRow& row) { return row.about.name == "position"; });
        return place == items.end() ? std::string_view() : unitSymbol(place->about.unit);
    };
    EXPECT_EQ(positionUnit(1), "cm");
    EXPECT_EQ(positionUnit(2), "m");
    EXPECT_EQ(positionUnit(3), "cm");
    EXPECT_EQ(positionUnit(5), "m");
    EXPECT_EQ(positionUnit(13), "m");
    EXPECT_EQ(positionUnit(21), "m");
    EXPECT_EQ(unitSymbol(findType(1)->fields()[0].items[2].about.unit), "°");
    EXPECT_EQ(unitSymbol(findType(22)->fields()[0].items[2].about.unit), "rad/s");
    EXPECT_EQ(unitSymbol(findType(22)->fields()[0].items[3].about.unit), "rad/s²");
    EXPECT_EQ(unitSymbol(findType(23)->fields()[0].items[2].about.unit), "m/s²");
    EXPECT_EQ(unitSymbol(findType(23)->fields()[0].items[5].about.unit), "a.u.");
    EXPECT_EQ(unitSymbol(findType(24)->fields()[1].about.unit), "m/s");
    EXPECT_EQ(unitSymbol(headerRows()[4].about.unit), "ms");
    EXPECT_EQ(unitSymbol(headerRows()[10].about.unit), "bytes");
    EXPECT_EQ(unitSymbol(headerRows()[9].about.unit), "");
}

TEST(Schema, TellsWhichTypesListSegments) {
    const std::set<std::uint8_t> lists{1, 2, 5, 10, 21, 22};
    const std::set<std::uint8_t> counts{1, 2, 21, 22}; // of the frames: body, props and fingers
    for (unsigned number = 0; number < 256; ++number) {
        const auto type = static_cast<std::uint8_t>(number);
        EXPECT_EQ(listsSegments(type), lists.contains(type)) << number;
        EXPECT_EQ(countsSegments(type), counts.contains(type)) << number;
    }
}

TEST(Schema, TakesUnknownTypesForSampledOnes) {
    const std::set<std::uint8_t> rare{10, 11, 12, 13};
    for (unsigned number = 0; number < 100; ++number) {
        const auto type = static_cast<std::uint8_t>(number);
        EXPECT_EQ(isSampled(type), !rare.contains(type)) << number;
    }
}

TEST(Schema, WritesEveryTypeWithTwoDigits) {
    for (unsigned number = 0; number < 100; ++number) {
        const auto type = static_cast<std::uint8_t>(number);
        Header header;
        header.setType(type);
        EXPECT_EQ(header.type(), type);
        EXPECT_EQ(typeDigits(type), std::string({header.id[4], header.id[5]}));
        EXPECT_EQ(typeTitle(type).substr(0, 3), typeDigits(type) + ' ');
    }
}

TEST(TypeTable, SaysWhichRevisionsHaveAType) {
    EXPECT_EQ(findType(1)->firstRevision(), 'E');
    EXPECT_FALSE(findType(1)->isInOneRevision());
    EXPECT_EQ(findType(4)->firstRevision(), 'E');
    EXPECT_TRUE(findType(4)->isInOneRevision());
    EXPECT_TRUE(findType(10)->isInOneRevision());
    EXPECT_TRUE(findType(11)->isInOneRevision());
    EXPECT_EQ(findType(13)->firstRevision(), 'J');
    EXPECT_EQ(findType(25)->firstRevision(), 'J');
}

TEST(TypeTable, NamesTheFramesOfTheSpecification) {
    EXPECT_EQ(frameName(findType(1)->frame), "Y-up, right-handed");
    EXPECT_EQ(frameName(findType(2)->frame), "Z-up, right-handed");
    EXPECT_EQ(frameName(findType(3)->frame), "Y-up, right-handed");
    EXPECT_EQ(frameName(findType(5)->frame), "Y-up, left-handed");
    EXPECT_EQ(frameName(findType(13)->frame), "Z-up, right-handed");
    EXPECT_EQ(frameName(findType(20)->frame), "ISB axes");
    EXPECT_EQ(frameName(findType(12)->frame), "");
    EXPECT_EQ(frameName(findType(25)->frame), "");
}

} // namespace
} // namespace posewire::wire
