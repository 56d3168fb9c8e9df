// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/cli/program_run.h"
#include "tests/support/golden.h"

#include <QTcpServer>
#include <QTcpSocket>
#include <QUdpSocket>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <set>

namespace posewire::cli::test {
namespace {

using posewire::test::goldens;

/// Listens while the program runs; small sends wait in the socket until they are looked at.
class Listener {
public:
    Listener() { m_socket.bind(QHostAddress::LocalHost, 0); }

    [[nodiscard]] std::string place() const { return "127.0.0.1:" + std::to_string(m_socket.localPort()); }
    std::vector<std::string> datagrams() {
        std::vector<std::string> all;
        while (m_socket.hasPendingDatagrams() || m_socket.waitForReadyRead(0)) {
            std::string bytes(static_cast<std::size_t>(m_socket.pendingDatagramSize()), '\0');
            m_socket.readDatagram(bytes.data(), static_cast<qint64>(bytes.size()));
            all.push_back(std::move(bytes));
        }
        return all;
    }

private:
    QUdpSocket m_socket;
};

TEST(SendCommand, SendsEveryDatagramOfAFileOnceAndUnchanged) {
    std::string file;
    std::vector<std::string> expected;
    for (const auto& golden : goldens()) {
        if (golden.bytes.size() > 60) { // a socket's buffer holds all of them
            expected.push_back(asText(golden.bytes));
            file += expected.back();
        }
    }
    Listener listener;
    const ProgramRun run =
        runProgram({"send", "--to", listener.place(), "--file", fileWith(file), "--speed", "1000"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, "sent " + std::to_string(expected.size()) + " datagrams\n");
    EXPECT_TRUE(listener.datagrams() == expected);
}

/// Of type 02, with this sample counter.
std::string numbered(std::uint32_t sample) {
    std::string bytes = asText(posewire::test::golden("02_quaternion_counted").bytes);
    for (std::size_t i = 0; i < 4; ++i) {
        bytes[6 + i] = static_cast<char>(sample >> (24 - 8 * i) & 0xffU);
    }
    return bytes;
}

TEST(SendCommand, SendsTheFaultsOfARecordingAsTheyWere) {
    std::string file;
    std::vector<std::string> expected;
    const auto add = [&](std::uint32_t sample) {
        expected.push_back(numbered(sample));
        file += expected.back();
    };
    for (std::uint32_t sample = 10; sample <= 200; sample += 10) { // a socket's buffer holds them twice
        add(sample);
    }
    add(30); // far behind, and twice
    add(50);
    add(50);
    for (std::uint32_t sample = 10; sample <= 50; sample += 10) { // restarted
        add(sample);
    }
    Listener listener;
    const ProgramRun run = runProgram({"send", "--to", listener.place(), "--file", fileWith(file), "--loop",
                                       "--rate", "1000", "--speed", "10", "--duration", "0.005"});
    EXPECT_EQ(run.status, 0) << run.err;
    for (std::size_t i = 0; i < 20; ++i) {
        expected.push_back(std::string(expected[i]));
    }
    std::vector<std::string> received = listener.datagrams();
    received.resize(std::min(received.size(), expected.size()));
    EXPECT_TRUE(received == expected) << received.size() << " of " << expected.size();
}

TEST(SendCommand, PerformsTheTypesAndCharactersThatWereAskedFor) {
    Listener listener;
    const ProgramRun run = runProgram({"send", "--to", listener.place(), "--types", "02,12", "--characters",
                                       "3", "--rate", "100", "--duration", "0.05"});
    EXPECT_EQ(run.status, 0) << run.err;
    std::multiset<std::string> types;
    std::set<char> characters;
    for (const std::string& bytes : listener.datagrams()) {
        types.insert(bytes.substr(0, 6));
        characters.insert(bytes.at(16));
    }
    EXPECT_EQ(types.count("MXTP02"), 5U * 3);
    EXPECT_EQ(types.count("MXTP12"), 3U);
    EXPECT_EQ(types.size(), 18U);
    EXPECT_EQ(characters, (std::set<char>{0, 1, 2}));
}

TEST(SendCommand, SendsTheSameBytesForTheSameSeed) {
    const auto sent = [](const std::string& seed) {
        Listener listener;
        EXPECT_EQ(runProgram({"send", "--to", listener.place(), "--seed", seed, "--duration", "0.01"}).status,
                  0);
        return listener.datagrams();
    };
    const auto first = sent("7");
    EXPECT_FALSE(first.empty());
    EXPECT_TRUE(sent("7") == first);
    EXPECT_FALSE(sent("8") == first);
}

TEST(SendCommand, LoopsUntilItsTimeIsOver) {
    Listener listener;
    const std::string file = asText(posewire::test::golden("02_quaternion_counted").bytes);
    const ProgramRun run = runProgram({"send", "--to", listener.place(), "--file", fileWith(file), "--loop",
                                       "--rate", "1000", "--duration", "0.02"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(listener.datagrams().size(), 20U);
}

TEST(SendCommand, SendsARangeOfARecording) {
    Listener listener;
    std::string file;
    for (int i = 0; i < 10; ++i) { // without stamps a period each
        file += asText(posewire::test::golden("02_quaternion_counted").bytes);
        file[file.size() - posewire::test::golden("02_quaternion_counted").bytes.size() + 9] =
            static_cast<char>(i);
    }
    const ProgramRun run = runProgram({"send", "--to", listener.place(), "--file", fileWith(file), "--rate",
                                       "100", "--since", "0.02", "--until", "0.05"});
    EXPECT_EQ(run.out, "sent 3 datagrams\n") << run.err;
    EXPECT_EQ(listener.datagrams().size(), 3U);
    EXPECT_NE(runProgram({"send", "--since", "1"}).status, 0) << "of a recording only";
    EXPECT_NE(runProgram({"send", "--file", fileWith(file), "--since", "2", "--until", "1"})
                  .err.find("--since must be before --until"),
              std::string::npos);
}

TEST(SendCommand, SendsToSeveralPlaces) {
    Listener first;
    Listener second;
    const std::string file = fileWith(asText(posewire::test::golden("02_quaternion_counted").bytes));
    EXPECT_EQ(runProgram({"send", "--to", first.place(), "--to", second.place(), "--file", file}).out,
              "sent 2 datagrams\n");
    EXPECT_EQ(first.datagrams().size(), 1U);
    EXPECT_EQ(second.datagrams().size(), 1U);
}

TEST(SendCommand, ConnectsByTcpAndSendsBackToBack) {
    QTcpServer server;
    ASSERT_TRUE(server.listen(QHostAddress::LocalHost, 0));
    std::string file;
    for (const auto& golden : goldens()) {
        file += asText(golden.bytes);
    }
    const ProgramRun run =
        runProgram({"send", "--tcp", "--to", "127.0.0.1:" + std::to_string(server.serverPort()), "--file",
                    fileWith(file), "--speed", "1000"});
    EXPECT_EQ(run.status, 0) << run.err;
    ASSERT_TRUE(server.waitForNewConnection(5000));
    QTcpSocket* connection = server.nextPendingConnection();
    QByteArray received;
    while (connection->waitForReadyRead(1000)) {
        received += connection->readAll();
    }
    EXPECT_TRUE(received.toStdString() == file);
}

TEST(SendCommand, SaysWhatIsWrongWithAFileWithoutDatagrams) {
    const ProgramRun run =
        runProgram({"send", "--to", "127.0.0.1:9", "--file", fileWith("nothing of the kind")});
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.err, testing::HasSubstr("no datagrams found"));
}

#ifdef __linux__
TEST(SendCommand, SaysThatTheNetworkRefusesEverythingAndEndsWithStatusOne) {
    const std::string nowhere = "[fe80::1%lo]:9763"; // no way leads there
    Listener listener;
    for (const bool isOfFile : {false, true}) {
        std::vector<std::string> arguments{"send", "--to", listener.place(), "--to", nowhere};
        const std::string file = fileWith(numbered(1) + numbered(2));
        const std::vector<std::string> more =
            isOfFile ? std::vector<std::string>{"--file", file}
                     : std::vector<std::string>{"--types", "02", "--characters", "1", "--duration", "0.1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramRun run = runProgram(arguments);
        EXPECT_EQ(run.status, 1) << run.err;
        EXPECT_THAT(run.err, testing::HasSubstr(nowhere + ": the network refuses to send there"));
        EXPECT_THAT(run.err, testing::HasSubstr(nowhere + ": nothing was sent there"));
        EXPECT_THAT(run.err, testing::Not(testing::HasSubstr(listener.place())));
        EXPECT_FALSE(listener.datagrams().empty());
    }
}
#endif

TEST(SendCommand, WritesTheTruthAboutEveryDatagramThatLeft) {
    Listener listener;
    const std::string truthFile = newPath();
    const ProgramRun run = runProgram({"send", "--to", listener.place(), "--types", "24", "--characters", "1",
                                       "--rate", "200", "--duration", "0.5", "--drop", "0.2", "--duplicate",
                                       "0.2", "--truncate", "0.1", "--truth", truthFile});
    EXPECT_EQ(run.status, 0) << run.err;
    const auto truth = nlohmann::json::parse(textOfFile(truthFile));
    const auto& sender = truth.at("sources").at(0);
    const auto& stream = sender.at("characters").at(0).at("streams").at(0);
    const std::size_t arrived = listener.datagrams().size();
    EXPECT_EQ(truth.at("foreignDatagrams").get<std::size_t>() + sender.at("malformed").get<std::size_t>() +
                  sender.at("datagrams").get<std::size_t>(),
              arrived);
    EXPECT_EQ(stream.at("type"), "24");
    EXPECT_EQ(stream.at("samples").get<std::size_t>() + stream.at("lost").get<std::size_t>(),
              stream.at("lastSample").get<std::size_t>() - stream.at("firstSample").get<std::size_t>() + 1);
    EXPECT_THAT(sender.at("address").get<std::string>(), testing::StartsWith("127.0.0.1:"));
}

TEST(SendCommand, SendsFromTwoSocketsWithTheSameCharacters) {
    Listener listener;
    const std::string truthFile = newPath();
    const ProgramRun run =
        runProgram({"send", "--to", listener.place(), "--types", "02", "--characters", "1", "--rate", "100",
                    "--duration", "0.1", "--senders", "2", "--truth", truthFile});
    EXPECT_EQ(run.out, "sent 20 datagrams\n") << run.err;
    const auto senders = nlohmann::json::parse(textOfFile(truthFile)).at("sources");
    ASSERT_EQ(senders.size(), 2U);
    EXPECT_NE(senders[0].at("address"), senders[1].at("address"));
    EXPECT_EQ(senders[0].at("characters"), senders[1].at("characters"));
}

TEST(SendCommand, SaysHowFaultsAreToBeGiven) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"--drop", "2"}, "--drop"},
        {{"--burst", "3"}, "--drop"},
        {{"--pause-at", "soon"}, "START:LENGTH"},
        {{"--restart-at", "1:x"}, "SECONDS:SAMPLE"},
        {{"--reduce-at", "1:0"}, "every 1st to 100th"},
        {{"--gilbert-elliott", "0.1"}, "p,r,k,h"},
        {{"--truth", "x"}, "--duration"}};
    for (const auto& [arguments, expected] : cases) {
        std::vector<std::string> all{"send"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const ProgramRun run = runProgram(all);
        EXPECT_EQ(run.status, 2);
        EXPECT_THAT(run.err, testing::HasSubstr(expected));
    }
}

} // namespace
} // namespace posewire::cli::test
