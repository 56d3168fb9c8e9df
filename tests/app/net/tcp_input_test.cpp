// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/receiver.h"
#include "tests/app/net/net_fixture.h"
#include "tests/app/net/tcp_sending.h"

#include <QHostAddress>
#include <QTcpServer>
#include <QTcpSocket>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace posewire::net {
namespace {

using ::testing::HasSubstr;

std::vector<std::byte> datagrams(std::uint32_t count) {
    std::vector<std::byte> bytes;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto one = datagram(i);
        bytes.insert(bytes.end(), one.begin(), one.end());
    }
    return bytes;
}

std::vector<std::byte> garbage(std::size_t size) {
    return std::vector<std::byte>(size, std::byte{0x55});
}

class TcpInputTest : public ::testing::TestWithParam<ReceivePath> {
protected:
    [[nodiscard]] static ReceiverOptions options() {
        ReceiverOptions options;
        options.path = GetParam();
        return options;
    }
    void listen() { ASSERT_TRUE(receiving.receiver->addTcpListener({"127.0.0.1", 0})); }

    std::unique_ptr<QTcpSocket> connected() {
        auto socket = std::make_unique<QTcpSocket>();
        socket->connectToHost(QHostAddress::LocalHost, status().endpoint.port);
        EXPECT_TRUE(socket->waitForConnected(5000));
        return socket;
    }
    [[nodiscard]] InputStatus status() const { return receiving.receiver->inputs().at(0); }

    /// How many packets of the log are the datagrams they should be, in order of their samples.
    std::uint64_t datagramsInOrder() {
        log::LogReader reader(receiving.log);
        std::uint32_t next = 0;
        for (std::uint64_t i = 0; i < reader.end(); ++i) {
            const auto packet = reader.packet(i);
            next += !packet->flags.skipped && equal(packet->bytes, datagram(next)) ? 1 : 0;
        }
        return next;
    }

    Receiving receiving{options(), 0};
};

TEST_P(TcpInputTest, DatagramsOfAPeerAreInTheLogWithItsAddress) {
    listen();
    const auto peer = connected();
    send(*peer, datagrams(100));
    ASSERT_TRUE(eventually([&] { return receiving.packets() == 100; }));
    EXPECT_EQ(datagramsInOrder(), 100U);
    const log::SenderInfo sender = *receiving.log.senders().find(log::SenderId{});
    EXPECT_EQ(sender.address, "127.0.0.1:" + std::to_string(peer->localPort()));
    EXPECT_EQ(sender.transport, log::Transport::Tcp);
    EXPECT_EQ(sender.localPort, status().endpoint.port);
    EXPECT_EQ(receiving.totals().datagrams, 100U);
    EXPECT_EQ(status().datagrams, 100U);
    ASSERT_TRUE(eventually([&] { return status().peers.size() == 1 && status().peers[0].datagrams == 100; }));
    EXPECT_EQ(status().peers[0].address, sender.address);
}

TEST_P(TcpInputTest, APeerThatSendsAByteAtATimeIsReadLikeAnyOther) {
    listen();
    const auto peer = connected();
    peer->setSocketOption(QAbstractSocket::LowDelayOption, 1);
    const auto bytes = datagrams(20);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        send(*peer, std::span(bytes).subspan(i, 1));
    }
    ASSERT_TRUE(eventually([&] { return receiving.packets() == 20; })) << receiving.packets();
    EXPECT_EQ(datagramsInOrder(), 20U);
}

TEST_P(TcpInputTest, GarbageIsSkippedAndDatagramsBehindItAreFound) {
    listen();
    const auto peer = connected();
    send(*peer, garbage(1000));
    send(*peer, datagrams(5));
    ASSERT_TRUE(eventually([&] { return datagramsInOrder() == 5; }));
    EXPECT_EQ(status().skippedBytes, 1000U);
    EXPECT_EQ(status().datagrams, 5U);
    log::LogReader reader(receiving.log);
    std::size_t skipped = 0;
    for (std::uint64_t i = 0; i < reader.end(); ++i) {
        const auto packet = reader.packet(i);
        skipped += packet->flags.skipped ? packet->bytes.size() : 0;
    }
    EXPECT_EQ(skipped, 1000U);
}

TEST_P(TcpInputTest, AnEndInsideADatagramGivesWhatCameOfIt) {
    listen();
    auto peer = connected();
    auto bytes = datagrams(3);
    bytes.resize(bytes.size() - 10);
    send(*peer, bytes);
    peer->disconnectFromHost();
    ASSERT_TRUE(eventually([&] { return receiving.packets() == 3; })) << receiving.packets();
    log::LogReader reader(receiving.log);
    EXPECT_EQ(reader.packet(2)->bytes.size(), datagram(0).size() - 10);
    EXPECT_TRUE(eventually([&] { return status().peers.empty(); }));
    EXPECT_THAT(status().text, HasSubstr("nobody"));
}

TEST_P(TcpInputTest, SeveralPeersAreSendersOfTheirOwn) {
    listen();
    std::vector<std::unique_ptr<QTcpSocket>> peers;
    for (int i = 0; i < 5; ++i) {
        peers.push_back(connected());
        send(*peers.back(), datagrams(10));
    }
    ASSERT_TRUE(eventually([&] { return receiving.packets() == 50; }));
    EXPECT_EQ(receiving.log.senders().size(), 5U);
    EXPECT_TRUE(eventually([&] { return status().peers.size() == 5; }));
    EXPECT_EQ(status().text, "5 connected");
}

TEST_P(TcpInputTest, AFloodLosesNothingAndKeepsUdpGoing) {
    listen();
    ASSERT_TRUE(receiving.receiver->addUdp(Endpoint{"127.0.0.1", 0}));
    const SendTarget udp = receiving.target(1);
    constexpr std::uint32_t kCount = 200'000; // 11 MB: more than the queue holds
    std::thread flooding([&, port = status().endpoint.port] {
        QTcpSocket socket;
        socket.connectToHost(QHostAddress::LocalHost, port);
        ASSERT_TRUE(socket.waitForConnected(5000));
        const auto bytes = datagrams(1000);
        for (std::uint32_t i = 0; i < kCount / 1000; ++i) {
            send(socket, bytes);
        }
    });
    auto sender = DatagramSender::connect(udp);
    for (std::size_t i = 0; i < 500; ++i) {
        ASSERT_TRUE(sender->send(numbered(760, i)).has_value());
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    flooding.join();
    ASSERT_TRUE(eventually([&] { return receiving.packets() == kCount + 500; })) << receiving.packets();
    EXPECT_EQ(receiving.totals().kernelDropped, 0U);
    EXPECT_EQ(receiving.totals().datagrams, kCount + 500U);
}

TEST_P(TcpInputTest, StopsAmidAFlood) {
    listen();
    std::atomic<bool> isStopping = false;
    std::thread flooding([&, port = status().endpoint.port] {
        QTcpSocket socket;
        socket.connectToHost(QHostAddress::LocalHost, port);
        EXPECT_TRUE(socket.waitForConnected(5000));
        const auto bytes = garbage(1 << 20);
        while (!isStopping && socket.state() == QAbstractSocket::ConnectedState) {
            socket.write(reinterpret_cast<const char*>(bytes.data()), static_cast<qint64>(bytes.size()));
            socket.waitForBytesWritten(100);
        }
    });
    ASSERT_TRUE(eventually([&] { return receiving.packets() > 10; }));
    const auto begin = std::chrono::steady_clock::now();
    receiving.receiver.reset();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
    isStopping = true;
    flooding.join();
}

TEST_P(TcpInputTest, ConnectsToASenderAndAgainAfterItRestarted) {
    QTcpServer server;
    ASSERT_TRUE(server.listen(QHostAddress::LocalHost));
    const std::uint16_t port = server.serverPort();
    receiving.receiver->addTcpConnection({"127.0.0.1", port});
    ASSERT_TRUE(server.waitForNewConnection(5000));
    std::unique_ptr<QTcpSocket> peer(server.nextPendingConnection());
    send(*peer, datagrams(10));
    ASSERT_TRUE(eventually([&] { return receiving.packets() == 10; }));
    EXPECT_TRUE(eventually([&] { return status().state == InputState::Connected; }));
    peer.reset();
    server.close();
    ASSERT_TRUE(eventually([&] { return status().state == InputState::Retrying; }));
    EXPECT_THAT(status().problem, HasSubstr("the sender closed the connection. Trying again"));
    ASSERT_TRUE(server.listen(QHostAddress::LocalHost, port));
    ASSERT_TRUE(server.waitForNewConnection(8000));
    peer.reset(server.nextPendingConnection());
    send(*peer, datagrams(10));
    EXPECT_TRUE(eventually([&] { return receiving.packets() == 20; }));
    EXPECT_EQ(receiving.log.senders().size(), 1U) << "one sender, however often connected";
}

TEST_P(TcpInputTest, ASenderThatIsNotThereYetIsTriedAgain) {
    std::uint16_t port = 0;
    {
        QTcpServer server;
        ASSERT_TRUE(server.listen(QHostAddress::LocalHost));
        port = server.serverPort();
    }
    receiving.receiver->addTcpConnection({"127.0.0.1", port});
    ASSERT_TRUE(eventually([&] { return status().state == InputState::Retrying; }));
    EXPECT_EQ(status().problem, "127.0.0.1:" + std::to_string(port) +
                                    ": connection refused; is the sender on, and does it listen there? "
                                    "Trying again");
    QTcpServer server;
    ASSERT_TRUE(server.listen(QHostAddress::LocalHost, port));
    EXPECT_TRUE(server.waitForNewConnection(8000));
    EXPECT_TRUE(eventually([&] { return status().state == InputState::Connected; }));
}

TEST_P(TcpInputTest, AHostThatNobodyKnowsIsToldSo) {
    receiving.receiver->addTcpConnection({"no-such-host.invalid", 9763});
    ASSERT_TRUE(eventually([&] { return !status().problem.empty(); }));
    EXPECT_THAT(status().problem, HasSubstr("no-such-host.invalid:9763: "));
    EXPECT_THAT(status().problem, HasSubstr("Trying again"));
}

TEST_P(TcpInputTest, AConnectionThatIsRemovedIsNotTriedAgain) {
    QTcpServer server;
    ASSERT_TRUE(server.listen(QHostAddress::LocalHost));
    const InputId id = receiving.receiver->addTcpConnection({"127.0.0.1", server.serverPort()});
    ASSERT_TRUE(server.waitForNewConnection(5000));
    const std::unique_ptr<QTcpSocket> peer(server.nextPendingConnection());
    EXPECT_TRUE(receiving.receiver->remove(id));
    EXPECT_TRUE(peer->state() == QAbstractSocket::UnconnectedState || peer->waitForDisconnected(5000));
    EXPECT_FALSE(server.waitForNewConnection(400));
}

INSTANTIATE_TEST_SUITE_P(Paths, TcpInputTest, ::testing::Values(ReceivePath::Native, ReceivePath::Portable),
                         &pathName);

} // namespace
} // namespace posewire::net
