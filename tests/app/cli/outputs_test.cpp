// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/cli/monitor_fixture.h"
#include "tests/support/paths.h"

#include <gmock/gmock.h>

#include <filesystem>

#ifndef _WIN32
#include <sys/stat.h>
#endif

namespace posewire::cli::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string smallRecording() {
    RecordingFile file;
    for (std::uint32_t sample = 0; sample < 100; ++sample) {
        file.addPose(sample);
    }
    return file.finish();
}

/// Every way to write `out` from `in`.
std::vector<std::vector<std::string>> writing(const std::string& in, const std::string& out) {
    return {{"encode", in, "-o", out},
            {"export", in, "-o", out, "--format", "csv"},
            {"report", in, "-o", out},
            {"monitor", in, "--json", "--record", out},
            {"monitor", in, "--json", "--report", out}};
}

void expectRefusal(const ProgramRun& run, const std::string& why) {
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_THAT(run.err, HasSubstr(why));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(run.out, "");
}

TEST(Outputs, ReplaceNoFileUnasked) {
    const std::string precious = fileWith("precious");
    auto all = writing(smallRecording(), precious);
    all.push_back({"send", "--to", "127.0.0.1:9", "--duration", "0.01", "--truth", precious});
    for (const auto& arguments : all) {
        expectRefusal(runProgram(arguments),
                      precious + ": exists already; choose another name, or add --force");
        EXPECT_EQ(textOfFile(precious), "precious") << arguments[0];
    }
    for (auto arguments : all) {
        const std::string old = fileWith("old");
        std::ranges::replace(arguments, precious, old);
        arguments.emplace_back("--force");
        EXPECT_LE(runProgram(arguments).status, 1) << arguments[0];
        EXPECT_NE(textOfFile(old), "old") << arguments[0];
    }
}

TEST(Outputs, AreNeverTheInput) {
    const std::string input = smallRecording();
    const std::string before = textOfFile(input);
    const std::string twin = newPath();
    fs::create_hard_link(input, twin);
    std::vector<std::string> names{input, twin};
#ifndef _WIN32 // where a link needs a right that few have
    names.push_back(newPath());
    fs::create_symlink(input, names.back());
#endif
    for (const std::string& out : names) {
        for (auto arguments : writing(input, out)) {
            arguments.emplace_back("--force");
            expectRefusal(runProgram(arguments), out + ": is ");
            EXPECT_EQ(textOfFile(input), before);
        }
    }
}

TEST(Outputs, AreNoFileThatAnotherProcessRecordsTo) {
    const std::string recorded = newPath();
    const auto sink = log::createFile(recorded);
    ASSERT_TRUE(sink);
    for (auto arguments : writing(smallRecording(), recorded)) {
        arguments.emplace_back("--force");
        expectRefusal(runProgram(arguments), recorded + ": is being recorded to at present");
    }
    EXPECT_TRUE((*sink)->finish()) << "it is where it was";
}

#ifndef _WIN32
TEST(Outputs, ArePrivateUnlessAskedFor) {
    for (const auto& [option, mode] :
         {std::pair{std::vector<std::string>{}, 0600}, {{"--mode", "0640"}, 0640}}) {
        const std::string out = newPath();
        auto all = writing(smallRecording(), out);
        all.push_back({"send", "--to", "127.0.0.1:9", "--duration", "0.01", "--truth", out});
        for (auto arguments : all) {
            arguments.insert(arguments.end(), option.begin(), option.end());
            EXPECT_LE(runProgram(arguments).status, 1) << arguments[0];
            EXPECT_EQ(static_cast<int>(fs::status(out).permissions()), mode) << arguments[0];
            fs::remove(out);
        }
    }
    const ProgramRun run = runProgram({"encode", "-", "--mode", "0755"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("--mode: '0755' is none such as"));
}
#endif

TEST(Outputs, AreNotTwoInOneFile) {
    const std::string path = newPath();
    expectRefusal(runProgram({"monitor", smallRecording(), "--record", path, "--report", path}),
                  "both recording and report");
    EXPECT_FALSE(fs::exists(path));
}

TEST(Outputs, LeaveNothingWhereTheyFail) {
    const std::string folder = newPath();
    fs::create_directory(folder);
    const std::string input = fileWith(std::string(std::size_t{5} << 20, '\0'));
    const ProgramRun run = runProgram({"encode", input, "-o", folder + "/x"});
    expectRefusal(run, "longer than 4 MiB");
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Outputs, MayBeDevices) {
    for (const auto& arguments : writing(smallRecording(), nullDevice())) {
        EXPECT_LE(runProgram(arguments).status, 1) << arguments[0];
    }
    const std::string line = textOfFile(posewire::test::sourcePath("tests/golden/25_time_code_bare.json"));
    EXPECT_EQ(runProgram({"encode", "-", "-o", "/dev/stdout"}, line).out,
              runProgram({"encode", "-"}, line).out);
}

#ifndef _WIN32
TEST(Outputs, AreNoPipesWithoutAReader) {
    const std::string pipe = newPath();
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    for (const auto& arguments : writing(smallRecording(), pipe)) {
        const ProgramRun run = runProgram(arguments);
        EXPECT_EQ(run.status, 2) << arguments[0];
        EXPECT_THAT(run.err, HasSubstr(pipe + ": is a pipe without a reader; start its reader first"));
    }
}
#endif

TEST(Recordings, SayHowMuchTheyHold) {
    const std::string copy = newPath();
    const ProgramRun run = runProgram({"monitor", smallRecording(), "--json", "--record", copy});
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.err, "posewire-cli monitor: recorded 100 packets, " + std::to_string(fs::file_size(copy)) +
                           " bytes to " + copy + "\n");
}

TEST(Recordings, CanGoToStandardOutput) {
    const std::string path = smallRecording();
    const ProgramRun run = runProgram({"monitor", path, "--record", "-"});
    EXPECT_EQ(reportOf(fileWith(run.out)), reportOf(path));
    EXPECT_EQ(runProgram({"monitor", path, "--record", "-", "--json"}).status, 2);
}

TEST(CutCaptures, AreReadAndToldWithTheByteWhereTheyEnd) {
    const std::string whole = textOfFile(smallRecording());
    const std::string cut = fileWith(whole.substr(0, whole.size() / 2));
    const std::string words =
        cut + ": is cut off: it ends at byte " + std::to_string(whole.size() / 2) + ", amidst a packet";
    const ProgramRun monitored = runProgram({"monitor", cut, "--json"});
    const ProgramRun decoded = runProgram({"decode", cut, "--json"});
    for (const ProgramRun& run : {monitored, decoded}) {
        EXPECT_EQ(run.status, 1);
        EXPECT_THAT(run.err, HasSubstr(words));
    }
    EXPECT_EQ(Json::parse(monitored.out)["sources"][0]["datagrams"],
              std::count(decoded.out.begin(), decoded.out.end(), '\n'));
}

TEST(Stamps, MayBeOfAnyYear) {
    for (const std::int64_t year : {-200, -70, -1, 0, 100, 280}) {
        RecordingFile file;
        const log::Stamp start{std::chrono::seconds(year * 31'556'952)};
        for (std::uint32_t sample = 0; sample < 193; ++sample) {
            if (sample < 90 || sample > 100) {
                file.add(RecordingFile::pose(sample), start + sample * log::Duration(1'000'000'000) / 240);
            }
        }
        const std::string path = file.finish();
        const Json report = reportOf(path);
        EXPECT_NEAR(report["durationS"], 0.8, 1e-6) << year;
        EXPECT_EQ(report["sources"][0]["characters"][0]["streams"][0]["lost"], 11) << year;
        EXPECT_EQ(runProgram({"report", path, "-o", "-"}).status, 0) << year;
        const std::string copy = newPath();
        EXPECT_EQ(reportOf(path, {"--record", copy}), report) << year;
        EXPECT_EQ(reportOf(copy), report) << year;
    }
}

} // namespace
} // namespace posewire::cli::test
