// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/cli/monitor_fixture.h"
#include "tests/support/loopback.h"

#include <QHostAddress>
#include <QProcess>
#include <QTcpServer>
#include <QTcpSocket>
#include <QThread>
#include <QUdpSocket>

#include <gmock/gmock.h>

#include <thread>

namespace posewire::cli::test {
namespace {

using testing::HasSubstr;

quint16 freePort() {
    QTcpServer server;
    server.listen(QHostAddress::LocalHost, 0);
    return server.serverPort();
}

std::string place(quint16 port) {
    return "127.0.0.1:" + std::to_string(port);
}

std::size_t linesIn(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(MonitorTcp, SaysOnceThatAHostRefusesAndEndsWithStatus1) {
    const std::string there = place(freePort());
    const ProgramRun run = runProgram({"monitor", "--json", "--tcp", there, "--duration", "2"});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.err,
                HasSubstr(there + ": connection refused; is the sender on, and does it listen there? "
                                  "Trying again"));
    EXPECT_THAT(run.err, HasSubstr(there + ": nothing was received"));
    EXPECT_EQ(linesIn(run.err), 2U) << run.err;
    EXPECT_THAT(Json::parse(run.out)["exceeded"].dump(), HasSubstr(there + ": nothing was received"));
}

TEST(MonitorTcp, SaysThatNobodyHasThatName) {
#ifdef _WIN32
    constexpr const char* kLookUp = "10"; // seconds
#else
    constexpr const char* kLookUp = "2";
#endif
    const ProgramRun run =
        runProgram({"monitor", "--json", "--tcp", "no-such-host.invalid:9763", "--duration", kLookUp});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.err, HasSubstr("no-such-host.invalid:9763: "));
    EXPECT_THAT(run.err, HasSubstr("Trying again"));
}

TEST(MonitorTcp, SaysThatThereIsNoSuchInterface) {
    const ProgramRun run =
        runProgram({"monitor", "--json", "--tcp", "[fe80::1%nope]:9763", "--duration", "1"});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.err, HasSubstr("there is no interface nope here"));
    EXPECT_THAT(run.err, HasSubstr("Trying again"));
}

TEST(MonitorTcp, SaysThatASenderIsSilentAndWhenItIsNotAnyMore) {
    QTcpServer server;
    ASSERT_TRUE(server.listen(QHostAddress::LocalHost, 0));
    const std::string there = place(server.serverPort());
    QProcess monitor;
    monitor.start(POSEWIRE_CLI,
                  {"monitor", "--json", "--tcp", QString::fromStdString(there), "--duration", "7"});
    ASSERT_TRUE(server.waitForNewConnection(5000));
    const std::unique_ptr<QTcpSocket> peer(server.nextPendingConnection());
    QThread::msleep(5600);
    const auto pose = RecordingFile::pose(1);
    peer->write(reinterpret_cast<const char*>(pose.data()), static_cast<qint64>(pose.size()));
    ASSERT_TRUE(peer->waitForBytesWritten(1000));
    ASSERT_TRUE(monitor.waitForFinished(10000));
    const std::string err = monitor.readAllStandardError().toStdString();
    EXPECT_THAT(err,
                HasSubstr(there + ": connected, but nothing has arrived for 5 s; is the sender streaming?"));
    EXPECT_THAT(err, HasSubstr(there + ": all is well now"));
    EXPECT_EQ(monitor.exitCode(), 0);
}

TEST(MonitorTcp, SaysThatSilentConnectionsGaveWay) {
    const quint16 port = freePort();
    QProcess monitor;
    monitor.start(POSEWIRE_CLI,
                  QStringList{"monitor", "--json", "--tcp-listen", QString("127.0.0.1:%1").arg(port)} +
                      endingByItself());
    std::vector<std::unique_ptr<QTcpSocket>> peers;
    for (int tries = 0; peers.size() < 70 && tries < 500; ++tries) {
        auto peer = std::make_unique<QTcpSocket>();
        peer->connectToHost(QHostAddress::LocalHost, port);
        if (peer->waitForConnected(1000)) {
            peers.push_back(std::move(peer));
        } else {
            QThread::msleep(20);
        }
    }
    ASSERT_TRUE(peers[0]->waitForDisconnected(5000));
    QThread::msleep(500);
    monitor.terminate(); // as Ctrl+C
    ASSERT_TRUE(monitor.waitForFinished(15000));
    const std::string err = monitor.readAllStandardError().toStdString();
    EXPECT_THAT(err, HasSubstr(place(port) + ": 6 idle connections were closed to make room\n"));
    EXPECT_LE(linesIn(err), 2U) << "when it begins and at the end";
}

/// `posewire-cli monitor` beside a sender that it can name.
class MonitorUdp : public testing::Test {
protected:
    void SetUp() override {
        QUdpSocket udp;
        udp.bind(QHostAddress::LocalHost, 0);
        m_port = udp.localPort();
    }
    void start(const QStringList& more) {
        m_process.start(POSEWIRE_CLI,
                        QStringList{"monitor", "--json", "--udp", QString("127.0.0.1:%1").arg(m_port)} +
                            endingByItself() + more);
        const auto isListening = [this] {
            return !QUdpSocket().bind(QHostAddress::LocalHost, m_port, QAbstractSocket::DontShareAddress);
        };
        for (int i = 0; i < 500 && !isListening(); ++i) {
            m_process.waitForFinished(20);
        }
    }
    void send(const QHostAddress& from, std::uint32_t first, std::uint32_t end,
              const std::stop_token& stop = {}) {
        QUdpSocket socket;
        ASSERT_TRUE(socket.bind(from, 0));
        for (std::uint32_t sample = first; sample < end && !stop.stop_requested(); ++sample) {
            const auto pose = RecordingFile::pose(sample);
            socket.writeDatagram(reinterpret_cast<const char*>(pose.data()), static_cast<qint64>(pose.size()),
                                 QHostAddress::LocalHost, m_port);
            QThread::msleep(4);
        }
    }
    ProgramRun end() {
        m_process.terminate(); // as Ctrl+C
        m_process.waitForFinished(30000);
        return {m_process.exitCode(), m_process.readAllStandardOutput().toStdString(),
                m_process.readAllStandardError().toStdString()};
    }

    quint16 m_port = 0;
    QProcess m_process;
};

TEST_F(MonitorUdp, AStreamThatDiesExceedsTheGap) {
    start({"--max-gap", "500"});
    send(QHostAddress::LocalHost, 0, 100);
    QThread::msleep(900);
    const ProgramRun run = end();
    EXPECT_EQ(run.status, 1);
    const Json report = Json::parse(run.out, nullptr, false);
    ASSERT_EQ(report["exceeded"].size(), 1U) << run.out;
    EXPECT_THAT(report["exceeded"][0].get<std::string>(),
                HasSubstr(", which lasted to the end, is above the limit of 500.000 ms"));
}

TEST_F(MonitorUdp, ASenderThatDiesExceedsTheGapWhileAnotherGoesOn) {
    if (!posewire::test::hasManyLoopbackAddresses()) {
        GTEST_SKIP() << "all senders of this system are 127.0.0.1";
    }
    start({"--max-gap", "500"});
    send(QHostAddress("127.0.0.2"), 0, 100);
    send(QHostAddress("127.0.0.3"), 0, 250);
    const Json report = Json::parse(end().out, nullptr, false);
    ASSERT_EQ(report["exceeded"].size(), 1U) << report.dump();
    EXPECT_THAT(report["exceeded"][0].get<std::string>(), HasSubstr("127.0.0.2:"));
}

TEST_F(MonitorUdp, AStreamThatLastsToTheEndExceedsNothing) {
    start({"--max-gap", "2000"});
    const std::jthread sender([this](const std::stop_token& stop) {
        send(QHostAddress::LocalHost, 0, UINT32_MAX, stop); // however long the program takes to end
    });
    QThread::msleep(400);
    const ProgramRun run = end();
    EXPECT_EQ(run.status, 0) << run.err << run.out;
}

TEST_F(MonitorUdp, ListensToThoseThatWereNamedAndCountsOthers) {
    if (!posewire::test::hasManyLoopbackAddresses()) {
        GTEST_SKIP() << "all senders of this system are 127.0.0.1";
    }
    const std::string recording = newPath();
    start({"--sender", "127.0.0.2", "--sender", "10.0.0.0/8", "--record", QString::fromStdString(recording)});
    send(QHostAddress("127.0.0.3"), 0, 20);
    send(QHostAddress("127.0.0.2"), 0, 10);
    const ProgramRun run = end();
    EXPECT_EQ(run.status, 0) << run.err;
    const Json report = Json::parse(run.out, nullptr, false);
    EXPECT_EQ(report["local"]["refusedDatagrams"], 20);
    ASSERT_EQ(report["sources"].size(), 1U);
    EXPECT_EQ(report["sources"][0]["datagrams"], 10);
    EXPECT_EQ(reportOf(recording)["sources"][0]["datagrams"], 10);
}

TEST(MonitorMulticast, SaysThatAPortOfOneAddressHearsNoGroup) {
    const ProgramRun run = runProgram({"monitor", "--udp", "127.0.0.1:9763", "--multicast", "239.1.2.3"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(
        run.err,
        HasSubstr("--multicast: port 9763 of 127.0.0.1 alone receives no multicast; write --udp 9763"));
}

TEST(MonitorFrom, SaysWhatIsNeitherHostNorNet) {
    const ProgramRun run =
        runProgram({"monitor", "--udp", "127.0.0.1:0", "--sender", "10.0.0.0/33", "--duration", "0.1"});
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("--sender: \"10.0.0.0/33\" is not a host or a net"));
}

} // namespace
} // namespace posewire::cli::test
