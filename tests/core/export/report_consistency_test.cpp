// SPDX-License-Identifier: MIT
#include "core/export/reports.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/session/session.h"
#include "core/wire/type_table.h"
#include "tests/core/performer/faulty_performance.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <memory>
#include <optional>

// What the reports of one session say is the same in each of them, adds up, and is what was sent.
namespace posewire::exporting {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

constexpr log::Stamp kStart(1'700'000'000s);

/// A session that has seen a performance with faults; the reports of it.
class Monitored {
public:
    Monitored(const performer::PerformerSettings& performance, const performer::FaultSettings& faults)
        : m_sendings(performer::performWithFaults(performance, faults, 4)) {
        const log::SenderId sender = m_log.senders().intern({"10.0.0.7:40001", log::Transport::Udp, 9763});
        log::Arrival arrival;
        arrival.sender = sender;
        for (const performer::Sending& sending : m_sendings) {
            arrival.stamp = kStart + sending.due;
            m_log.writer().append(sending.bytes, arrival);
        }
        m_log.writer().publish();
        m_session.follow(arrival.stamp);
        m_session.settle();
        report = Json::parse(monitorReport(m_session, {6, 0, {}}));
        html = streamReport(m_session, {});
    }

    [[nodiscard]] performer::Truth truth() const { return performer::truthOf(m_sendings); }

    Json report;
    std::string html;

private:
    std::vector<performer::Sending> m_sendings;
    log::PacketLog m_log{{.memoryCap = std::size_t{1} << 27, .chunkSize = std::size_t{1} << 20}};
    model::Session m_session{m_log};
};

performer::PerformerSettings twoCharacters() {
    performer::PerformerSettings settings;
    settings.characters = 2;
    settings.types = {2, 21, 25, 12, 13};
    settings.rateHz = 60;
    settings.motion = "tpose";
    return settings;
}

/// What stands between two marks from a place on, which moves behind it.
std::optional<std::string> between(const std::string& text, std::size_t& at, const std::string& before,
                                   const std::string& after) {
    const std::size_t begin = text.find(before, at);
    const std::size_t end = begin == std::string::npos ? begin : text.find(after, begin + before.size());
    if (end == std::string::npos) {
        return std::nullopt;
    }
    at = end + after.size();
    return text.substr(begin + before.size(), end - begin - before.size());
}

/// Of all elements of a name, without what is in them.
std::vector<std::string> textsOf(const std::string& html, const std::string& element) {
    std::vector<std::string> texts;
    std::size_t at = 0;
    while (const auto cell = between(html, at, "<" + element, "</" + element + ">")) {
        std::string text;
        bool isInside = false;
        for (const char letter : '<' + *cell) {
            text += isInside || letter == '<' ? "" : letter == '>' ? "" : std::string(1, letter);
            isInside = letter == '<' || (isInside && letter != '>');
        }
        texts.push_back(text);
    }
    return texts;
}

/// A number as people read it.
double numberOf(std::string text) {
    for (const auto& [shown, plain] : {std::pair{"\u202f", ""}, {"−", "-"}, {"+", ""}}) {
        for (std::size_t at = text.find(shown); at != std::string::npos; at = text.find(shown)) {
            text.replace(at, std::string(shown).size(), plain);
        }
    }
    return std::stod(text);
}

struct Faulty {
    std::string name;
    performer::FaultSettings settings;
    friend std::ostream& operator<<(std::ostream& out, const Faulty& faulty) { return out << faulty.name; }
};

std::vector<Faulty> kinds() {
    std::vector<Faulty> all(7);
    all[0].name = "None";
    all[1].name = "Loss";
    all[1].settings.drop = 0.03;
    all[2].name = "Duplicates";
    all[2].settings.duplicate = 0.05;
    all[3].name = "Reordering";
    all[3].settings.reorder = 0.05;
    all[4].name = "Damage";
    all[4].settings.corrupt = 0.02;
    all[4].settings.truncate = 0.02;
    all[5].name = "Everything";
    all[5].settings.drop = all[5].settings.duplicate = all[5].settings.reorder = 0.02;
    all[5].settings.truncate = 0.01;
    all[5].settings.jitterMs = 3;
    all[6].name = "Split";
    all[6].settings.splits = true;
    all[6].settings.drop = 0.03;
    return all;
}

/// What three tables say of a stream, by the titles of their columns.
std::map<std::string, std::string> tellingsOf(const std::string& html, const Json& stream) {
    const auto type = static_cast<std::uint8_t>(std::stoi(stream["type"].get<std::string>()));
    std::map<std::string, std::string> tellings;
    std::size_t at = html.find("character " + stream["character"].dump() + "</span></h3>");
    for (const char* first : {"What arrived", "Whose loss", "When it arrived"}) {
        std::size_t end = at;
        const auto table = between(html, end, "<table>", "</table>");
        if (!table || table->find(first) == std::string::npos) {
            continue; // none of its streams has such figures
        }
        at = end;
        const std::vector<std::string> titles = textsOf(*table, "th");
        std::size_t row = 0;
        while (const auto cells = between(*table, row, "<tr>", "</tr>")) {
            const std::vector<std::string> texts = textsOf(*cells, "td");
            for (std::size_t i = 0; i < texts.size() && texts[0] == wire::typeTitle(type); ++i) {
                tellings[titles.at(i)] = texts[i];
            }
        }
    }
    return tellings;
}

class Reports : public testing::TestWithParam<Faulty> {
protected:
    /// Each kind is performed once for all tests.
    static const Monitored& performed(const Faulty& faulty) {
        static std::map<std::string, std::unique_ptr<Monitored>> all;
        std::unique_ptr<Monitored>& one = all[faulty.name];
        if (one == nullptr) {
            one = std::make_unique<Monitored>(twoCharacters(), faulty.settings);
        }
        return *one;
    }
    const Monitored& monitored = performed(GetParam());

    [[nodiscard]] std::vector<Json> streams() const {
        std::vector<Json> all;
        for (const Json& source : monitored.report["sources"]) {
            for (const Json& character : source["characters"]) {
                for (Json stream : character["streams"]) {
                    stream["character"] = character["id"];
                    all.push_back(std::move(stream));
                }
            }
        }
        return all;
    }
    static bool isSampled(const Json& stream) { return stream["type"] != "12" && stream["type"] != "13"; }
};

TEST_P(Reports, ListEachStreamThatWasSentWithWhatItsSenderKnows) {
    const performer::Truth truth = monitored.truth();
    const auto all = streams();
    EXPECT_EQ(all.size(), truth.streams().size());
    for (const Json& stream : all) {
        const auto type = static_cast<std::uint8_t>(std::stoi(stream["type"].get<std::string>()));
        const auto found = truth.streams().find({stream["character"], type});
        ASSERT_NE(found, truth.streams().end()) << stream;
        const performer::SentFigures sent = found->second.figures();
        EXPECT_EQ(stream["datagrams"], sent.datagrams) << stream["type"];
        EXPECT_EQ(stream["incomplete"], sent.incomplete) << stream["type"];
        if (isSampled(stream)) {
            EXPECT_EQ(stream["samples"], sent.samples) << stream["type"];
            EXPECT_EQ(stream["lost"], sent.lost) << stream["type"];
            EXPECT_EQ(stream["duplicates"], sent.duplicates) << stream["type"];
            EXPECT_EQ(stream["reordered"], sent.reordered) << stream["type"];
            EXPECT_EQ(stream["late"], sent.late) << stream["type"];
        }
    }
    const Json& source = monitored.report["sources"][0];
    EXPECT_EQ(source["datagrams"], truth.sender().datagrams);
    EXPECT_EQ(source["malformed"], truth.sender().malformed);
    EXPECT_EQ(monitored.report["foreignDatagrams"], truth.sender().foreign);
}

TEST_P(Reports, AddUp) {
    std::uint64_t datagrams = 0;
    for (const Json& stream : streams()) {
        datagrams += stream["datagrams"].get<std::uint64_t>();
        if (!isSampled(stream)) {
            continue;
        }
        const std::uint64_t lost = stream["lost"];
        const std::uint64_t incomplete = stream["incomplete"];
        const std::uint64_t samples = stream["samples"];
        const std::uint64_t first = stream["firstSample"];
        const std::uint64_t last = stream["lastSample"];
        const std::uint64_t step = stream["step"];
        if (step == 0) {
            EXPECT_EQ(samples + incomplete, 1U) << "only one sample has no spacing: " << stream;
            continue;
        }
        EXPECT_EQ((last - first) / step + 1, samples + incomplete + lost);
        std::uint64_t attributed = 0;
        for (const auto& [cause, count] : stream["causes"].items()) {
            attributed += count.get<std::uint64_t>();
        }
        EXPECT_EQ(attributed, lost + incomplete) << stream;
        const double share =
            100.0 * static_cast<double>(lost + incomplete) / static_cast<double>(samples + lost + incomplete);
        EXPECT_NEAR(stream["lossPercent"], share, 1e-4) << stream;
        const Json& interval = stream["intervalMs"];
        EXPECT_LE(interval["least"], interval["mean"]);
        EXPECT_LE(interval["mean"], interval["most"]);
        EXPECT_GE(interval["deviation"], 0);
        EXPECT_LE(stream["late"], stream["reordered"]);
    }
    EXPECT_EQ(datagrams, monitored.report["sources"][0]["datagrams"]);
}

TEST_P(Reports, TellInIncidentsWhatStreamsLostByCause) {
    std::map<std::string, std::uint64_t> lost;
    for (const Json& stream : streams()) {
        for (const auto& [cause, count] : stream["causes"].items()) {
            lost[cause] += count.get<std::uint64_t>();
        }
    }
    std::map<std::string, std::uint64_t> told;
    for (const Json& incident : monitored.report["incidents"]) {
        if (const std::uint64_t samples = incident["samples"]; samples != 0) {
            told[incident["cause"]] += samples;
        }
    }
    std::erase_if(lost, [](const auto& one) { return one.second == 0; });
    EXPECT_EQ(told, lost);
}

TEST_P(Reports, TellInIncidentsWhatStreamsHadTwice) {
    std::uint64_t twice = 0;
    for (const Json& stream : streams()) {
        twice += stream["duplicates"].get<std::uint64_t>();
        const auto tellings = tellingsOf(monitored.html, stream);
        EXPECT_EQ(numberOf(tellings.at("Duplicates")), stream["duplicates"]) << stream;
    }
    std::uint64_t told = 0;
    for (const Json& incident : monitored.report["incidents"]) {
        told += incident["kind"] == "duplicates" ? incident["count"].get<std::uint64_t>() : 0;
    }
    EXPECT_EQ(told, twice);
    if (twice != 0) {
        const std::string words = " datagrams came more than once.</span>";
        EXPECT_THAT(monitored.html, testing::HasSubstr(">" + std::to_string(twice) + words));
    }
}

TEST_P(Reports, GiveTheSameVerdictInHtml) {
    const std::string text = monitored.report["verdict"]["text"];
    EXPECT_THAT(monitored.html, testing::HasSubstr("<span>" + text + ".</span>"));
    const bool isGood = monitored.report["verdict"]["state"] == "good";
    EXPECT_EQ(isGood, GetParam().name == "None") << text;
}

TEST_P(Reports, GiveTheSameFiguresInHtml) {
    for (const Json& stream : streams()) {
        const auto tellings = tellingsOf(monitored.html, stream);
        EXPECT_GE(tellings.size(), isSampled(stream) ? 20U : 10U);
        const std::uint64_t missing =
            stream["lost"].get<std::uint64_t>() + stream["incomplete"].get<std::uint64_t>();
        EXPECT_EQ(tellings.contains("Lost on the network"), missing != 0) << stream;
        std::size_t compared = 0;
        for (const model::FigureRow& row : model::figureTable()) {
            const auto told = tellings.find(row.title);
            if (row.key.empty() || told == tellings.end()) {
                continue;
            }
            const std::size_t dot = row.key.find('.');
            const Json& parent =
                dot == std::string_view::npos ? stream : stream[std::string(row.key.substr(0, dot))];
            const double value = parent[std::string(row.key.substr(dot + 1))];
            if (told->second.empty()) {
                const bool isUnknown = row.style.form == model::FigureForm::Signed;
                EXPECT_TRUE(value == 0 || isUnknown || !isSampled(stream)) << row.title << stream;
                continue;
            }
            const bool isWhole =
                row.style.form == model::FigureForm::Count || row.style.form == model::FigureForm::Counter;
            const double unit = isWhole ? 0 : std::pow(10.0, -row.style.digits.report);
            const double factor = row.style.form == model::FigureForm::Share ? 100 : 1;
            EXPECT_NEAR(numberOf(told->second), factor * value, 0.51 * unit) << row.title << stream;
            ++compared;
        }
        EXPECT_GE(compared, isSampled(stream) ? 18U : 2U) << stream;
    }
    EXPECT_THAT(monitored.html, testing::HasSubstr("10.0.0.7:40001"));
    EXPECT_EQ(monitored.html.find("NaN"), std::string::npos);
    EXPECT_EQ(monitored.html.find("inf"), std::string::npos);
}

TEST_P(Reports, DrawWhatStreamsLostByCause) {
    std::size_t at = monitored.html.find("<b>Samples lost, by cause</b>");
    ASSERT_NE(at, std::string::npos);
    const std::string plot = between(monitored.html, at, "<svg", "</svg>").value();
    // The scale, from two of its labels.
    std::vector<std::pair<double, double>> labels; // value, and place from the top
    std::size_t label = 0;
    while (const auto element = between(plot, label, "<text ", "</text>")) {
        std::size_t place = 0;
        const double y = std::stod(between(*element, place, "y=\"", "\"").value());
        if (element->find("\"end\"") != std::string::npos && element->find(" s") == std::string::npos) {
            labels.emplace_back(std::stod(element->substr(element->find('>') + 1)), y);
        }
    }
    ASSERT_GE(labels.size(), 2U);
    const double perPlace =
        (labels.back().first - labels.front().first) / (labels.front().second - labels.back().second);
    for (const auto& [cause, colour] :
         {std::pair{"thisComputer", "c1"}, {"network", "c0"}, {"sender", "c3"}, {"unknown", "c6"}}) {
        double lost = 0;
        for (const Json& stream : streams()) {
            lost += isSampled(stream) ? stream["causes"][cause].get<double>() : 0;
        }
        double drawn = 0;
        std::size_t bar = 0;
        while (const auto element = between(plot, bar, "<rect class=\"bar " + std::string(colour), "/>")) {
            std::size_t place = 0;
            drawn += perPlace * std::stod(between(*element, place, "height=\"", "\"").value());
        }
        EXPECT_NEAR(drawn, lost, 1 + lost / 20) << cause;
    }
}

INSTANTIATE_TEST_SUITE_P(, Reports, testing::ValuesIn(kinds()),
                         [](const auto& instance) { return instance.param.name; });

} // namespace
} // namespace posewire::exporting
