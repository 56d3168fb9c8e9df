// SPDX-License-Identifier: MIT
#include "core/export/reports.h"
#include "core/model/session/session.h"
#include "tests/core/performer/faulty_performance.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <map>
#include <memory>

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

struct Faulty {
    std::string name;
    performer::FaultSettings settings;
    friend std::ostream& operator<<(std::ostream& out, const Faulty& faulty) { return out << faulty.name; }
};

std::vector<Faulty> kinds() {
    std::vector<Faulty> all(6);
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
    return all;
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

TEST_P(Reports, GiveTheSameVerdictInHtml) {
    const std::string text = monitored.report["verdict"]["text"];
    EXPECT_THAT(monitored.html, testing::HasSubstr("<span>" + text + ".</span>"));
    const bool isGood = monitored.report["verdict"]["state"] == "good";
    EXPECT_EQ(isGood, GetParam().name == "None") << text;
}

TEST_P(Reports, GiveTheSameFiguresInHtml) {
    for (const Json& stream : streams()) {
        const std::string datagrams =
            "<td class=\"n\">" + std::to_string(stream["datagrams"].get<std::uint64_t>());
        EXPECT_THAT(monitored.html, testing::HasSubstr(datagrams)) << stream;
    }
    EXPECT_THAT(monitored.html, testing::HasSubstr("10.0.0.7:40001"));
    EXPECT_EQ(monitored.html.find("NaN"), std::string::npos);
    EXPECT_EQ(monitored.html.find("inf"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(, Reports, testing::ValuesIn(kinds()),
                         [](const auto& instance) { return instance.param.name; });

} // namespace
} // namespace posewire::exporting
