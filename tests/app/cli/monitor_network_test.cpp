// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/cli/monitor_fixture.h"

#include <QHostAddress>
#include <QProcess>
#include <QTcpServer>
#include <QThread>
#include <QUdpSocket>

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

namespace posewire::cli::test {
namespace {

/// `posewire-cli monitor` on a port of its own, from when it listens until it is asked to end.
class Monitor {
public:
    explicit Monitor(const QStringList& more, bool isTcp = false) : m_isTcp(isTcp) {
        m_port = freePort();
        m_process.start(POSEWIRE_CLI, QStringList{"monitor", "--json", isTcp ? "--tcp-listen" : "--udp",
                                                  QString("127.0.0.1:%1").arg(m_port)} +
                                          endingByItself() + more);
        for (int i = 0; i < 500 && !isListening(); ++i) {
            m_process.waitForFinished(20);
        }
    }
    ~Monitor() {
        m_process.kill();
        m_process.waitForFinished();
    }
    [[nodiscard]] std::string place() const { return "127.0.0.1:" + std::to_string(m_port); }

    ProgramRun end() {
        m_process.terminate(); // as Ctrl+C
        m_process.waitForFinished(30000);
        return {m_process.exitCode(), m_process.readAllStandardOutput().toStdString(),
                m_process.readAllStandardError().toStdString()};
    }

private:
    [[nodiscard]] quint16 freePort() const {
        QUdpSocket udp;
        QTcpServer tcp;
        udp.bind(QHostAddress::LocalHost, 0);
        tcp.listen(QHostAddress::LocalHost, 0);
        return m_isTcp ? tcp.serverPort() : udp.localPort();
    }
    [[nodiscard]] bool isListening() const {
        QUdpSocket udp;
        QTcpServer tcp;
        return m_isTcp ? !tcp.listen(QHostAddress::LocalHost, m_port)
                       : !udp.bind(QHostAddress::LocalHost, m_port, QAbstractSocket::DontShareAddress);
    }

    bool m_isTcp;
    quint16 m_port = 0;
    QProcess m_process;
};

std::uint64_t sentBy(const ProgramRun& run) {
    const std::size_t place = run.out.find("sent ");
    return place == std::string::npos ? 0 : std::stoull(run.out.substr(place + 5));
}

/// Waits until the recording has packets: a busy machine may begin it after its port is open.
void waitForPackets(const std::filesystem::path& recording) {
    constexpr std::uintmax_t kHeader = 2000; // is smaller
    std::error_code failed;
    for (int i = 0; i < 1000; ++i) {
        const std::uintmax_t size = std::filesystem::file_size(recording, failed);
        if (!failed && size > kHeader) {
            return;
        }
        QThread::msleep(10);
    }
    ADD_FAILURE() << recording << " gets no packets";
}

TEST(MonitorNetwork, CountsEveryDatagramThatWasSentAndRecordsIt) {
    const std::string recording = newPath();
    Monitor monitor({"--record", QString::fromStdString(recording)});
    const ProgramRun sender =
        runProgram({"send", "--to", monitor.place(), "--characters", "2", "--duration", "0.5"});
    ASSERT_EQ(sender.status, 0) << sender.err;
    const ProgramRun run = monitor.end();
    EXPECT_EQ(run.status, 0) << run.err;
    Json report = Json::parse(run.out, nullptr, false);
    ASSERT_TRUE(report.is_object()) << run.out;
    ASSERT_EQ(report["sources"].size(), 1U);
    const std::uint64_t received = report["sources"][0]["datagrams"];
    EXPECT_EQ(received + report["local"]["kernelDropped"].get<std::uint64_t>(), sentBy(sender));
    EXPECT_GT(report["local"]["receiveBufferBytes"], 0);
    EXPECT_EQ(report["sources"][0]["characters"].size(), 2U);
    for (const char* const counter :
         {"noPort", "reassemblyFailures"}) { // of the whole computer: others count
        report["local"][counter] = 0;
    }
    EXPECT_EQ(reportOf(recording), report) << "a recording gives the report that was made live";
}

TEST(MonitorNetwork, GoesOnInAnotherFileIfThatOfTheRecordingIsGone) {
    namespace fs = std::filesystem;
    for (const bool isAtEnd : {false, true}) {
        const fs::path folder = newPath();
        const fs::path next = folder / "take part 2.pcapng";
        fs::create_directory(folder);
        Monitor monitor({"--record", QString::fromStdString((folder / "take.pcapng").string())});
        const ProgramRun sender = runProgram({"send", "--to", monitor.place(), "--duration", "0.3"});
        ASSERT_EQ(sender.status, 0) << sender.err;
        waitForPackets(folder / "take.pcapng");
        fs::remove_all(folder);
        for (int i = 0; !isAtEnd && i < 500 && !fs::exists(next); ++i) {
            QThread::msleep(10);
        }
        const ProgramRun run = monitor.end();
        EXPECT_EQ(run.status, 2);
        EXPECT_THAT(run.err, testing::HasSubstr("take.pcapng: it was removed while it was being written; "));
        EXPECT_THAT(run.err, testing::HasSubstr(" packets, " + std::to_string(fs::file_size(next)) +
                                                " bytes to " + next.string()));
        const Json report = Json::parse(run.out, nullptr, false);
        EXPECT_EQ(report["incidents"].back()["kind"], "local");
        EXPECT_EQ(reportOf(next.string())["sources"], report["sources"]);
    }
}

TEST(MonitorNetwork, ClaimsNoRecordingThatIsNotThere) {
    namespace fs = std::filesystem;
    const fs::path folder = newPath();
    fs::create_directory(folder);
    Monitor monitor({"--record", QString::fromStdString((folder / "take.pcapng").string())});
    const ProgramRun sender = runProgram({"send", "--to", monitor.place(), "--duration", "0.1"});
    ASSERT_EQ(sender.status, 0) << sender.err;
    waitForPackets(folder / "take.pcapng");
    fs::remove_all(folder);
    std::ofstream(folder) << "a file";
    const ProgramRun run = monitor.end();
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, testing::HasSubstr("take part 2.pcapng: cannot be written"));
    EXPECT_THAT(run.err, testing::Not(testing::ContainsRegex("recorded|at most")));
}

TEST(MonitorNetwork, RecordsWhatALimitSaysOfASilenceUntilTheEnd) {
    const std::string recording = newPath();
    Monitor monitor({"--max-gap", "100", "--record", QString::fromStdString(recording)});
    const ProgramRun sender =
        runProgram({"send", "--to", monitor.place(), "--types", "02", "--duration", "0.2"});
    ASSERT_EQ(sender.status, 0) << sender.err;
    QThread::msleep(200);
    const Json report = Json::parse(monitor.end().out, nullptr, false);
    ASSERT_TRUE(report.is_object());
    ASSERT_FALSE(report["exceeded"].empty());
    EXPECT_EQ(reportOf(recording, {"--max-gap", "100"})["exceeded"], report["exceeded"]);
}

TEST(MonitorNetwork, TellsWhereItListensAndWhoSendsOnlyWhereAskedTo) {
    for (const bool isVerbose : {false, true}) {
        Monitor monitor(isVerbose ? QStringList{"--verbose"} : QStringList());
        std::vector<std::string> arguments{"send", "--to", monitor.place(), "--duration", "0.2"};
        if (isVerbose) {
            arguments.emplace_back("--verbose");
        }
        const ProgramRun sender = runProgram(arguments);
        ASSERT_EQ(sender.status, 0) << sender.err;
        const ProgramRun run = monitor.end();
        const Json report = Json::parse(run.out, nullptr, false);
        ASSERT_TRUE(report.is_object()) << run.out;
        const std::string address = report["sources"][0]["address"];
        EXPECT_EQ(run.err, isVerbose ? "posewire-cli monitor: listening on " + monitor.place() +
                                           " (UDP)\nposewire-cli monitor: heard " + address + "\n"
                                     : "");
        EXPECT_EQ(sender.err, isVerbose ? "posewire-cli send: sending from " + address + " to " +
                                              monitor.place() + " (UDP)\n"
                                        : "");
    }
}

TEST(MonitorNetwork, WaitsForASenderToConnectByTcp) {
    Monitor monitor({}, true);
    const ProgramRun sender =
        runProgram({"send", "--tcp", "--to", monitor.place(), "--characters", "1", "--duration", "0.2"});
    ASSERT_EQ(sender.status, 0) << sender.err;
    const Json report = Json::parse(monitor.end().out, nullptr, false);
    ASSERT_TRUE(report.is_object());
    ASSERT_EQ(report["sources"].size(), 1U);
    EXPECT_EQ(report["sources"][0]["transport"], "tcp");
    EXPECT_EQ(report["sources"][0]["datagrams"], sentBy(sender));
}

TEST(MonitorNetwork, EndsByItselfAfterItsDuration) {
    const ProgramRun run = runProgram({"monitor", "--json", "--udp", "127.0.0.1:0", "--duration", "0.1"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_GE(Json::parse(run.out)["durationS"].get<double>(), 0.1);
}

TEST(MonitorNetwork, NamesThePortThatTheSystemChose) {
    const ProgramRun run =
        runProgram({"monitor", "--udp", "127.0.0.1:0", "--tcp-listen", "127.0.0.1:0", "--duration", "0.1"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(contains(run.err, R"(listening on 127\.0\.0\.1:[1-9]\d* \(UDP\))")) << run.err;
    EXPECT_TRUE(contains(run.err, R"(listening on 127\.0\.0\.1:[1-9]\d* \(TCP\))")) << run.err;
}

TEST(MonitorNetwork, SaysWhoHoldsAPort) {
    QUdpSocket holder;
    ASSERT_TRUE(holder.bind(QHostAddress::LocalHost, 0, QAbstractSocket::DontShareAddress));
    const std::string place = "127.0.0.1:" + std::to_string(holder.localPort());
    const ProgramRun run = runProgram({"monitor", "--udp", place, "--duration", "0.1"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, testing::HasSubstr(std::to_string(holder.localPort())));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

} // namespace
} // namespace posewire::cli::test
