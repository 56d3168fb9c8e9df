// SPDX-License-Identifier: MIT
#include "core/filter/completion.h"
#include "core/filter/filter.h"
#include "core/filter/signal_tree.h"
#include "tests/core/filter/filter_fixture.h"

#include <gmock/gmock.h>

#include <random>

namespace posewire::filter::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

struct Wrong {
    std::string text;
    std::string at; ///< the bytes that the error points at; empty at the end
    std::string says;
};

class SignalErrors : public testing::TestWithParam<Wrong> {};

TEST_P(SignalErrors, PointAtTheBytesAndSayWhatWouldBeRight) {
    const Wrong& wrong = GetParam();
    const auto signal = parsedSignal(wrong.text);
    ASSERT_FALSE(signal.has_value());
    const FilterError& error = signal.error();
    ASSERT_LE(error.offset + error.length, wrong.text.size());
    EXPECT_EQ(wrong.text.substr(error.offset, error.length), wrong.at) << error.text;
    EXPECT_THAT(error.text, HasSubstr(wrong.says));
}

INSTANTIATE_TEST_SUITE_P(
    Texts, SignalErrors,
    testing::Values(
        Wrong{"", "", "a field, such as"}, Wrong{"postion.z", "postion.z", "did you mean `position.z`?"},
        Wrong{"20.rotaton.z", "20.rotaton.z", "did you mean `20.rotation.z`?"},
        Wrong{"24.orientation.w", "24.orientation.w", "no field"}, Wrong{"position", "position", "`norm(…)`"},
        Wrong{"orientation", "orientation", "`angle(a, b)`"},
        Wrong{"position.z of LeftHnd", "LeftHnd", "did you mean `LeftHand`?"},
        Wrong{"position.z of", "", "a segment"}, Wrong{"size of Pelvis", "Pelvis", "leave `of` out"},
        Wrong{"24.position.z of Pelvis", "Pelvis", "leave `of` out"},
        Wrong{"3.position.z of Pelvis", "Pelvis", "no item"},
        Wrong{"position.z - delta", "delta", "Subtracted from a length"},
        Wrong{"position.z + (delta * 2)", "(delta * 2)", "it is a time"},
        Wrong{"norm(position) + position", "position", "One side of `+` is a vector"},
        Wrong{"1 + orientation", "1 + orientation", "`angle(a, b)`"},
        Wrong{"position.x * position.y", "position.y", "One side of `*`"},
        Wrong{"position.x / delta", "delta", "as on the left"},
        Wrong{"2 / position.x", "position.x", "as on the left: this is a length"},
        Wrong{"norm(sample)", "sample", "a vector"},
        Wrong{"distance(position, delta)", "delta", "two vectors"},
        Wrong{"distance(position, velocity)", "velocity", "of one unit"},
        Wrong{"distance(position)", ")", "a second value"},
        Wrong{"angle(1.rotation, 1.rotation)", "1.rotation", "two orientations"},
        Wrong{"speed(velocity)", "velocity", "a position"},
        Wrong{"derivative(orientation)", "orientation", "`speed`"},
        Wrong{"derivative(timeCode)", "timeCode", "such as `2.timeCode`"},
        Wrong{"spead(position)", "spead", "did you mean `speed`?"}, Wrong{"rate", "rate", "such as `2.rate`"},
        Wrong{"2.rate of Pelvis", "of", "Expected"}, Wrong{"source", "source", "is text"},
        Wrong{"tag.name", "tag.name", "is text"}, Wrong{"matrix", "matrix", "write `matrix.1`"},
        Wrong{"position.z + 3 parsec", "parsec", "`where`"},
        Wrong{"position.z + 3parsec", "parsec", "no unit"}, Wrong{"(position.z", "", "`)`"},
        Wrong{"3 + 4", "3 + 4", "reads nothing"}, Wrong{"position.z > 2", ">", "Expected"},
        Wrong{"position.z where", "", "a filter"},
        Wrong{"position.z where smaple == 1", "smaple", "did you mean `sample`?"},
        Wrong{"position.z of \"Pel", "\"Pel", "closing quote"}));

std::string unitOf(std::string_view text) {
    const auto tree = parsedSignal(text);
    return tree ? tree->quantity.unit : tree.error().text;
}

TEST(Signal, HasTheUnitOfWhatItIsMadeOf) {
    EXPECT_EQ(unitOf("1.position.z of Pelvis"), "m");
    EXPECT_EQ(unitOf("wire.position.z"), "");
    EXPECT_EQ(unitOf("speed(position)"), "m/s");
    EXPECT_EQ(unitOf("speed(orientation)"), "°/s");
    EXPECT_EQ(unitOf("derivative(speed(position))"), "m/s²");
    EXPECT_EQ(unitOf("derivative(20.rotation.z)"), "°/s");
    EXPECT_EQ(unitOf("norm(derivative(velocity))"), "m/s²");
    EXPECT_EQ(unitOf("derivative(2.sample)"), "1/s");
    EXPECT_EQ(unitOf("derivative(2.loss)"), "%/s");
    EXPECT_EQ(unitOf("derivative(2.timeCode)"), "");
    EXPECT_EQ(unitOf("angle(position, velocity)"), "`angle` takes two orientations, or two vectors.");
    EXPECT_EQ(unitOf("position.z/2 - 10cm"), "m");
    EXPECT_EQ(unitOf("position.z/position.x"), "");
    EXPECT_EQ(unitOf("norm(velocity)/1m/s"), "");
    EXPECT_EQ(unitOf("-2*delta+30 ms"), "s");
}

TEST(Signal, KnowsTheTypesThatItReads) {
    const auto typesOf = [](std::string_view text) { return parsedSignal(text).value().types; };
    EXPECT_THAT(typesOf("20.rotation.z of RightKnee"), ElementsAre(20));
    EXPECT_THAT(typesOf("rotation.z of jRightKnee"), ElementsAre(20));
    EXPECT_THAT(typesOf("position.x of pSacrum"), IsSupersetOf({3}));
    EXPECT_THAT(typesOf("position.x of pSacrum"), Not(Contains(2)));
    EXPECT_THAT(typesOf("distance(3.position of pSacrum, 02.position of Pelvis)"), ElementsAre(2, 3));
    EXPECT_THAT(typesOf("2.jitter"), ElementsAre(2));
    EXPECT_TRUE(typesOf("size").empty());
}

TEST(Signal, SplitsSignsFromWords) {
    const auto words = [](std::string text) {
        std::vector<std::string> all;
        for (const Token& token : signalTokens(text)) {
            all.emplace_back(token.in(text));
        }
        all.pop_back();
        return all;
    };
    EXPECT_THAT(words("a-b*-2"), ElementsAre("a", "-", "b", "*", "-2"));
    EXPECT_THAT(words("x/2m/s/y"), ElementsAre("x", "/", "2m/s", "/", "y"));
    EXPECT_THAT(words("2 m/s-1e-3"), ElementsAre("2", "m/s", "-", "1e-3"));
    EXPECT_THAT(words("-delta"), ElementsAre("-", "delta"));
}

// Filters name items and types as signals do.
TEST(FilterOfItems, AsksForOneItem) {
    const Case hand = pose({{0, 0, 1}, {0, 0, 5}});
    EXPECT_TRUE(matches(hand, "position.z of Pelvis == 1"));
    EXPECT_TRUE(matches(hand, "position.z of \"L5\" > 4"));
    EXPECT_TRUE(matches(hand, "position.z of 2 > 4"));
    EXPECT_FALSE(matches(hand, "position.z of Pelvis > 4"));
    EXPECT_FALSE(matches(hand, "position.z of Head"));
    EXPECT_TRUE(matches(hand, "2.position.z of L5 > 4 && !(1.position.z of L5)"));
    EXPECT_FALSE(matches(hand, "1.position.z of L5 > 4"));
    EXPECT_TRUE(matches(hand, "2.sample < 100000000 && !(3.sample < 100000000)"));
}

TEST(FilterOfItems, SaysWhichNamesThereAre) {
    const auto errorOf = [](std::string text) {
        const FilterError error = Filter::compile(text).error();
        return text.substr(error.offset, error.length) + ": " + error.text;
    };
    EXPECT_THAT(errorOf("position.z of LeftHadn > 1"), HasSubstr("LeftHadn: `position.z` has no item"));
    EXPECT_THAT(errorOf("sample of Pelvis == 1"), HasSubstr("Pelvis: `sample` is of no item"));
    EXPECT_THAT(errorOf("20.position.z > 1"), HasSubstr("20.position.z: There is no field"));
}

// Texts of pieces that belong to signals: each compiles or says where it is wrong, and reads what it can.
TEST(Signal, EndsWellWhateverIsWritten) {
    constexpr std::array kPieces{"position",
                                 "2.",
                                 "20.rotation.z",
                                 ".z",
                                 " of ",
                                 "LeftHand",
                                 "\"Left Hand\"",
                                 "speed(",
                                 "angle(",
                                 "norm(",
                                 "distance(",
                                 "derivative(",
                                 "rate",
                                 "2.jitter",
                                 ")",
                                 ",",
                                 " + ",
                                 "-",
                                 "*",
                                 "/",
                                 "10 cm",
                                 "3",
                                 "m/s",
                                 " where ",
                                 "type == 2",
                                 "orientation",
                                 "size",
                                 "velocity",
                                 "(",
                                 "\"",
                                 "é",
                                 "wire.",
                                 "matrix.1"};
    const std::vector packets{golden("02_quaternion_counted"), golden("20_joints_counted")};
    std::mt19937 random(4);
    std::size_t compiled = 0;
    for (int i = 0; i < 20'000; ++i) {
        std::string text;
        for (std::size_t pieces = random() % 8; pieces-- > 0;) {
            text += kPieces[random() % kPieces.size()];
        }
        const auto tree = parsedSignal(text);
        if (!tree) {
            EXPECT_LE(tree.error().offset + tree.error().length, text.size()) << text;
            EXPECT_FALSE(tree.error().text.empty()) << text;
        } else {
            ++compiled;
            EXPECT_EQ(tree->quantity.components, 1U) << text;
            for (const Case& packet : packets) {
                const Candidate candidate = packet.candidate();
                Subject subject(candidate);
                std::size_t last = 7;
                for (const SignalSource& source : tree->sources) {
                    static_cast<void>(source.read(subject, last));
                }
            }
        }
        const std::size_t cursor = text.empty() ? 0 : random() % text.size();
        for (const Completion& one :
             i % 50 == 0 ? signalCompletions(text, cursor) : std::vector<Completion>()) {
            EXPECT_LE(one.offset, cursor) << text;
            EXPECT_LE(one.offset + one.length, text.size()) << text;
        }
    }
    EXPECT_GT(compiled, 200U);
}

/// `|` marks the cursor.
std::vector<std::string> offers(std::string text) {
    const std::size_t cursor = text.find('|');
    text.erase(cursor, 1);
    std::vector<std::string> found;
    for (const Completion& one : signalCompletions(text, cursor)) {
        found.push_back(one.text);
        EXPECT_LE(one.offset + one.length, text.size());
    }
    return found;
}

TEST(SignalCompletion, OffersWhatCanFollow) {
    EXPECT_THAT(offers("|"), AllOf(IsSupersetOf({"norm(", "speed(", "position", "2.jitter"}),
                                   Not(Contains("source")), Not(Contains("tag"))));
    EXPECT_THAT(offers("speed(2.pos|"), AllOf(Contains("2.position"), Not(Contains("position"))));
    EXPECT_THAT(offers("20.|"),
                AllOf(IsSupersetOf({"20.rotation", "20.rate"}), Not(Contains("20.position"))));
    EXPECT_THAT(offers("position.z |"), IsSupersetOf({"of", "+", "where"}));
    EXPECT_THAT(offers("delta |"), Not(Contains("of")));
    EXPECT_THAT(offers("2.position.z of Left|"), AllOf(Contains("LeftHand"), Not(Contains("jLeftKnee"))));
    EXPECT_THAT(offers("20.rotation.z of |"), AllOf(Contains("jRightKnee"), Not(Contains("LeftHand"))));
    EXPECT_THAT(offers("position.z - 10 |"), IsSupersetOf({"cm", "-"}));
    EXPECT_THAT(offers("position.z where char|"), Contains("character"));
    EXPECT_THAT(offers("angle(orientation of Head, |"), Contains("orientation"));
}

TEST(FilterCompletion, OffersItems) {
    const std::string text = "position.z of LeftH";
    EXPECT_THAT(completions(text, text.size()).front().text, "LeftHand");
}

} // namespace
} // namespace posewire::filter::test
