// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/performer/performer.h"
#include "tests/app/cli/monitor_fixture.h"
#include "tests/support/paths.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>

#ifndef _WIN32
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace posewire::cli::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// Two performers at 60 Hz, each of whose datagrams is kept that `keeps` says.
std::string performance(std::uint64_t frames, const std::function<bool(const wire::Datagram&)>& keeps = {}) {
    performer::PerformerSettings settings;
    settings.rateHz = 60;
    settings.types = {2, 12, 13};
    performer::Performer performer(settings);
    RecordingFile file;
    for (std::uint64_t frame = 0; frame < frames; ++frame) {
        for (const wire::Datagram& datagram : performer.frame(frame)) {
            if (!keeps || keeps(datagram)) {
                file.add(wire::encode(datagram).value(),
                         RecordingFile::kStart + log::durationOf(static_cast<double>(frame) / 60));
            }
        }
    }
    return file.finish();
}

class ExportCommand : public testing::Test {
protected:
    ExportCommand() { fs::create_directory(m_folder); }

    /// The path of a file that is not there yet.
    [[nodiscard]] std::string output(const std::string& name) const { return m_folder + "/" + name; }
    [[nodiscard]] std::size_t fileCount() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(m_folder), {}));
    }
    static ProgramRun exported(const std::string& file, const std::string& to,
                               const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments{"export", file, "-o", to};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runProgram(arguments);
    }
    static std::ptrdiff_t lines(const std::string& text) {
        return std::count(text.begin(), text.end(), '\n');
    }

    const std::string m_folder = newPath();
};

TEST_F(ExportCommand, WritesEverySampleOfEachCharacter) {
    const std::string to = output("take.csv");
    const ProgramRun run = exported(performance(90), to);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(lines(textOfFile(to)), 181);
    EXPECT_THAT(run.err, HasSubstr(": 90 samples to " + to + "\n"));
    EXPECT_EQ(lines(run.err), 2);
}

TEST_F(ExportCommand, TakesTheFormatOfItsOptionOrOfTheName) {
    const std::string file = performance(5);
    const std::string json = output("take.txt");
    EXPECT_EQ(exported(file, json, {"--format", "jsonl"}).status, 0);
    EXPECT_EQ(textOfFile(json).front(), '{');
    const ProgramRun unnamed = exported(file, output("take"));
    EXPECT_EQ(unnamed.status, 2);
    EXPECT_THAT(unnamed.err, HasSubstr("its name says no format; end it with one of csv, jsonl"));
    const ProgramRun unknown = exported(file, output("take.csv"), {"--format", "fbx"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_THAT(unknown.err, HasSubstr("\"fbx\" is no format; there are csv"));
    EXPECT_EQ(fileCount(), 1U);
}

TEST_F(ExportCommand, TakesARangeAndTheCharactersNamed) {
    const std::string file = performance(120);
    const std::string names = exported(file, output("all.csv")).err;
    const std::size_t begin = names.find("export: ") + 8;
    const std::string name = names.substr(begin, names.find(": ", begin) - begin);
    const std::string to = output("part.jsonl");
    const ProgramRun run = exported(file, to, {"--characters", name, "--since", "0.5", "--until", "1"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(lines(textOfFile(to)), 30);
    EXPECT_EQ(exported(file, to, {"--characters", "1", "--force"}).status, 0);
    EXPECT_EQ(Json::parse(textOfFile(to).substr(0, textOfFile(to).find('\n')))["id"], 1);
    EXPECT_EQ(exported(file, to, {"--characters", name + ",1", "--force"}).status, 0);
    EXPECT_EQ(lines(textOfFile(to)), 240);
    const ProgramRun nobody = exported(file, output("x.csv"), {"--characters", "Nobody"});
    EXPECT_EQ(nobody.status, 2);
    EXPECT_THAT(nobody.err,
                HasSubstr("\"Nobody\" is no character of " + file + "; there is " + name + " (0)"));
    EXPECT_EQ(exported(file, output("x.csv"), {"--since", "2", "--until", "1"}).status, 2);
}

TEST_F(ExportCommand, GivesFiguresInGltfABody) {
    const std::string to = output("take.glb");
    EXPECT_EQ(exported(performance(10), to).status, 0);
    const std::string file = textOfFile(to);
    std::uint32_t size = 0;
    ASSERT_GT(file.size(), 20U);
    std::memcpy(&size, file.data() + 12, sizeof(size));
    const Json document = Json::parse(file.substr(20, size));
    EXPECT_EQ(document["meshes"].size(), 2U);
    EXPECT_GT(document["skins"][1]["joints"].size(), 23U) << "the segments, and joints between them";
    EXPECT_GT(document["accessors"]
                      [document["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<int>()]["count"],
              1'000);
}

TEST_F(ExportCommand, GivesEachCharacterAFileWhereOneHoldsOne) {
    const ProgramRun run = exported(performance(10), output("take.bvh"));
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(fileCount(), 2U);
    EXPECT_FALSE(fs::exists(output("take.bvh")));
    const ProgramRun piped = exported(performance(10), "-", {"--format", "bvh"});
    EXPECT_EQ(piped.status, 2);
    EXPECT_THAT(piped.err, HasSubstr("choose one with --characters"));
#ifndef _WIN32 // where NUL is a device and "NUL-Mira Lindqvist" a file
    const ProgramRun device = exported(performance(10), nullDevice(), {"--format", "bvh"});
    EXPECT_EQ(device.status, 2);
    EXPECT_THAT(device.err, HasSubstr(nullDevice() + ": is a folder or a device"));
#endif
    EXPECT_EQ(exported(performance(10), m_folder, {"--format", "bvh"}).status, 2);
    EXPECT_EQ(fileCount(), 2U);
    EXPECT_EQ(exported(performance(10), output("one.bvh"), {"--characters", "1"}).status, 0);
    EXPECT_TRUE(fs::exists(output("one.bvh")));
}

TEST_F(ExportCommand, SaysWhatIsMissing) {
    const std::string file = performance(60, [](const wire::Datagram& datagram) {
        return datagram.header.sampleCounter < 20 || datagram.header.sampleCounter > 22;
    });
    const ProgramRun run = exported(file, output("take.csv"));
    EXPECT_EQ(run.status, 0);
    EXPECT_THAT(run.err,
                HasSubstr(": 57 samples to " + output("take.csv") + "; 3 are missing: a row without"));
}

TEST_F(ExportCommand, SaysWhyThereIsNothing) {
    const auto isNoPose = [](const wire::Datagram& datagram) { return datagram.header.type() != 2; };
    const ProgramRun poses = exported(performance(20, isNoPose), output("take.csv"));
    EXPECT_EQ(poses.status, 2);
    EXPECT_THAT(poses.err, HasSubstr("no poses (types 01, 02, 05, 21, 22, 03)"));
    const ProgramRun time = exported(performance(20), output("take.csv"), {"--since", "100"});
    EXPECT_EQ(time.status, 2);
    EXPECT_THAT(time.err, HasSubstr("between these times; try without --since and --until"));
    const ProgramRun nothing = exported(fileWith("no datagrams here"), output("take.csv"));
    EXPECT_EQ(nothing.status, 2);
    EXPECT_THAT(nothing.err, HasSubstr("it looks like plain text. Posewire reads recordings of MXTP"));
    EXPECT_EQ(exported(output("missing.pcapng"), output("take.csv")).status, 2);
    EXPECT_EQ(fileCount(), 0U);
}

TEST_F(ExportCommand, WritesToStandardOutput) {
    const ProgramRun run = exported(performance(4), "-", {"--format", "jsonl"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(lines(run.out), 8);
}

TEST_F(ExportCommand, ReadsDatagramsBackToBackAndStandardInput) {
    const ProgramRun decoded = runProgram({"decode", performance(10), "--json"});
    const std::string raw = runProgram({"encode", "-"}, decoded.out).out;
    EXPECT_EQ(exported(fileWith(raw), output("raw.csv")).status, 0);
    EXPECT_EQ(runProgram({"export", "-", "-o", output("piped.csv")}, raw).status, 0);
    EXPECT_EQ(lines(textOfFile(output("raw.csv"))), 21);
    EXPECT_EQ(lines(textOfFile(output("piped.csv"))), 21);
}

TEST_F(ExportCommand, SaysNothingAboutReceiptWhereAFileHasNoStamps) {
    const ProgramRun decoded = runProgram({"decode", performance(3), "--json"});
    const std::string raw = fileWith(runProgram({"encode", "-"}, decoded.out).out);
    EXPECT_EQ(exported(raw, output("raw.csv")).status, 0);
    const std::string csv = textOfFile(output("raw.csv"));
    EXPECT_THAT(csv.substr(csv.find('\n') + 1), HasSubstr(",0,1,1,0.000000,,36000000,02,"));
    EXPECT_EQ(exported(raw, output("raw.jsonl")).status, 0);
    EXPECT_THAT(textOfFile(output("raw.jsonl")), Not(HasSubstr("receivedNs")));
    EXPECT_EQ(exported(raw, output("raw.mvnx"), {"--characters", "0"}).status, 0);
    EXPECT_THAT(textOfFile(output("raw.mvnx")), Not(HasSubstr("recDate")));
    EXPECT_THAT(textOfFile(output("raw.mvnx")), Not(HasSubstr("ms=\"1"))); // since 1970
}

TEST_F(ExportCommand, AgreesOnRealPosesOfBothTypes) {
    const fs::path folder = posewire::test::capturesFolder();
    if (!fs::exists(folder / "mxtp01.bin") || !fs::exists(folder / "mxtp02.bin")) {
        GTEST_SKIP() << "no recorded datagrams beside the source tree";
    }
    std::vector<Json> samples;
    for (const char* file : {"mxtp01.bin", "mxtp02.bin"}) { // the same sample in both
        const ProgramRun run = exported((folder / file).string(), "-", {"--format", "jsonl"});
        ASSERT_EQ(run.status, 0) << run.err;
        samples.push_back(Json::parse(run.out)["segments"]);
    }
    ASSERT_EQ(samples[0].size(), 23U);
    for (std::size_t i = 0; i < samples[0].size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(samples[0][i]["position"][axis].get<double>(), samples[1][i]["position"][axis], 1e-6);
        }
        for (std::size_t part = 0; part < 4; ++part) {
            EXPECT_NEAR(samples[0][i]["orientation"][part].get<double>(), samples[1][i]["orientation"][part],
                        1e-5);
        }
    }
}

TEST_F(ExportCommand, ExportsWhatIsWholeOfACutFile) {
    const std::string whole = textOfFile(performance(60));
    const ProgramRun run = exported(fileWith(whole.substr(0, whole.size() / 2)), output("take.csv"));
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.err, HasSubstr("is cut off"));
    EXPECT_GT(lines(textOfFile(output("take.csv"))), 50);
}

TEST_F(ExportCommand, ExportsWhatComesBeforeDamage) {
    const std::string damaged = textOfFile(performance(60)) + std::string(64, '\xff');
    const ProgramRun run = exported(fileWith(damaged), output("take.csv"));
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.err, HasSubstr("is damaged at byte"));
    EXPECT_EQ(lines(textOfFile(output("take.csv"))), 121);
}

#ifndef _WIN32 // where no test can press Ctrl+C in a console that it has not
TEST_F(ExportCommand, LeavesNothingWhenItIsInterrupted) {
    const std::string endless = newPath(); // nobody writes into it, and nobody closes it
    ASSERT_EQ(::mkfifo(endless.c_str(), 0600), 0);
    const int held = ::open(endless.c_str(), O_RDWR);
    const std::string command = "timeout --preserve-status -s INT 2 " POSEWIRE_CLI " export " + endless +
                                " -o " + output("take.csv") + " 2> " + output("said");
    const int status = std::system(command.c_str());
    ::close(held);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 2) << status;
    EXPECT_THAT(textOfFile(output("said")),
                HasSubstr("interrupted; " + output("take.csv") + " was not written"));
    EXPECT_EQ(fileCount(), 1U);
}
#endif

TEST_F(ExportCommand, ShowsNoProgressWhereNobodyLooks) {
    EXPECT_THAT(exported(performance(3'000), output("take.csv")).err, Not(HasSubstr("\r")));
}

} // namespace
} // namespace posewire::cli::test
