// SPDX-License-Identifier: MIT
#include "core/export/sheets.h"
#include "core/model/session/session.h"
#include "core/words/say.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <random>
#include <set>

// Every kind of event with everything that it can be about: its table and its objects say the same.
namespace posewire::exporting {
namespace {

using Json = nlohmann::json;
using Row = std::vector<std::string>;

/// A table as RFC 4180 defines it, read by its grammar.
std::vector<Row> tableOf(std::string_view csv) {
    std::vector<Row> rows(1, Row(1));
    bool isQuoted = false;
    for (std::size_t i = 0; i < csv.size(); ++i) {
        const char character = csv[i];
        if (isQuoted && character == '"' && i + 1 < csv.size() && csv[i + 1] == '"') {
            rows.back().back() += csv[++i];
        } else if (character == '"') {
            isQuoted = !isQuoted;
        } else if (!isQuoted && character == ',') {
            rows.back().emplace_back();
        } else if (!isQuoted && csv.substr(i, 2) == "\r\n") {
            rows.emplace_back(1);
            ++i;
        } else {
            rows.back().back() += character;
        }
    }
    EXPECT_FALSE(isQuoted) << "a quote is left open";
    EXPECT_EQ(rows.back(), Row{""}) << "the last line does not end";
    rows.pop_back();
    return rows;
}

class EveryEvent : public testing::Test {
protected:
    EveryEvent() {
        constexpr std::array<std::string_view, 4> details{"Plain.", "A, b.", "Say \"no\"\r\nor yes.",
                                                          "Über 3 °."};
        for (std::size_t i = 0; i < 40 * model::kIncidentKinds; ++i) {
            model::Incident event;
            event.number = i;
            event.kind = static_cast<model::IncidentKind>(i % model::kIncidentKinds);
            event.sender = static_cast<log::SenderId>(pick(3));
            if (pick(2) == 1) {
                event.parts.push_back({event.sender, static_cast<std::uint8_t>(pick(256)),
                                       static_cast<std::uint8_t>(1 + pick(25))});
            }
            event.firstStamp = log::stampOf(static_cast<std::int64_t>(m_random() >> 2));
            event.lastStamp = event.firstStamp + log::Duration(pick(10'000'000'000));
            event.firstPacket = pick(1'000'000);
            event.lastPacket = event.firstPacket + pick(100);
            event.count = 1 + pick(3);
            event.samples = pick(4);
            event.value = static_cast<double>(pick(5000)) / 10 - 100;
            event.limit = static_cast<double>(pick(500)) / 10;
            if (pick(2) == 1) {
                event.cause = static_cast<model::LossCause>(pick(model::kLossCauses));
            }
            event.detail = {words::Kind::Text, {{"text", std::string(details[pick(details.size())])}}};
            event.isCurrent = pick(2) == 1;
            m_events.push_back(event);
        }
        for (const model::Incident& event : m_events) {
            m_shown.push_back(&event);
        }
    }

    std::size_t pick(std::size_t below) { return m_random() % below; }

    log::PacketLog m_log{{.memoryCap = std::size_t{1} << 22, .chunkSize = std::size_t{1} << 20}};
    model::Session m_session{m_log};
    std::mt19937_64 m_random{18};
    std::deque<model::Incident> m_events;
    std::vector<const model::Incident*> m_shown;
};

TEST_F(EveryEvent, IsTheSameInTheTableAndInTheObjects) {
    const auto table = tableOf(eventsCsv({m_session, m_shown}));
    const Json objects = Json::parse(eventsJson({m_session, m_shown}));
    ASSERT_EQ(table.size(), m_events.size() + 1);
    ASSERT_EQ(objects.size(), m_events.size());
    const Row& titles = table.front();
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const Row& row = table[i + 1];
        ASSERT_EQ(row.size(), titles.size()) << i;
        for (std::size_t column = 0; column < titles.size(); ++column) {
            const std::string& title = titles[column];
            if (title == "from" || title == "to" || title == "current" || title == "characters" ||
                title == "types") {
                continue;
            }
            const Json value = objects[i].value(title, Json(""));
            EXPECT_EQ(row[column], value.is_string() ? value.get<std::string>() : value.dump())
                << i << ' ' << title;
        }
        EXPECT_EQ(row[14] == "yes", objects[i]["current"].get<bool>());
    }
}

TEST_F(EveryEvent, KeepsItsStampsToTheNanosecond) {
    const auto table = tableOf(eventsCsv({m_session, m_shown}));
    const Json objects = Json::parse(eventsJson({m_session, m_shown}));
    for (std::size_t i = 0; i < m_events.size(); ++i) {
        const std::string& from = table[i + 1][7];
        const std::size_t point = from.find('.');
        ASSERT_EQ(from.size() - point, 10U) << from;
        EXPECT_EQ(std::stoll(from.substr(0, point) + from.substr(point + 1)),
                  m_events[i].firstStamp.time_since_epoch().count());
        EXPECT_EQ(objects[i]["fromNs"], m_events[i].firstStamp.time_since_epoch().count());
        EXPECT_EQ(objects[i]["toNs"], m_events[i].lastStamp.time_since_epoch().count());
    }
}

TEST_F(EveryEvent, SaysWhatItIsOnOneLine) {
    std::set<std::string_view> names;
    for (const model::Incident& event : m_events) {
        const std::string text = say(event.fact(), words::Form::Sentence);
        names.insert(model::nameOf(event.kind));
        EXPECT_GT(text.size(), 3U) << model::nameOf(event.kind);
        EXPECT_TRUE(text.front() < 'a' || text.front() > 'z') << text;
        EXPECT_EQ(text.find("  "), std::string::npos) << text;
        EXPECT_EQ(text.find("1 samples"), std::string::npos) << text;
        EXPECT_EQ(text.find("1 datagrams "), std::string::npos) << text;
        EXPECT_EQ(text.find("1 gaps"), std::string::npos) << text;
    }
    EXPECT_EQ(names.size(), model::kIncidentKinds) << "two kinds of one name";
}

TEST_F(EveryEvent, IsOfTheGroupOfLimitsWhereItsNameSaysSo) {
    for (const model::Incident& event : m_events) {
        const bool isLimit = model::nameOf(event.kind).ends_with("limit");
        EXPECT_EQ(event.group() == model::IncidentGroup::Limit, isLimit) << model::nameOf(event.kind);
    }
}

} // namespace
} // namespace posewire::exporting
