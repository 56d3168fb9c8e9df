// SPDX-License-Identifier: MIT
#include "core/wire/field_tree.h"
#include "tests/core/wire/expected_datagrams.h"
#include "tests/core/wire/golden_fixture.h"

#include <algorithm>

namespace posewire::wire::test {
namespace {

const FieldNode* find(const FieldTree& tree, const std::string& path) {
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        if (tree.path(static_cast<std::int32_t>(i)) == path) {
            return &tree.nodes[i];
        }
    }
    return nullptr;
}

FieldTree parts(Bytes bytes) {
    return fieldTree(bytes, FieldDetail::Parts);
}

class FieldTreePartsOfGoldens : public GoldenTest {};
INSTANTIATE_TEST_SUITE_P(All, FieldTreePartsOfGoldens, testing::ValuesIn(goldenNames()), goldenTestName);

/// Wherever a datagram is cut, each byte that is there has a node, and each child stands within its parent.
TEST_P(FieldTreePartsOfGoldens, StandOnEveryByteOfEveryCut) {
    for (std::size_t length = 0; length <= bytes().size(); ++length) {
        const FieldTree tree = parts(first(length));
        const FieldTree plain = fieldTree(first(length));
        EXPECT_EQ(tree.fault, plain.fault);
        EXPECT_EQ(tree.notices, plain.notices);
        std::vector<bool> isCovered(length, false);
        for (const FieldNode& node : tree.nodes) {
            ASSERT_LE(node.offset + node.length, length) << node.name;
            std::fill_n(isCovered.begin() + node.offset, node.length, true);
            if (node.parent >= 0) {
                const FieldNode& parent = tree.nodes[static_cast<std::size_t>(node.parent)];
                ASSERT_GE(node.offset, parent.offset) << node.name;
                ASSERT_LE(node.offset + node.length, parent.offset + parent.length)
                    << node.name << " cut at " << length;
            }
        }
        EXPECT_TRUE(std::ranges::all_of(isCovered, [](bool is) { return is; })) << "cut at " << length;
    }
}

TEST(FieldTreeParts, NameTheComponentsOfVectors) {
    const FieldTree tree = parts(posewire::test::golden("02_quaternion_reserved").bytes);
    const FieldNode* y = find(tree, "segments[1].position.y");
    ASSERT_NE(y, nullptr);
    EXPECT_EQ(y->value, "-2.5");
    EXPECT_EQ(y->number, -2.5);
    EXPECT_EQ(y->offset, kHeaderSize + 32 + 8);
    EXPECT_NE(find(tree, "segments[1].orientation.re"), nullptr);
    EXPECT_NE(find(tree, "header.datagramCounter.last"), nullptr);
}

TEST(FieldTreeParts, ShowWhatThereIsOfAnItemThatIsCutOff) {
    const auto& bytes = posewire::test::golden("02_quaternion_reserved").bytes;
    const FieldTree tree = parts(Bytes(bytes).first(kHeaderSize + 2 * 32 + 10));
    ASSERT_GE(tree.cutNode, 0);
    EXPECT_EQ(tree.path(tree.cutNode), "segments[2].position");
    EXPECT_EQ(tree.nodes[static_cast<std::size_t>(tree.cutNode)].length, 6U);
    EXPECT_EQ(tree.cutError.need, 12U);
    EXPECT_EQ(tree.cutError.have, 6U);
    EXPECT_NE(find(tree, "segments[2].id"), nullptr);
}

TEST(FieldTreeParts, ShowTheLengthThatRunsPastTheEndAndLeaveTheRestUnread) {
    std::vector<std::byte> bytes = posewire::test::golden("13_null_pose_reserved").bytes;
    const FieldNode* name = nullptr;
    FieldTree tree = parts(bytes);
    name = find(tree, "segments[0].name");
    ASSERT_NE(name, nullptr);
    const std::uint32_t at = name->offset;
    bytes[at + 1] = std::byte{0x7f};
    tree = parts(bytes);
    ASSERT_TRUE(tree.fault);
    EXPECT_EQ(tree.fault->code, ErrorCode::BadLength);
    ASSERT_GE(tree.cutNode, 0);
    EXPECT_EQ(tree.path(tree.cutNode), "segments[0].name");
    EXPECT_EQ(tree.nodes[static_cast<std::size_t>(tree.cutNode)].length, 4U);
    EXPECT_EQ(tree.nodes.back().kind, NodeKind::Unread);
    EXPECT_EQ(tree.nodes.back().offset, at + 4);
    EXPECT_EQ(tree.nodes.back().offset + tree.nodes.back().length, bytes.size());
}

TEST(FieldTreeParts, DivideMetadataIntoItsTags) {
    const FieldTree tree = parts(posewire::test::golden("12_metadata_reserved").bytes);
    const auto tags = std::ranges::count_if(tree.nodes, [&](const FieldNode& node) {
        return node.kind == NodeKind::Part && node.text == "one tag of the text";
    });
    EXPECT_GE(tags, 3);
    EXPECT_NE(find(tree, "text.name"), nullptr);
}

TEST(FieldTreeParts, KeepForeignBytesAsUnread) {
    const std::array<std::byte, 5> bytes{std::byte{'h'}, std::byte{'e'}, std::byte{'l'}, std::byte{'l'},
                                         std::byte{'o'}};
    const FieldTree tree = parts(bytes);
    ASSERT_EQ(tree.nodes.size(), 1U);
    EXPECT_EQ(tree.nodes.front().kind, NodeKind::Unread);
    EXPECT_EQ(tree.nodes.front().length, 5U);
}

} // namespace
} // namespace posewire::wire::test
