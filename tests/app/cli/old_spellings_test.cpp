// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/cli/monitor_fixture.h"

#include <gmock/gmock.h>

#include <QDateTime>

#include <algorithm>

namespace posewire::cli::test {
namespace {

using testing::HasSubstr;

using Arguments = std::vector<std::string>;

std::string warning(const std::string& command, const std::string& old, const std::string& now) {
    return "posewire-cli " + command + ": " + old + " is an old spelling of " + now +
           ", accepted until version 1.0\n";
}

/// The same output and status, and the warning before all else that is said.
void expectAlike(const Arguments& old, const Arguments& now, const std::string& warnings) {
    const ProgramRun before = runProgram(old);
    const ProgramRun after = runProgram(now);
    EXPECT_EQ(before.status, after.status) << testing::PrintToString(old) << before.err << after.err;
    EXPECT_EQ(before.out, after.out) << testing::PrintToString(old);
    EXPECT_EQ(before.err, warnings + after.err);
    const std::string& command = old.front();
    EXPECT_THAT(runProgram({command, "--help"}).out, testing::Not(HasSubstr("old spelling")));
}

/// Three seconds at 60 Hz.
std::string recording() {
    RecordingFile file;
    for (std::uint32_t sample = 0; sample < 180; ++sample) {
        file.add(RecordingFile::pose(sample), RecordingFile::kStart + log::durationOf(sample / 60.0));
    }
    return file.finish();
}

TEST(OldSpellings, ExportsToTheSameFile) {
    const std::string file = recording();
    expectAlike({"export", file, "--to", "-", "--format", "csv"},
                {"export", file, "-o", "-", "--format", "csv"}, warning("export", "--to", "--output"));
    expectAlike({"export", file, "--to=-", "--format=csv", "--from=1", "--until=2"},
                {"export", file, "-o", "-", "--format", "csv", "--since", "1", "--until", "2"},
                warning("export", "--to", "--output") + warning("export", "--from", "--since"));
}

TEST(OldSpellings, ReportsOnTheSameRange) {
    const std::string file = recording();
    expectAlike({"report", file, "-o", "-", "--from", "1", "--to", "2"},
                {"report", file, "-o", "-", "--since", "1", "--until", "2"},
                warning("report", "--from", "--since") + warning("report", "--to", "--until"));
    EXPECT_NE(runProgram({"report", file, "-o", "-", "--from", "1"}).out,
              runProgram({"report", file, "-o", "-"}).out);
}

TEST(OldSpellings, SendTheSameRange) {
    const std::string file = recording();
    expectAlike(
        {"send", "--file", file, "--to", "127.0.0.1:9", "--speed", "1000", "--from", "1", "--until", "2"},
        {"send", "--file", file, "--to", "127.0.0.1:9", "--speed", "1000", "--since", "1", "--until", "2"},
        warning("send", "--from", "--since"));
}

TEST(OldSpellings, NameTheSameSenders) {
    for (const char* command : {"monitor", "follow"}) {
        expectAlike({command, "--udp", "127.0.0.1:0", "--duration", "0.05", "--from", "10.0.0.0/33"},
                    {command, "--udp", "127.0.0.1:0", "--duration", "0.05", "--sender", "10.0.0.0/33"},
                    warning(command, "--from", "--sender"));
    }
    const ProgramRun run = runProgram({"monitor", "--udp", "127.0.0.1:0", "--duration", "0.05", "--json",
                                       "--from", "10.0.0.1", "--from", "10.0.0.0/8"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr(warning("monitor", "--from", "--sender")));
    EXPECT_EQ(runProgram({"monitor", "--from", "10.0.0.1", recording()}).status, 2) << "of the network only";
}

TEST(OldSpellings, AreAMistakeTogetherWithTheNewOnes) {
    const std::string file = recording();
    for (const Arguments& both :
         {Arguments{"export", file, "--to", "-", "-o", "-", "--format", "csv"},
          Arguments{"export", file, "-o", "-", "--format", "csv", "--since", "1", "--from", "1"},
          Arguments{"report", file, "-o", "-", "--to", "1", "--until", "1"},
          Arguments{"send", "--file", file, "--since", "1", "--from", "1"},
          Arguments{"monitor", "--sender", "127.0.0.1", "--from", "127.0.0.1"}}) {
        const ProgramRun run = runProgram(both);
        EXPECT_EQ(run.status, 2) << testing::PrintToString(both);
        EXPECT_EQ(run.out, "");
        EXPECT_THAT(run.err, HasSubstr(": give one of them; see posewire-cli"));
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
}

TEST(Ranges, AreTimesOfDayToo) {
    const std::string file = recording();
    const auto at = [](double seconds) {
        const log::Stamp stamp = RecordingFile::kStart + log::durationOf(seconds);
        return QDateTime::fromMSecsSinceEpoch(stamp.time_since_epoch().count() / 1'000'000);
    };
    const auto exported = [&](const std::string& since, const std::string& until) {
        return runProgram({"export", file, "-o", "-", "--format", "csv", "--since", since, "--until", until})
            .out;
    };
    const std::string part = exported("1", "2");
    EXPECT_EQ(std::count(part.begin(), part.end(), '\n'), 61);
    EXPECT_EQ(exported(at(1).toString(Qt::ISODateWithMs).toStdString(), "2"), part);
    EXPECT_EQ(exported(at(1).time().toString(Qt::ISODateWithMs).toStdString(),
                       at(2).time().toString(Qt::ISODateWithMs).toStdString()),
              part);
    const std::string since = at(2).time().toString(Qt::ISODateWithMs).toStdString();
    EXPECT_EQ(
        runProgram({"send", "--file", file, "--to", "127.0.0.1:9", "--speed", "1000", "--since", since}).out,
        "sent 60 datagrams\n");
    const ProgramRun none = runProgram({"send", "--file", file, "--to", "127.0.0.1:9", "--since", "100"});
    EXPECT_EQ(none.status, 1);
    EXPECT_THAT(none.err, HasSubstr(": no datagrams between these times; try without --since and --until\n"));
}

} // namespace
} // namespace posewire::cli::test
