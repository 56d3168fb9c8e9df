// SPDX-License-Identifier: MIT
#include "core/wire/field_tree.h"

#include "tests/core/wire/generated_datagrams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace posewire::wire {
namespace {

std::vector<std::string> pathsOf(const FieldTree& tree) {
    std::vector<std::string> paths;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        paths.push_back(tree.path(static_cast<std::int32_t>(i)));
    }
    return paths;
}

class FieldTreeValues : public testing::TestWithParam<std::uint8_t> {
protected:
    [[nodiscard]] std::vector<std::byte> generated(std::size_t items, bool onlyFinite = true,
                                                   Form form = Form::Standard) {
        return encode(test::generatedDatagram({m_random, onlyFinite, items}, GetParam(), form,
                                              HeaderEra::Counted))
            .value();
    }
    std::mt19937 m_random{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(AllTypes, FieldTreeValues, testing::ValuesIn(test::kAllTypes));

/// Paths name columns and filters: twice the same one would hide a field. Tags come from the sender and may
/// repeat.
TEST_P(FieldTreeValues, HavePathsThatAreUnique) {
    const auto bytes = generated(5);
    for (const FieldDetail detail : {FieldDetail::Fields, FieldDetail::Parts}) {
        if (GetParam() == MetaData::kType && detail == FieldDetail::Parts) {
            continue;
        }
        const auto paths = pathsOf(fieldTree(bytes, detail));
        EXPECT_EQ(std::set(paths.begin(), paths.end()).size(), paths.size());
        EXPECT_EQ(std::ranges::count(paths, ""), 0);
    }
}

/// However many items another datagram of the type has, what both have is called the same.
TEST_P(FieldTreeValues, HaveTheSamePathsInEveryDatagramOfTheType) {
    if (GetParam() == MetaData::kType) {
        return; // its parts are the sender's own tags
    }
    auto few = pathsOf(fieldTree(generated(2), FieldDetail::Parts));
    auto many = pathsOf(fieldTree(generated(9), FieldDetail::Parts));
    std::ranges::sort(few);
    std::ranges::sort(many);
    EXPECT_TRUE(std::ranges::includes(many, few));
}

/// The innermost node on a byte is the smallest one that has it.
TEST_P(FieldTreeValues, AreFoundAtEachOfTheirBytes) {
    const auto bytes = generated(3);
    for (const FieldDetail detail : {FieldDetail::Fields, FieldDetail::Parts}) {
        const FieldTree tree = fieldTree(bytes, detail);
        for (std::uint32_t at = 0; at < bytes.size(); ++at) {
            const std::int32_t found = tree.nodeAt(at);
            ASSERT_GE(found, 0) << at;
            const FieldNode& node = tree.nodes[static_cast<std::size_t>(found)];
            ASSERT_TRUE(node.offset <= at && at < node.offset + node.length);
            for (const FieldNode& other : tree.nodes) {
                const bool hasByte = other.offset <= at && at < other.offset + other.length;
                ASSERT_TRUE(!hasByte || other.length >= node.length)
                    << other.name << " is within " << node.name;
            }
        }
        EXPECT_EQ(tree.nodeAt(static_cast<std::uint32_t>(bytes.size())), -1);
    }
}

/// The big-endian number at the place of a node.
std::uint32_t wordAt(const std::vector<std::byte>& bytes, const FieldNode& node) {
    std::uint32_t word = 0;
    for (std::uint32_t i = 0; i < node.length; ++i) {
        word = word << 8 | std::to_integer<std::uint32_t>(bytes[node.offset + i]);
    }
    return word;
}

/// What a numeric node shows is what stands at its place in the bytes (§2.5.11).
TEST_P(FieldTreeValues, ShowTheNumbersOfTheirBytes) {
    for (int round = 0; round < 10; ++round) {
        const auto bytes = generated(4, false);
        for (const FieldNode& node : fieldTree(bytes, FieldDetail::Parts).nodes) {
            const bool isPlain = node.kind == NodeKind::Field && node.components == 0;
            const bool isComponent = node.kind == NodeKind::Part && node.scalar == Scalar::Float32;
            if (node.scalar == Scalar::Float32 && (isPlain || isComponent)) {
                const float value = std::bit_cast<float>(wordAt(bytes, node));
                if (std::isnan(value)) {
                    EXPECT_TRUE(std::isnan(node.number)) << node.name;
                } else {
                    EXPECT_EQ(node.number, value) << node.name;
                    EXPECT_EQ(std::strtof(node.value.c_str(), nullptr), value) << node.value;
                }
            } else if (isPlain && (node.scalar == Scalar::Uint8 || node.scalar == Scalar::Uint16 ||
                                   node.scalar == Scalar::Uint32)) {
                EXPECT_EQ(node.number, wordAt(bytes, node)) << node.name;
            } else if (isPlain && node.scalar == Scalar::Int32) {
                EXPECT_EQ(node.number, static_cast<std::int32_t>(wordAt(bytes, node))) << node.name;
            }
        }
    }
}

/// Where the item begins that a node is in, or the payload.
std::uint32_t itemOffset(const FieldTree& tree, FieldNode node) {
    while (node.kind != NodeKind::Item && node.parent >= 0) {
        node = tree.nodes[static_cast<std::size_t>(node.parent)];
    }
    return node.kind == NodeKind::Item ? node.offset : static_cast<std::uint32_t>(kHeaderSize);
}

/// As many values as the tree shows to be no finite numbers are in the notice.
TEST_P(FieldTreeValues, AgreeWithTheNoticeAboutWhatIsNotFinite) {
    for (int round = 0; round < 200; ++round) {
        const auto bytes =
            generated(40, false, round % 2 == 0 ? Form::Standard : test::otherForm(GetParam()));
        const FieldTree tree = fieldTree(bytes, FieldDetail::Parts);
        std::uint32_t count = 0;
        std::uint32_t first = 0;
        for (const FieldNode& node : tree.nodes) {
            const bool isOdd =
                node.kind == NodeKind::Part && node.scalar == Scalar::Float32 && !std::isfinite(node.number);
            first = isOdd && count == 0 ? itemOffset(tree, node) : first;
            count += isOdd ? 1 : 0;
        }
        const auto notice = std::ranges::find(tree.notices, NoticeCode::NotFinite, &Notice::code);
        ASSERT_EQ(notice != tree.notices.end(), count != 0);
        if (notice != tree.notices.end()) {
            EXPECT_EQ(notice->count, count);
            EXPECT_EQ(notice->offset, first);
        }
    }
}

TEST_P(FieldTreeValues, NumberTheItemsOfLists) {
    const FieldTree tree = fieldTree(generated(7));
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const FieldNode& list = tree.nodes[i];
        if (list.kind != NodeKind::Group || list.name == "header") {
            continue;
        }
        EXPECT_EQ(list.index, 7U) << "announced";
        std::uint32_t next = 0;
        for (const FieldNode& node : tree.nodes) {
            if (node.parent == static_cast<std::int32_t>(i)) {
                EXPECT_EQ(node.kind, NodeKind::Item);
                EXPECT_EQ(node.index, next++);
                EXPECT_EQ(node.name, std::to_string(next));
                EXPECT_EQ(node.refersTo, list.refersTo);
            }
        }
        EXPECT_EQ(next, 7U);
    }
}

const FieldNode* findNode(const FieldTree& tree, const std::string& path) {
    const auto paths = pathsOf(tree);
    const auto found = std::ranges::find(paths, path);
    return found == paths.end() ? nullptr : &tree.nodes[static_cast<std::size_t>(found - paths.begin())];
}

std::string valueOf(const FieldTree& tree, const std::string& path) {
    const FieldNode* node = findNode(tree, path);
    return node != nullptr ? node->value : "no " + path;
}

FieldTree treeOf(const Datagram& datagram) {
    return fieldTree(encode(datagram).value(), FieldDetail::Parts);
}

TEST(FieldTreeOfAHeader, DividesTheDatagramCounter) {
    for (unsigned counter = 0; counter < 256; ++counter) {
        Datagram datagram;
        datagram.body = PoseQuaternion{};
        completeHeader(datagram, HeaderEra::Counted);
        datagram.header.datagramCounter = static_cast<std::uint8_t>(counter);
        const FieldTree tree = treeOf(datagram);
        EXPECT_EQ(valueOf(tree, "header.datagramCounter"), std::to_string(counter));
        EXPECT_EQ(valueOf(tree, "header.datagramCounter.index"), std::to_string(counter % 128));
        EXPECT_EQ(valueOf(tree, "header.datagramCounter.last"), counter >= 128 ? "yes" : "no");
    }
}

TEST(FieldTreeOfAHeader, ShowsTheLargestValues) {
    Datagram datagram;
    datagram.body = RawBody{};
    datagram.header = {
        {'M', 'X', 'T', 'P', '9', '9'}, 0xffffffff, 0xff, 0, 0xffffffff, 255, 255, 255, 255, 0xffff, 0};
    const FieldTree tree = treeOf(datagram);
    EXPECT_EQ(valueOf(tree, "header.id"), "MXTP99");
    EXPECT_EQ(valueOf(tree, "header.id.type"), "99");
    EXPECT_EQ(valueOf(tree, "header.sample"), "4294967295");
    EXPECT_EQ(valueOf(tree, "header.timeCode"), "4294967295");
    EXPECT_EQ(valueOf(tree, "header.character"), "255");
    EXPECT_EQ(valueOf(tree, "header.reserved"), "65535");
    EXPECT_FALSE(tree.fault);
}

TEST(FieldTreeOfANullPose, ShowsFlagsAsHexadecimal) {
    for (const auto& [flags, shown] :
         {std::pair{0U, "0x0"}, {0x1fU, "0x1f"}, {0x80000001U, "0x80000001"}, {0xffffffffU, "0xffffffff"}}) {
        Datagram datagram;
        datagram.body = NullPose{{}, {{1, 13, "pSacrum", flags, {}}}};
        completeHeader(datagram, HeaderEra::Counted);
        const FieldTree tree = treeOf(datagram);
        EXPECT_EQ(valueOf(tree, "points[0].flags"), shown);
        EXPECT_EQ(findNode(tree, "points[0].flags")->number, flags);
        EXPECT_EQ(valueOf(tree, "points[0].name.length"), "7");
        EXPECT_EQ(valueOf(tree, "points count"), "1");
        EXPECT_EQ(valueOf(tree, "segments count"), "0");
    }
}

TEST(FieldTreeOfMetadata, DividesATextIntoLinesWhateverTheyAre) {
    struct Line {
        std::string name;
        std::string value;
        std::uint32_t length; ///< with the newline
    };
    const std::vector<std::pair<std::string, std::vector<Line>>> texts{
        {"", {}},
        {"\n", {{"", "", 1}}},
        {":\n", {{"", "", 2}}},
        {"name:A", {{"name", "A", 6}}},
        {"name:A:b: c\n", {{"name", "A:b: c", 12}}},
        {"no colon\ncolor:\n", {{"no colon", "", 9}, {"color", "", 7}}},
        {"a:1\n\nb", {{"a", "1", 4}, {"", "", 1}, {"b", "", 1}}},
        {"x\ny:2\n", {{"x", "", 2}, {"y", "2", 4}}}};
    for (const bool isPrefixed : {true, false}) {
        for (const auto& [text, lines] : texts) {
            Datagram datagram;
            datagram.body = MetaData{isPrefixed, text};
            completeHeader(datagram, HeaderEra::Counted);
            std::vector<FieldNode> parts;
            for (const FieldNode& node : treeOf(datagram).nodes) {
                if (node.kind == NodeKind::Part && node.offset >= kHeaderSize + (isPrefixed ? 4 : 0)) {
                    parts.push_back(node);
                }
            }
            ASSERT_EQ(parts.size(), lines.size()) << text;
            std::uint32_t at = kHeaderSize + (isPrefixed ? 4 : 0);
            for (std::size_t i = 0; i < lines.size(); ++i) {
                EXPECT_EQ(parts[i].name, lines[i].name) << text;
                EXPECT_EQ(parts[i].value, lines[i].value) << text;
                EXPECT_EQ(parts[i].offset, at) << text;
                EXPECT_EQ(parts[i].length, lines[i].length) << text;
                at += parts[i].length;
            }
        }
    }
}

TEST(FieldTreeOfUnknownTypes, KeepsThePayloadAsOneNode) {
    Datagram datagram;
    datagram.header.setType(42);
    datagram.body = RawBody{std::vector<std::byte>(5)};
    completeHeader(datagram, HeaderEra::Counted);
    const FieldTree tree = treeOf(datagram);
    EXPECT_EQ(tree.nodes.back().kind, NodeKind::Unread);
    EXPECT_EQ(tree.nodes.back().offset, kHeaderSize);
    EXPECT_EQ(tree.nodes.back().length, 5U);
    EXPECT_EQ(tree.notices, (std::vector{Notice{NoticeCode::UnknownType, 4, 1}}));
}

} // namespace
} // namespace posewire::wire
