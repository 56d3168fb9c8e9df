// SPDX-License-Identifier: MIT
#include "core/wire/field_tree.h"
#include "tests/core/wire/expected_datagrams.h"
#include "tests/core/wire/golden_fixture.h"

namespace posewire::wire::test {
namespace {

class GoldenFieldTree : public GoldenTest {};
INSTANTIATE_TEST_SUITE_P(All, GoldenFieldTree, testing::ValuesIn(goldenNames()), goldenTestName);

/// How many nodes without children stand on each byte.
std::vector<int> leavesOnBytes(const FieldTree& tree, std::size_t size) {
    std::vector<bool> hasChildren(tree.nodes.size(), false);
    for (const FieldNode& node : tree.nodes) {
        if (node.parent >= 0) {
            hasChildren[static_cast<std::size_t>(node.parent)] = true;
        }
    }
    std::vector<int> leaves(size, 0);
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const FieldNode& node = tree.nodes[i];
        EXPECT_LE(node.offset + node.length, size) << node.name;
        for (std::size_t k = 0; !hasChildren[i] && k < node.length; ++k) {
            ++leaves.at(node.offset + k);
        }
    }
    return leaves;
}

void expectParentsAroundChildren(const FieldTree& tree) {
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const FieldNode& node = tree.nodes[i];
        if (node.parent < 0) {
            continue;
        }
        ASSERT_LT(static_cast<std::size_t>(node.parent), i) << node.name;
        const FieldNode& parent = tree.nodes[static_cast<std::size_t>(node.parent)];
        EXPECT_GE(node.offset, parent.offset) << node.name;
        EXPECT_LE(node.offset + node.length, parent.offset + parent.length) << node.name;
    }
}

TEST_P(GoldenFieldTree, StandsOnEveryByteExactlyOnce) {
    const FieldTree tree = fieldTree(bytes());
    EXPECT_FALSE(tree.fault);
    EXPECT_EQ(leavesOnBytes(tree, bytes().size()), std::vector<int>(bytes().size(), 1));
    expectParentsAroundChildren(tree);
}

TEST_P(GoldenFieldTree, AgreesWithTheDecoderAboutNoticesAndFaults) {
    for (std::size_t length = 0; length <= bytes().size(); ++length) {
        const FieldTree tree = fieldTree(first(length));
        const auto datagram = decode(first(length));
        ASSERT_EQ(tree.fault.has_value(), !datagram.has_value()) << "cut at " << length;
        if (datagram) {
            EXPECT_EQ(tree.notices, datagram->notices) << "cut at " << length;
        } else {
            EXPECT_EQ(*tree.fault, datagram.error()) << "cut at " << length;
        }
    }
}

/// Every field that is whole before the cut is there with the value it has in the whole datagram.
TEST_P(GoldenFieldTree, HasEverythingBeforeACut) {
    const FieldTree whole = fieldTree(bytes());
    for (std::size_t length = 6; length < bytes().size(); ++length) {
        const FieldTree cut = fieldTree(first(length));
        const std::vector<int> leaves = leavesOnBytes(cut, length);
        EXPECT_TRUE(std::all_of(leaves.begin(), leaves.end(), [](int count) { return count <= 1; }));
        expectParentsAroundChildren(cut);
        for (std::size_t i = 0; i < whole.nodes.size(); ++i) {
            const FieldNode& node = whole.nodes[i];
            const bool isWhole = node.offset + node.length <= std::min(length, kHeaderSize);
            if (isWhole && !node.value.empty()) {
                ASSERT_LT(i, cut.nodes.size());
                EXPECT_EQ(cut.nodes[i].name, node.name);
                EXPECT_EQ(cut.nodes[i].value, node.value);
            }
        }
    }
}

TEST_P(GoldenFieldTree, StandsOnBytesBehindTheDatagramToo) {
    std::vector<std::byte> longer = bytes();
    longer.push_back(std::byte{'x'});
    const FieldTree tree = fieldTree(longer);
    EXPECT_EQ(leavesOnBytes(tree, longer.size()), std::vector<int>(longer.size(), 1));
}

TEST(FieldTree, KeepsItemsBeforeTheFault) {
    const auto& bytes = posewire::test::golden("02_quaternion_reserved").bytes;
    const FieldTree tree = fieldTree(Bytes(bytes).first(kHeaderSize + 2 * 32 + 10));
    ASSERT_TRUE(tree.fault);
    EXPECT_EQ(tree.fault->code, ErrorCode::ItemsTruncated);
    EXPECT_EQ(tree.fault->offset, kHeaderSize + 2 * 32U);
    EXPECT_EQ(tree.fault->need, 32U);
    EXPECT_EQ(tree.fault->have, 10U);
    const std::int32_t second = tree.nodeAt(kHeaderSize + 32 + 5);
    ASSERT_GE(second, 0);
    EXPECT_EQ(tree.nodes[static_cast<std::size_t>(second)].name, "position");
    EXPECT_EQ(tree.nodes[static_cast<std::size_t>(second)].value, "2  -2.5  0.25");
}

TEST(FieldTree, FindsTheInnermostFieldOnAByte) {
    const FieldTree tree = fieldTree(posewire::test::golden("13_null_pose_reserved").bytes);
    const auto nameAt = [&](std::uint32_t offset) {
        return tree.nodes.at(static_cast<std::size_t>(tree.nodeAt(offset))).name;
    };
    EXPECT_EQ(nameAt(0), "id");
    EXPECT_EQ(nameAt(9), "sample");
    EXPECT_EQ(nameAt(24), "segments count");
    EXPECT_EQ(nameAt(28), "name");
    EXPECT_EQ(nameAt(37), "name");
    EXPECT_EQ(nameAt(38), "position");
    EXPECT_EQ(tree.nodeAt(100000), -1);
}

} // namespace
} // namespace posewire::wire::test
