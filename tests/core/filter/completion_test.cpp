// SPDX-License-Identifier: MIT
#include "core/filter/completion.h"
#include "core/filter/filter.h"
#include "tests/core/filter/filter_fixture.h"

#include <gmock/gmock.h>

namespace posewire::filter::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;

/// `|` marks the cursor.
std::vector<Completion> at(std::string text) {
    const std::size_t cursor = text.find('|');
    text.erase(cursor, 1);
    return completions(text, cursor);
}

std::vector<std::string> texts(const std::vector<Completion>& all) {
    std::vector<std::string> found;
    for (const Completion& one : all) {
        found.push_back(one.text);
    }
    return found;
}

TEST(Completion, OffersFieldsWhereAConditionBegins) {
    EXPECT_THAT(texts(at("|")), IsSupersetOf({"type", "gap", "sample", "position", "segment", "tag.name"}));
    EXPECT_THAT(texts(at("gap && |")), Contains("type"));
    EXPECT_THAT(texts(at("!(|")), Contains("type"));
    EXPECT_EQ(at("gap && sam|").front().text, "sample");
}

TEST(Completion, ReplacesTheWholeWord) {
    const Completion first = at("gap && sa|xyz == 1").front();
    EXPECT_EQ(first.text, "sample");
    EXPECT_EQ(first.offset, 7U);
    EXPECT_EQ(first.length, 5U);
    EXPECT_THAT(first.about, HasSubstr("counts sampled frames"));
}

TEST(Completion, OffersComponents) {
    EXPECT_THAT(texts(at("position.|")), IsSupersetOf({"position.x", "position.y", "position.z"}));
    EXPECT_THAT(texts(at("orientation.|")),
                AllOf(IsSupersetOf({"orientation.re", "orientation.i", "orientation.j", "orientation.k"}),
                      Not(Contains("orientation.w"))));
    EXPECT_THAT(texts(at("matrix|")), IsSupersetOf({"matrix.1", "matrix.9"}));
    EXPECT_THAT(texts(at("segments.pos|")), Contains("segments.position"));
}

TEST(Completion, OffersOperatorsThatSuitTheField) {
    EXPECT_THAT(texts(at("sample |")), AllOf(IsSupersetOf({"==", "<=", "in {"}), Not(Contains("contains"))));
    EXPECT_THAT(texts(at("source |")),
                AllOf(IsSupersetOf({"==", "contains", "matches"}), Not(Contains("<"))));
    EXPECT_EQ(texts(at("source con|")), std::vector<std::string>{"contains"});
    EXPECT_EQ(texts(at("type =|")), std::vector<std::string>{"=="});
}

TEST(Completion, OffersValues) {
    EXPECT_THAT(texts(at("segment == Left|")), AllOf(Contains("LeftHand"), Not(Contains("RightHand"))));
    EXPECT_THAT(texts(at("point == pSac|")), Contains("pSacrum"));
    EXPECT_THAT(texts(at("child == jRight|")), Contains("jRightKnee"));
    EXPECT_THAT(texts(at("joint == jLeft|")), AllOf(Contains("jLeftKnee"), Not(Contains("jRightKnee"))));
    EXPECT_EQ(at("type == 1|3").front().length, 2U);
    EXPECT_EQ(texts(at("type == null|")), std::vector<std::string>{"13"});
    EXPECT_THAT(texts(at("type in |")), IsSupersetOf({"{", "02"}));
    EXPECT_THAT(texts(at("type in {02, |")), Contains("13"));
    EXPECT_THAT(texts(at("type in {02 |")), IsSupersetOf({",", "}"}));
    EXPECT_THAT(texts(at("error == items|")), Contains("itemsTruncated"));
    EXPECT_THAT(texts(at("transport == |")), Contains("tcp"));
    EXPECT_THAT(texts(at("sample == |")), IsEmpty());
    EXPECT_THAT(texts(at("gap == 1 |")), Contains("&&"));
}

TEST(ExpressionFor, MatchesThePacketThatItWasMadeFrom) {
    for (const auto& golden : posewire::test::goldens()) {
        const Case packet(golden.bytes);
        const wire::FieldTree tree = wire::fieldTree(packet.bytes);
        for (std::size_t i = 0; i < tree.nodes.size() && !packet.fault; ++i) {
            const std::string text = expressionFor(tree, static_cast<std::int32_t>(i));
            if (!text.empty()) {
                EXPECT_TRUE(matches(packet, text)) << golden.name << ": " << text;
            } else {
                EXPECT_TRUE(tree.nodes[i].value.empty() || tree.nodes[i].name == "bytes")
                    << golden.name << ": " << tree.nodes[i].name << " " << tree.nodes[i].value;
            }
        }
    }
}

TEST(ExpressionFor, WritesWhatPeopleWouldWrite) {
    EXPECT_EQ(expressionFor("character", "1"), "character == 1");
    EXPECT_EQ(expressionFor("source", "192.168.1.20:4001"), "source == \"192.168.1.20:4001\"");
    EXPECT_EQ(expressionFor("type", "02 Pose, quaternion"), "type == 02");
    EXPECT_EQ(expressionFor("segment", "15"), "segment == LeftHand");
    EXPECT_EQ(expressionFor("duplicate", "true"), "duplicate");
    EXPECT_EQ(expressionFor("position.z", "0.1"), "position.z == 0.1");
    EXPECT_EQ(expressionFor("tag.name", "say \"hi\""), "tag.name == \"say \\\"hi\\\"\"");
    EXPECT_EQ(expressionFor("nothing", "1"), "");
}

TEST(ExpressionFor, NamesTheComponentsOfAQuaternionAsTheInspectorDoes) {
    EXPECT_EQ(expressionFor("orientation", "1  0  0  -0.5"),
              "orientation.re == 1 && orientation.i == 0 && orientation.j == 0 && orientation.k == -0.5");
}

TEST(FilterReference, NamesEveryFieldOfTheTables) {
    const std::string page = filterReference();
    for (const char* field :
         {"`sample`", "`segments.position`", "`trackers.magneticField`", "`gap`", "`points.flags`"}) {
        EXPECT_THAT(page, HasSubstr(field));
    }
}

TEST(FilterReference, SaysWhichTypesHaveWhichUnit) {
    EXPECT_THAT(filterReference(),
                HasSubstr("| `segments.position` | x, y, z | m | cm (01), m (02 05 13 21) |"));
    EXPECT_THAT(filterReference(), HasSubstr("| `segments.orientation` | re, i, j, k |"));
    EXPECT_THAT(filterReference(), HasSubstr("| `segments.matrix` | 1 … 9 |"));
}

} // namespace
} // namespace posewire::filter::test
