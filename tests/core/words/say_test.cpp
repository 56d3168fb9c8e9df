// SPDX-License-Identifier: MIT
#include "core/words/say.h"

#include "tests/support/facts.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

namespace posewire::words {
namespace {

/// A value of each name that the table has, of one and of many.
std::vector<NamedValue> valuesOf(std::uint64_t number) {
    const bool isOne = number == 1;
    std::vector<std::string> names{"Ana", "Jonas", "Mira"};
    names.resize(number);
    std::vector<std::string> types{"02", "12", "20"};
    types.resize(number);
    const auto missing = Fact{Kind::Lost, {{"n", counted(Kind::Samples, number)}}};
    const Fact reason{Kind::Loss, {{"amount", missing}, {"who", names}, {"cause", Fact{Kind::CauseNetwork}}}};
    return {
        {"n", number},
        {"hosts", number},
        {"text", std::string("A text")},
        {"types", types},
        {"type", std::string("21")},
        {"who", names},
        {"names", names},
        {"last", std::string("Mira")},
        {"segments", names},
        {"address", std::string("192.0.2.1:4000")},
        {"port", std::string("4001")},
        {"from", std::string("10:00:00")},
        {"to", std::string("10:00:09")},
        {"what", reason},
        {"reason", reason},
        {"when", Fact{Kind::Since, {{"from", std::string("10:00:00")}}}},
        {"lasts", Fact{isOne ? Kind::Over : Kind::GoingOn}},
        {"amount", missing},
        {"missing", missing},
        {"gaps", counted(Kind::Gaps, number)},
        {"cause", Fact{isOne ? Kind::CauseUnknown : Kind::CauseThisComputer}},
        {"evidence", Fact{Kind::PartOfMessage}},
        {"dropped", counted(Kind::Datagrams, number)},
        {"packets", counted(Kind::Packets, number)},
        {"count", counted(Kind::Datagrams, number)},
        {"datagrams", counted(Kind::Datagrams, number)},
        {"samples", counted(Kind::Samples, number)},
        {"streams", counted(Kind::Streams, number)},
        {"objects", counted(Kind::Objects, number)},
        {"sample", number},
        {"step", number},
        {"before", number},
        {"rate", Number{60}},
        {"value", Number{12.5, 1}},
        {"limit", Number{10, 2, true}},
        {isOne ? "silence" : "left", Number{1.25, 2}},
        {isOne ? "back" : "forward", Number{0.5, 3}},
        {"lasted", Number{3.04, 1}},
        {"moved", Number{2000}},
        {"seconds", number},
        {"id", number},
        {"others", names},
        {"other", Fact{Kind::Port, {{"port", std::string("4001")}}}},
        {"changes", std::string("name: Ana → Mira")},
        {"problem", std::string("the disk is full")},
        {"probe", std::string("STAGE-A")},
        {"file", std::string("take part 2.pcapng")},
        {"declared", Fact{Kind::RevisionE}},
        {"looks", Fact{Kind::Metres}},
        {"read", Fact{Kind::Centimetres}},
        {"name", std::string("Pelvis")},
        {"known", std::string("jL5S1")},
        {"parts", types},
        {"all", std::uint64_t{23}},
        {"body", std::uint64_t{23}},
        {"props", counted(Kind::Props, number)},
        {"fingers", std::uint64_t{40}},
        {"height", Number{1.75, 2}},
        {"metres", Number{1.75, 2}},
        {"factor", Number{0.01, 4}},
        {"axis", std::string("−y")},
        {"ports", std::uint64_t{3}},
        {"protocol", std::string("UDP")},
        {"host", std::string("192.0.2.1")},
        {isOne ? "command" : "no command", std::string("sudo ufw allow 9763/udp")},
        {"first", std::string("Ana")},
        {"second", std::string("Jonas")},
        {"path", std::string("take.csv")},
        {"restarts", Fact{Kind::RestartedTimes, {{"n", number}}}},
        {isOne ? "pause" : "no pause", Fact{Kind::PauseLeftOut}},
        {isOne ? "written" : "unwritten", std::string("Y-up")},
        {"doubt", Fact{Kind::ReferenceBody}},
        {isOne ? "scale" : "no scale", Fact{Kind::MeshScale}},
        {"brief", Fact{Kind::AssumedBody}},
    };
}

constexpr std::array<std::string_view, kForms> kFormNames{"headline", "sentence", "narrow", "line",
                                                          "brief",    "cell",     "advice"};

/// Whether a text has parts that are left out if a value is missing.
bool hasOptional(const Wording& row) {
    const auto isOptional = [](const Text& text) {
        return text.text != nullptr && std::string_view(text.text).find('[') != std::string_view::npos;
    };
    return isOptional(row.headline) || isOptional(row.sentence) || isOptional(row.brief);
}

/// Every kind in every form that differs from the one before: of one, of many, and without any value.
std::string wholeTable() {
    std::ostringstream all;
    for (const Wording& row : wordings()) {
        std::set<std::string> told;
        for (const std::uint64_t number : {1, 3, 0}) {
            if (number == 0 && !hasOptional(row)) {
                continue;
            }
            const Fact fact{row.kind, number == 0 ? std::vector<NamedValue>() : valuesOf(number)};
            for (std::size_t form = 0; form < kForms; ++form) {
                const std::string text = say(fact, static_cast<Form>(form));
                if (!text.empty() && told.insert(text).second) {
                    all << (number == 0 ? "-" : std::to_string(number)) << ' ' << kFormNames[form] << ": "
                        << text << '\n';
                }
            }
        }
        all << '\n';
    }
    return all.str();
}

/// A changed text is changed in english.txt too: the program writes the table there if POSEWIRE_WRITE is set.
TEST(Words, AreTheGoldenOnes) {
    const std::filesystem::path path = test::sourcePath("tests/core/words/english.txt");
    if (std::getenv("POSEWIRE_WRITE") != nullptr) {
        std::ofstream(path) << wholeTable();
    }
    std::ifstream file(path);
    std::ostringstream golden;
    golden << file.rdbuf();
    EXPECT_EQ(wholeTable(), golden.str());
}

TEST(Words, HaveARowForEachKindInItsOrder) {
    EXPECT_EQ(wordings().size(), kKinds);
    for (std::size_t row = 0; row < wordings().size(); ++row) {
        EXPECT_EQ(static_cast<std::size_t>(wordings()[row].kind), row);
    }
}

TEST(Words, HaveAValueForEveryPlaceholder) {
    const auto names = [] {
        std::set<std::string_view> known;
        for (const std::uint64_t number : {1, 3}) {
            for (const NamedValue& value : valuesOf(number)) {
                known.insert(value.name);
            }
        }
        return known;
    }();
    for (const Wording& row : wordings()) {
        for (const Text& text :
             {row.headline, row.sentence, row.line, row.brief, row.cell, row.narrow, row.advice}) {
            for (const char* each : {text.text, text.one}) {
                const std::string_view whole = each == nullptr ? "" : each;
                EXPECT_EQ(std::ranges::count(whole, '{'), std::ranges::count(whole, '}')) << whole;
                EXPECT_EQ(std::ranges::count(whole, '['), std::ranges::count(whole, ']')) << whole;
                for (std::size_t at = whole.find('{'); at != std::string_view::npos;
                     at = whole.find('{', at + 1)) {
                    EXPECT_TRUE(names.contains(whole.substr(at + 1, whole.find('}', at) - at - 1))) << whole;
                }
            }
        }
    }
}

TEST(Say, CountsOneAndMany) {
    EXPECT_EQ(say(counted(Kind::Samples, 1), Form::Headline), "1 sample");
    EXPECT_EQ(say(counted(Kind::Samples, 12'345), Form::Headline), "12\u202f345 samples");
    EXPECT_EQ(say(counted(Kind::Samples, 12), Form::Cell), "12");
    EXPECT_EQ(say(typesFact({2}), Form::Headline), "type 02");
    EXPECT_EQ(say(typesFact({2, 12, 20}), Form::Headline), "types 02, 12 and 20");
}

TEST(Say, TakesTheNumberOfTheFirstPlaceholder) {
    Fact two{Kind::TwoSenders, {{"address", std::string("a")}, {"others", std::string("b")}}};
    set(two, "who", std::vector<std::string>{"Ana"});
    EXPECT_EQ(say(two, Form::Headline), "Ana comes from several senders at once, a and also b");
    set(two, "who", std::vector<std::string>{"Ana", "Mira"});
    EXPECT_EQ(say(two, Form::Headline), "Ana and Mira come from several senders at once, a and also b");
    set(two, "who", counted(Kind::Characters, 5));
    EXPECT_EQ(say(two, Form::Headline), "5 characters come from several senders at once, a and also b");
}

TEST(Say, LeavesOutWhatIsNotKnown) {
    Fact outage{Kind::Outage, {{"who", std::string("Ana")}}};
    EXPECT_EQ(say(outage, Form::Sentence), "No data.");
    EXPECT_EQ(say(outage, Form::Headline), "no data from Ana");
    set(outage, "lasted", Number{1.5, 2});
    set(outage, "cause", Fact{Kind::CauseSender});
    EXPECT_EQ(say(outage, Form::Sentence), "No data for 1.50 s, cause: sender's side.");
    EXPECT_EQ(say(outage, Form::Headline), "no data from Ana, sender's side");
    set(outage, "cause", Fact());
    EXPECT_EQ(say(outage, Form::Headline), "no data from Ana");
}

TEST(Say, SaysPartsInTheFormOfTheWhole) {
    const Fact loss{Kind::Loss,
                    {{"amount", Fact{Kind::Lost, {{"n", counted(Kind::Samples, 37)}}}},
                     {"who", std::string("Ana")},
                     {"cause", Fact{Kind::CauseNetwork}}}};
    const Fact verdict{Kind::NotGood,
                       {{"reason", loss},
                        {"when", Fact{Kind::Since, {{"from", std::string("10:00:00")}}}},
                        {"lasts", Fact{Kind::Over}}}};
    EXPECT_EQ(say(verdict, Form::Headline),
              "Not good: 37 samples lost on Ana, network, since 10:00:00, over");
    EXPECT_EQ(say(verdict, Form::Narrow), "Not good, over: 37 samples lost on Ana, network, since 10:00:00");
    EXPECT_EQ(say(verdict, Form::Brief), "37 lost, network, over");
    EXPECT_EQ(say(verdict, Form::Cell), "37 lost, over");
}

TEST(Say, LooksEachTextUpInTheLanguage) {
    const Language shouted = [](const Text& text, std::uint64_t number) {
        return (number == 1 ? "ONE " : "MANY ") + std::string(text.text);
    };
    EXPECT_EQ(say({Kind::Reordered, {{"count", counted(Kind::Datagrams, 1)}}}, Form::Sentence, shouted),
              "ONE ONE 1 datagrams came after a later one.");
}

TEST(Facts, AreClippedInTheirTexts) {
    Fact fact{Kind::MetadataChanged, {{"changes", std::string(100, 'x')}}};
    EXPECT_GT(memoryBytes(fact), 100U);
    clip(fact, 20);
    EXPECT_EQ(std::get<std::string>(*find(fact, "changes")), std::string(17, 'x') + "…");
}

} // namespace
} // namespace posewire::words
