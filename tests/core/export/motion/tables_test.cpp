// SPDX-License-Identifier: MIT
#include "tests/core/export/csv_rows.h"
#include "tests/core/export/motion/motion_fixture.h"
#include "tests/support/hostile_text.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <set>

namespace posewire::exporting {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

class MotionCsvTest : public MotionTest {};
class MotionJsonLinesTest : public MotionTest {};

TEST_F(MotionCsvTest, NamesItsColumnsWithUnits) {
    auto whole = settings();
    whole.props = 1;
    whole.fingers = true;
    perform(whole, 2);
    const auto head = rowsOf(written("csv", source()))[0];
    EXPECT_EQ(head.size(), 8U + 8U * (23 + 1 + 40));
    EXPECT_EQ((std::vector(head.begin(), head.begin() + 16)),
              (std::vector<std::string>{"character", "id", "run", "sample", "time (s)",
                                        "received (ns since 1970 UTC)", "time code (ms)", "type",
                                        "Pelvis x (m)", "Pelvis y (m)", "Pelvis z (m)", "Pelvis qw",
                                        "Pelvis qx", "Pelvis qy", "Pelvis qz", "L5 x (m)"}));
    EXPECT_EQ(head[8 + 7 * 23], "Prop1 x (m)");
    EXPECT_EQ(head[8 + 7 * 24], "LeftCarpus x (m)");
    EXPECT_EQ(head[8 + 7 * 64], "Pelvis from");
    EXPECT_EQ(head[8 + 7 * 64 + 23], "Prop1 from");
}

TEST_F(MotionCsvTest, HoldsWhatWasSentToTheLastBit) {
    perform(settings(2), 60);
    const auto rows = rowsOf(written("csv", source()));
    ASSERT_EQ(rows.size(), 121U);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const auto& row = rows[i];
        ASSERT_EQ(row.size(), rows[0].size());
        const auto& poses = sent(static_cast<std::uint8_t>(std::stoi(row[1])),
                                 static_cast<std::uint32_t>(std::stoul(row[3])));
        for (std::size_t segment = 0; segment < poses.size(); ++segment) {
            const std::size_t cell = 8 + 7 * segment;
            EXPECT_EQ(std::stof(row[cell]), static_cast<float>(poses[segment].position.x()));
            EXPECT_EQ(std::stof(row[cell + 2]), static_cast<float>(poses[segment].position.z()));
            EXPECT_EQ(std::stof(row[cell + 3]), static_cast<float>(poses[segment].orientation.w()));
            EXPECT_EQ(std::stof(row[cell + 6]), static_cast<float>(poses[segment].orientation.z()));
            EXPECT_EQ(row[8 + 7 * poses.size() + segment], "sent");
        }
    }
    EXPECT_EQ(rows[1][0], source().characters[0].name.shown());
    EXPECT_EQ(rows[1][5], "1700000000000000000");
    EXPECT_EQ(rows[1][6], "36000000");
    EXPECT_EQ(rows[1][7], "02");
}

TEST_F(MotionCsvTest, HasEmptyRowsForGapsAndCountsRuns) {
    perform(settings(), 200, without({5}));
    perform(settings(), 10, sendsAll, kStart + 10s);
    const auto rows = rowsOf(written("csv", source()));
    ASSERT_EQ(rows.size(), 211U);
    EXPECT_EQ(rows[5][3], "5");
    EXPECT_EQ(rows[5][4], "0.066667");
    for (std::size_t cell = 5; cell < rows[5].size(); ++cell) {
        EXPECT_EQ(rows[5][cell], "");
    }
    EXPECT_EQ(rows[5].size(), rows[0].size());
    EXPECT_EQ(rows[200][2], "1");
    EXPECT_EQ(rows[201][2], "2");
    EXPECT_EQ(rows[201][3], "1");
    EXPECT_EQ(rows[201][4], "10.000000");
}

TEST_F(MotionJsonLinesTest, IsAnObjectForEachSample) {
    perform(settings(), 30, without({7}));
    std::istringstream lines(written("jsonl", source()));
    std::uint32_t sample = 0;
    for (std::string line; std::getline(lines, line);) {
        const Json object = Json::parse(line);
        EXPECT_EQ(object["sample"], ++sample);
        EXPECT_EQ(object["run"], 1);
        EXPECT_EQ(object["segments"].is_null(), sample == 7);
        if (sample == 7) {
            continue;
        }
        const auto& poses = sent(0, sample);
        ASSERT_EQ(object["segments"].size(), poses.size());
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const Json& segment = object["segments"][i];
            EXPECT_EQ(segment["id"], i + 1);
            EXPECT_EQ(segment["position"][1].get<float>(), static_cast<float>(poses[i].position.y()));
            EXPECT_EQ(segment["orientation"][0].get<float>(), static_cast<float>(poses[i].orientation.w()));
        }
        EXPECT_EQ(object["segments"][6]["name"], "Head");
        EXPECT_EQ(object["segments"][6]["from"], "sent");
        EXPECT_EQ(object["type"], "02");
        EXPECT_EQ(object["timeCode"], 36'000'000 + std::lround((sample - 1) * 1000 / 60.0));
    }
    EXPECT_EQ(sample, 30U);
}

/// Types 21 alone have positions: how segments are turned is solved, or assumed.
TEST_F(MotionCsvTest, SaysWhichSegmentsWereNotSent) {
    auto linear = settings();
    linear.types = {21, 13};
    perform(linear, 30);
    const auto rows = rowsOf(written("csv", source()));
    const feed::PoseSource from = source();
    const auto frames = framesOf(from);
    ASSERT_EQ(rows.size(), frames.size() + 1);
    constexpr std::array kWords{"", "assumed", "solved", "sent"};
    std::istringstream lines(written("jsonl", from));
    std::set<std::string> found;
    std::string line;
    for (std::size_t i = 0; i < frames.size() && std::getline(lines, line); ++i) {
        const Json object = Json::parse(line);
        for (std::size_t segment = 0; segment < 23; ++segment) {
            const auto source = frames[i].pose.sources[segment].weaker();
            const std::string& word = rows[i + 1][8 + 7 * 23 + segment];
            EXPECT_EQ(word, kWords[static_cast<std::size_t>(source)]);
            EXPECT_EQ(object["segments"][segment]["from"], word);
            found.insert(word);
        }
    }
    EXPECT_FALSE(found.contains("sent"));
    EXPECT_FALSE(found.empty());
}

class HostileMotionTest : public MotionTest, public testing::WithParamInterface<std::string> {
protected:
    HostileMotionTest() {
        wire::Datagram datagram;
        datagram.body = wire::MetaData{true, "name:" + GetParam() + "\n"};
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        send(datagram, kStart);
        perform(settings(2), 3, [](const wire::Datagram& one) { return one.header.type() != 12; });
    }
};

TEST_P(HostileMotionTest, NamesAreNoFormulasAndNoMoreCells) {
    std::string csv = written("csv", source());
    EXPECT_EQ(std::ranges::count(csv, '\n'), 7);
    std::erase(csv, '\r');
    EXPECT_EQ(test::harmIn(csv), "");
    for (const char* formula : {"\n=", "\n@", "\n\"=", "\n\"@"}) {
        EXPECT_THAT(csv, Not(HasSubstr(formula)));
    }
}

TEST_P(HostileMotionTest, NamesAreTextInJson) {
    std::istringstream lines(written("jsonl", source()));
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
        const Json object = Json::parse(line, nullptr, false);
        EXPECT_TRUE(object.is_object());
        EXPECT_LT(object["character"].get<std::string>().size(), 300U);
    }
    EXPECT_EQ(count, 6U);
}

INSTANTIATE_TEST_SUITE_P(Names, HostileMotionTest, testing::ValuesIn(test::hostileNames()));

} // namespace
} // namespace posewire::exporting
