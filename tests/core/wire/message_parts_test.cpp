// SPDX-License-Identifier: MIT
#include "core/wire/codec.h"

#include "tests/core/wire/generated_datagrams.h"

#include <gtest/gtest.h>

#include <set>

namespace posewire::wire {
namespace {

/// Types whose header counts the items of a list (§2.4.1.4).
const std::set<std::uint8_t> kDividable{1, 2, 3, 4, 5, 10, 11, 20, 21, 22, 23};

Datagram generated(std::mt19937& random, std::uint8_t type, std::size_t items) {
    return test::generatedDatagram({random, true, items}, type, Form::Standard, HeaderEra::Counted);
}

/// Sends the datagrams of one sample with `size` items each, and reads them back (§2.4.1.3).
std::vector<Datagram> sentInParts(const Datagram& whole, std::size_t size) {
    const std::size_t items = dividableItems(whole.body);
    std::vector<Datagram> parts;
    for (std::size_t from = 0; from < items; from += size) {
        Datagram part = whole;
        keepItems(part.body, from, std::min(from + size, items));
        completeHeader(part, HeaderEra::Counted);
        const bool isLast = from + size >= items;
        part.header.datagramCounter = static_cast<std::uint8_t>(parts.size() | (isLast ? 0x80U : 0U));
        const auto bytes = encode(part);
        EXPECT_TRUE(bytes);
        const auto read = decode(bytes.value());
        EXPECT_TRUE(read);
        parts.push_back(read.value());
    }
    return parts;
}

class MessageParts : public testing::TestWithParam<std::uint8_t> {
protected:
    [[nodiscard]] std::uint8_t type() const { return GetParam(); }
    [[nodiscard]] bool isDividable() const { return kDividable.contains(type()); }
    std::mt19937 m_random{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(AllTypes, MessageParts, testing::ValuesIn(test::kAllTypes));

TEST_P(MessageParts, AnnounceTheItemsOfListsThatTheHeaderCounts) {
    for (const std::size_t items : {0U, 1U, 23U, 67U, 255U}) {
        const Datagram datagram = generated(m_random, type(), items);
        std::size_t announced = isDividable() ? items : 1;
        if (type() == NullPose::kType) {
            announced = 0; // its lists have counts of their own
        }
        EXPECT_EQ(dividableItems(datagram.body), isDividable() ? items : 0);
        EXPECT_EQ(datagram.header.items, announced);
    }
}

TEST_P(MessageParts, JoinToTheWholeWhateverTheirSize) {
    constexpr std::size_t items = 67;
    const Datagram whole = generated(m_random, type(), items);
    for (std::size_t size = 1; isDividable() && size <= items + 1; ++size) {
        const auto parts = sentInParts(whole, size);
        ASSERT_EQ(parts.size(), (items + size - 1) / size);
        Datagram joined = parts.front();
        for (std::size_t i = 1; i < parts.size(); ++i) {
            EXPECT_EQ(parts[i].header.datagramIndex(), i);
            EXPECT_EQ(parts[i].header.isLast(), i + 1 == parts.size());
            appendPart(joined, parts[i]);
        }
        EXPECT_TRUE(joined.body == whole.body) << "with " << size << " items each";
        EXPECT_EQ(dividableItems(joined.body), items);
    }
}

TEST_P(MessageParts, KeepExactlyTheItemsAskedFor) {
    const Datagram whole = generated(m_random, type(), 12);
    const std::size_t perItem = isDividable() ? payloadSize(whole.body) : 0;
    for (std::size_t from = 0; from <= 12; ++from) {
        for (std::size_t to = from; to <= 12; ++to) {
            Body head = whole.body;
            Body middle = whole.body;
            Body tail = whole.body;
            keepItems(head, 0, isDividable() ? from : 0);
            keepItems(middle, from, to);
            keepItems(tail, to, 12);
            if (!isDividable()) {
                EXPECT_TRUE(middle == whole.body) << "what has no list of items is not divided";
                continue;
            }
            EXPECT_EQ(dividableItems(middle), to - from);
            EXPECT_EQ(payloadSize(head) + payloadSize(middle) + payloadSize(tail), perItem);
        }
    }
}

TEST_P(MessageParts, TakeOnNothingFromAnotherType) {
    const Datagram whole = generated(m_random, type(), 3);
    for (const std::uint8_t other : test::kAllTypes) {
        if (other == type()) {
            continue;
        }
        Datagram joined = whole;
        appendPart(joined, generated(m_random, other, 3));
        EXPECT_TRUE(joined.body == whole.body) << "type " << int{other};
        EXPECT_EQ(joined.header, whole.header);
    }
}

TEST(MessagePartsOfANullPose, AppendToBothLists) {
    const NullPose first{{{"Pelvis", {0, 0, 1}}, {"L5", {0, 0, 2}}}, {}};
    const NullPose second{{}, {{1, 13, "pSacrum", 0, {1, 2, 3}}}};
    const NullPose third{{}, {{2, 1, "jL5S1", 0, {4, 5, 6}}, {2, 2, "jL4L3", 7, {7, 8, 9}}}};
    Datagram whole;
    whole.body = first;
    for (const NullPose& next : {second, third, NullPose{}}) {
        Datagram part;
        part.body = next;
        appendPart(whole, part);
    }
    const auto& joined = std::get<NullPose>(whole.body);
    EXPECT_EQ(joined.segments, first.segments);
    ASSERT_EQ(joined.points.size(), 3U);
    EXPECT_EQ(joined.points[0], second.points[0]);
    EXPECT_EQ(joined.points[2], third.points[1]);
}

TEST(MessagePartsOfSingleValues, KeepWhatIsThere) {
    Datagram text;
    text.body = MetaData{true, "name:A\n"};
    Datagram more;
    more.body = MetaData{true, "color:ff0000\n"};
    appendPart(text, more);
    EXPECT_EQ(std::get<MetaData>(text.body).text, "name:A\n");
    Datagram raw;
    raw.body = RawBody{{std::byte{1}}};
    appendPart(raw, raw);
    EXPECT_EQ(std::get<RawBody>(raw.body).bytes.size(), 1U);
    completeHeader(raw, HeaderEra::Counted);
    EXPECT_EQ(raw.header.items, 0U);
}

TEST(MessagePartsWithNotices, CarryThemInOrder) {
    PoseQuaternion odd{{{68, {}, {1, 0, 0, 0}}}};
    Datagram first;
    first.body = odd;
    completeHeader(first, HeaderEra::Counted);
    first.header.reserved = 1;
    const Datagram read = decode(encode(first).value()).value();
    ASSERT_EQ(read.notices.size(), 2U);
    odd.segments[0].orientation = {2, 0, 0, 0};
    odd.segments[0].id = 1;
    Datagram second;
    second.body = odd;
    completeHeader(second, HeaderEra::Counted);
    Datagram whole = read;
    appendPart(whole, decode(encode(second).value()).value());
    EXPECT_EQ(whole.notices, (std::vector{Notice{NoticeCode::ReservedUsed, 20, 1},
                                          Notice{NoticeCode::SegmentOutOfRange, 24, 1},
                                          Notice{NoticeCode::NotUnitQuaternion, 24, 1}}));
}

/// 128 datagrams are the most that the seven bits of the counter can number.
TEST(MessagePartsOfOneItem, FillTheDatagramCounter) {
    std::mt19937 random(1);
    const auto parts = sentInParts(generated(random, PointPositions::kType, 128), 1);
    ASSERT_EQ(parts.size(), 128U);
    EXPECT_EQ(parts[126].header.datagramCounter, 0x7e);
    EXPECT_EQ(parts[127].header.datagramCounter, 0xff);
    EXPECT_EQ(parts[127].header.datagramIndex(), 127);
    EXPECT_TRUE(parts[127].header.isLast());
}

} // namespace
} // namespace posewire::wire
