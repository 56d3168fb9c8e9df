// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/cli/monitor_fixture.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <sstream>

namespace posewire::cli::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::byte> bytesOfText(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

/// Samples 0 to 999 without 100 to 109, one twice, two swapped.
std::string faultyRecording() {
    RecordingFile file;
    for (std::uint32_t sample = 0; sample < 1000; ++sample) {
        if (sample >= 100 && sample < 110) {
            continue;
        }
        file.addPose(sample == 500 ? 501 : sample == 501 ? 500 : sample);
        if (sample == 300) {
            file.addPose(sample);
        }
    }
    return file.finish();
}

TEST(MonitorCommand, ReportsWithTheKeysOfTheInterfaceInItsOrder) {
    const Json report = reportOf(faultyRecording());
    const auto first = [](std::vector<std::string> keys, std::size_t count) {
        keys.resize(std::min(count, keys.size()));
        return keys;
    };
    EXPECT_THAT(first(keysOf(report), 4), ElementsAre("durationS", "local", "foreignDatagrams", "sources"));
    EXPECT_THAT(keysOf(report["local"]), ElementsAre("kernelDropped", "receiveBufferBytes", "overtaken",
                                                     "refusedDatagrams", "reassemblyFailures", "noPort"));
    const Json& sender = report["sources"][0];
    EXPECT_THAT(first(keysOf(sender), 7), ElementsAre("address", "transport", "datagrams", "bytes",
                                                      "malformed", "skippedBytes", "characters"));
    EXPECT_THAT(keysOf(sender["characters"][0]), ElementsAre("id", "name", "streams", "state"));
    EXPECT_THAT(first(keysOf(sender["characters"][0]["streams"][0]), 15),
                ElementsAre("type", "datagrams", "samples", "lost", "duplicates", "reordered", "late",
                            "incomplete", "restarts", "step", "rateHz", "jitterMs", "longestGapSamples",
                            "firstSample", "lastSample"));
}

TEST(MonitorCommand, PrintsALineWhenTheVerdictChangesAndEachInterval) {
    const ProgramRun run = runProgram({"monitor", faultyRecording(), "--json-lines", "--interval", "1"});
    std::vector<Json> lines;
    std::istringstream text(run.out);
    for (std::string line; std::getline(text, line);) {
        lines.push_back(Json::parse(line, nullptr, false));
        ASSERT_TRUE(lines.back().is_object()) << line;
        EXPECT_THAT(keysOf(lines.back()), ElementsAre("timeNs", "verdict", "characters", "incidents"));
    }
    const auto stateOf = [](const Json& line) { return line["verdict"]["state"].get<std::string>(); };
    ASSERT_GE(lines.size(), 5U) << run.out << run.err;
    const auto turned = std::ranges::find_if(
        lines, [&](const Json& line) { return stateOf(line) != "good" && stateOf(line) != "none"; });
    ASSERT_NE(turned, lines.end());
    // Ten samples from 0.42 s on do not come: it must not be called good 250 ms after the next one.
    const auto begin = RecordingFile::kStart.time_since_epoch() / std::chrono::nanoseconds(1);
    const double at = static_cast<double>((*turned)["timeNs"].get<std::int64_t>() - begin) / 1e9;
    EXPECT_GE(at, 0.41);
    EXPECT_LE(at, 0.70);
    EXPECT_EQ(stateOf(lines.back()), "warning") << "over, but not long ago" << run.out;
    EXPECT_THAT(lines.back()["verdict"]["text"].get<std::string>(), HasSubstr("10 samples lost"));
    std::map<std::uint64_t, std::uint64_t> samples;
    for (const Json& line : lines) {
        for (const Json& incident : line["incidents"]) {
            samples[incident["id"]] = incident["samples"];
        }
    }
    const auto sum = std::accumulate(samples.begin(), samples.end(), std::uint64_t{},
                                     [](std::uint64_t all, const auto& one) { return all + one.second; });
    EXPECT_EQ(sum, 10U);
}

TEST(MonitorCommand, PrintsALineAtOnceWhenWhatWentOnIsOver) {
    RecordingFile file;
    for (std::uint32_t sample = 0; sample < 1500; ++sample) {
        if (sample < 900 || sample > 902) {
            file.addPose(sample);
        }
    }
    const ProgramRun run = runProgram({"monitor", file.finish(), "--json-lines", "--interval", "60"});
    const auto begin = RecordingFile::kStart.time_since_epoch() / std::chrono::nanoseconds(1);
    std::istringstream text(run.out);
    double overAt = 0; // it is as bad as before: a warning
    for (std::string one; overAt == 0 && std::getline(text, one);) {
        const Json line = Json::parse(one, nullptr, false);
        const bool isOver = line["verdict"]["text"].get<std::string>().ends_with(", over");
        overAt = isOver ? static_cast<double>(line["timeNs"].get<std::int64_t>() - begin) / 1e9 : 0;
    }
    EXPECT_GE(overAt, 4.7) << run.out;
    EXPECT_LE(overAt, 5.1) << run.out;
}

TEST(MonitorCommand, PrintsLinesInASilenceOfARecordingToo) {
    RecordingFile file;
    for (std::uint32_t sample = 0; sample < 1500; ++sample) {
        if (sample < 480 || sample >= 960) { // nothing comes for two seconds
            file.addPose(sample);
        }
    }
    const ProgramRun run = runProgram({"monitor", file.finish(), "--json-lines", "--interval", "0.5"});
    const auto begin = RecordingFile::kStart.time_since_epoch() / std::chrono::nanoseconds(1);
    std::istringstream text(run.out);
    std::vector<std::string> states;
    double goodAt = 0; // for the last time before the end of the silence
    for (std::string one; std::getline(text, one);) {
        const Json line = Json::parse(one, nullptr, false);
        const double at = static_cast<double>(line["timeNs"].get<std::int64_t>() - begin) / 1e9;
        if (at > 1.99 && at < 3.99) {
            states.push_back(line["verdict"]["state"]);
            goodAt = states.back() == "good" ? at : goodAt;
        }
    }
    ASSERT_GE(states.size(), 4U) << run.out;
    EXPECT_LE(goodAt, 2.25);
    EXPECT_THAT(states, Contains("warning"));
    EXPECT_EQ(states.back(), "bad");
}

TEST(MonitorCommand, SaysInItsLastLineWhatIsSettledAtTheEnd) {
    RecordingFile file;
    for (std::uint32_t sample = 0; sample < 500; ++sample) {
        if (sample != 495) { // late packets might still bring it, were there any
            file.addPose(sample);
        }
    }
    const ProgramRun run = runProgram({"monitor", file.finish(), "--json-lines", "--interval", "0.01"});
    std::istringstream text(run.out);
    Json last;
    for (std::string line; std::getline(text, line);) {
        last = Json::parse(line, nullptr, false);
    }
    ASSERT_EQ(last["incidents"].size(), 1U) << run.out.substr(run.out.size() - 2'000);
    EXPECT_NE(last["incidents"][0]["state"], "provisional");
    EXPECT_EQ(last["incidents"][0]["samples"], 1);
    EXPECT_THAT(last["verdict"]["text"].get<std::string>(), HasSubstr("1 sample lost"));
}

TEST(MonitorCommand, JudgesByTheLimitsThatItIsGiven) {
    RecordingFile file;
    for (std::uint32_t sample = 0; sample < 1500; ++sample) {
        if (sample % 200 != 50) { // few enough to be a warning
            file.addPose(sample);
        }
    }
    const std::string path = file.finish();
    const auto stateWith = [&](const char* most) {
        const ProgramRun run = runProgram({"monitor", path, "--json-lines", "--max-loss", most});
        std::istringstream text(run.out);
        std::string worst = "good";
        for (std::string one; std::getline(text, one);) {
            const std::string state = Json::parse(one, nullptr, false)["verdict"]["state"];
            worst = state == "bad" || (state == "warning" && worst == "good") ? state : worst;
        }
        return worst;
    };
    EXPECT_EQ(stateWith("0"), "bad");
    EXPECT_EQ(stateWith("50"), "warning");
}

TEST(MonitorCommand, SaysWhatIsKeptByItsPartsAndTheBudget) {
    const Json memory = reportOf(faultyRecording(), {"--verbose"})["memory"];
    EXPECT_THAT(keysOf(memory), ElementsAre("sum", "budget", "log", "index", "accounting", "messages",
                                            "metadata", "nullPoses", "events"));
    std::uint64_t sum = 0;
    for (const auto& [key, bytes] : memory.items()) {
        sum += key == "sum" || key == "budget" ? 0 : bytes.get<std::uint64_t>();
    }
    EXPECT_EQ(memory["sum"], sum);
    EXPECT_LE(sum, memory["budget"].get<std::uint64_t>());
    EXPECT_GT(memory["index"], 0);
}

TEST(MonitorCommand, CountsWhatAFileLacks) {
    const Json report = reportOf(faultyRecording());
    EXPECT_NEAR(report["durationS"], 999.0 / 240, 0.001);
    const Json& sender = report["sources"][0];
    EXPECT_EQ(sender["address"], "10.0.0.2:40001");
    EXPECT_EQ(sender["transport"], "udp");
    EXPECT_EQ(sender["datagrams"], 991);
    EXPECT_EQ(sender["bytes"], 991 * 56);
    const Json& stream = sender["characters"][0]["streams"][0];
    EXPECT_EQ(stream["type"], "02");
    EXPECT_EQ(stream["datagrams"], 991);
    EXPECT_EQ(stream["samples"], 990);
    EXPECT_EQ(stream["lost"], 10);
    EXPECT_EQ(stream["duplicates"], 1);
    EXPECT_EQ(stream["reordered"], 1);
    EXPECT_EQ(stream["step"], 1);
    EXPECT_EQ(stream["longestGapSamples"], 10);
    EXPECT_EQ(stream["firstSample"], 0);
    EXPECT_EQ(stream["lastSample"], 999);
    EXPECT_NEAR(stream["rateHz"], 238, 1);
}

TEST(MonitorCommand, TellsMalformedAndForeignDatagramsApart) {
    RecordingFile file;
    for (std::uint32_t sample = 0; sample < 10; ++sample) {
        file.addPose(sample);
    }
    const log::Stamp later = RecordingFile::kStart + std::chrono::seconds(1);
    file.add(bytesOfText("MXTP02 but nothing more"), later);
    file.add(bytesOfText("/osc/address"), later);
    file.add(bytesOfText("/osc/address"), later, {"10.0.0.9:1", log::Transport::Udp, 9763});
    file.add(bytesOfText("rubbish"), later, {"10.0.0.7:1", log::Transport::Tcp, 9763}, 0, {.skipped = true});
    file.add({}, later, {"10.0.0.2:40001", log::Transport::Udp, 9763}, 17,
             {.skipped = true, .isDropRecord = true});
    const Json report = reportOf(file.finish());
    EXPECT_EQ(report["foreignDatagrams"], 2);
    EXPECT_EQ(report["local"]["kernelDropped"], 17);
    ASSERT_EQ(report["sources"].size(), 2U);
    EXPECT_EQ(report["sources"][0]["datagrams"], 10);
    EXPECT_EQ(report["sources"][0]["malformed"], 1);
    EXPECT_EQ(report["sources"][1]["transport"], "tcp");
    EXPECT_EQ(report["sources"][1]["skippedBytes"], 7);
    ASSERT_EQ(report["foreignSources"].size(), 2U);
    EXPECT_EQ(report["foreignSources"][1]["address"], "10.0.0.9:1");
    EXPECT_EQ(report["foreignSources"][1]["firstBytes"], "2f 6f 73 63 2f 61 64 64 72 65 73 73");
    EXPECT_TRUE(report["foreignSources"][1]["looksLike"].is_string()) << "text: its OSC address has no end";
}

TEST(MonitorCommand, SortsCharactersAndStreams) {
    RecordingFile file;
    file.addPose(0, 3);
    file.add(RecordingFile::metadata("Ana"), RecordingFile::kStart);
    file.addPose(1, 0);
    const Json characters = reportOf(file.finish())["sources"][0]["characters"];
    ASSERT_EQ(characters.size(), 2U);
    EXPECT_EQ(characters[0]["name"], "Ana");
    EXPECT_EQ(characters[0]["streams"][0]["type"], "02");
    EXPECT_EQ(characters[0]["streams"][1]["type"], "12");
    EXPECT_EQ(characters[1]["id"], 3);
    EXPECT_EQ(characters[1]["name"], "");
}

TEST(MonitorCommand, SaysWhichLimitIsExceeded) {
    const std::string path = faultyRecording();
    EXPECT_EQ(runProgram({"monitor", path, "--json", "--max-loss", "2", "--max-gap", "1000"}).status, 0);
    const ProgramRun run = runProgram(
        {"monitor", path, "--json", "--max-loss", "0.5", "--max-gap", "20", "--max-jitter", "1000"});
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 2) << run.err;
    EXPECT_THAT(run.err, HasSubstr("10.0.0.2:40001"));
    EXPECT_THAT(run.err, HasSubstr("loss 1.000 % is above the limit of 0.500 %"));
    EXPECT_EQ(Json::parse(run.out)["exceeded"].size(), 2U);
}

TEST(MonitorCommand, AStreamThatEndsBeforeItsFileExceedsTheGap) {
    RecordingFile file;
    for (std::uint32_t sample = 0; sample < 480; ++sample) {
        file.addPose(sample);
        if (sample < 240) {
            file.addPose(sample, 1);
        }
    }
    const ProgramRun run = runProgram({"monitor", file.finish(), "--json", "--max-gap", "500"});
    EXPECT_EQ(run.status, 1);
    const Json exceeded = Json::parse(run.out)["exceeded"];
    ASSERT_EQ(exceeded.size(), 1U) << run.out;
    EXPECT_THAT(
        exceeded[0].get<std::string>(),
        HasSubstr("Character 1, type 02 Pose, quaternion: gap 1000.000 ms, which lasted to the end,"));
}

TEST(MonitorCommand, KeepsNoLimitWhereNothingWasReceived) {
    const ProgramRun run = runProgram({"monitor", fileWith(""), "--json", "--max-loss", "1"});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.err, HasSubstr("no datagram was received"));
    EXPECT_EQ(runProgram({"monitor", fileWith(""), "--json"}).status, 0);
}

TEST(MonitorCommand, ShowsATableInPlainLinesWhereThereIsNoTerminal) {
    const ProgramRun run = runProgram({"monitor", faultyRecording()});
    EXPECT_EQ(run.status, 0);
    EXPECT_THAT(run.out, HasSubstr("991 datagrams"));
    EXPECT_THAT(run.out, HasSubstr("10.0.0.2:40001 (udp)"));
    EXPECT_THAT(run.out, HasSubstr("02 Pose, quaternion"));
    EXPECT_EQ(run.out.find('\x1b'), std::string::npos);
}

TEST(MonitorCommand, LetsNoNameControlTheTerminal) {
    RecordingFile file;
    file.add(RecordingFile::metadata("\x1b[31mred\x07"), RecordingFile::kStart);
    const ProgramRun run = runProgram({"monitor", file.finish()});
    EXPECT_EQ(run.out.find('\x1b'), std::string::npos);
    EXPECT_THAT(run.out, HasSubstr("␛[31mred␇"));
}

TEST(MonitorCommand, RecordsAFileThatTellsTheSame) {
    const std::string path = faultyRecording();
    const std::string copy = newPath();
    const Json first = reportOf(path, {"--record", copy});
    EXPECT_EQ(reportOf(copy), first);
    EXPECT_EQ(first["sources"][0]["datagrams"], 991);
}

TEST(MonitorCommand, StopsWhereItWasTold) {
    const Json report = reportOf(faultyRecording(), {"--duration", "1"});
    EXPECT_EQ(report["sources"][0]["characters"][0]["streams"][0]["lastSample"], 240);
}

TEST(MonitorCommand, SpacesDatagramsOfARawFileByTheirTimeCodes) {
    std::string raw;
    for (std::uint32_t sample = 0; sample < 241; ++sample) {
        raw += asText(RecordingFile::pose(sample));
    }
    const Json report = reportOf(fileWith(raw));
    EXPECT_NEAR(report["durationS"], 1.0, 0.005);
    EXPECT_EQ(report["sources"][0]["transport"], "file");
    EXPECT_NEAR(report["sources"][0]["characters"][0]["streams"][0]["rateHz"], 240, 1);
}

TEST(MonitorCommand, EndsWithStatusTwoOnWrongUsage) {
    const std::vector<std::vector<std::string>> wrong{
        {"monitor", "--udp", "here:there"},
        {"monitor", "--tcp", "9763"},
        {"monitor", "--max-loss", "-1"},
        {"monitor", "--interval", "0"},
        {"monitor", "a", "--udp", "1"},
        {"monitor", "/no/such/file"},
        {"monitor", fileWith(""), "--record", "/no/such/folder/file"},
        {"monitor", fileWith(""), "--report", "/no/such/folder/file"},
        {"report", fileWith("")},
        {"report", fileWith(""), "-o", "x", "--since", "2", "--until", "1"}};
    for (const auto& arguments : wrong) {
        const ProgramRun run = runProgram(arguments);
        EXPECT_EQ(run.status, 2) << testing::PrintToString(arguments);
        EXPECT_THAT(run.err, StartsWith("posewire-cli"));
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
}

TEST(ReportCommand, WritesHtmlAboutTheRangeThatWasAskedFor) {
    const std::string path = faultyRecording();
    const std::string whole = newPath();
    EXPECT_EQ(runProgram({"report", path, "-o", whole}).status, 0);
    EXPECT_THAT(textOfFile(whole), StartsWith("<!DOCTYPE html>"));
    EXPECT_THAT(textOfFile(whole), HasSubstr("10 of 1\u202f000 samples (1.00 %)"));
    const ProgramRun later = runProgram({"report", path, "-o", "-", "--since", "2"});
    EXPECT_EQ(later.status, 0);
    EXPECT_THAT(later.out, HasSubstr("every one of them received"));
}

} // namespace
} // namespace posewire::cli::test
