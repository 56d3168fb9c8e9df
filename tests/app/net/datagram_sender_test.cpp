// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/datagram_sender.h"

#include "tests/app/net/net_fixture.h"

#include <QHostAddress>
#include <QTcpServer>
#include <QTcpSocket>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace posewire::net {
namespace {

using ::testing::HasSubstr;

SendTarget tcp(const QTcpServer& server) {
    return {{"127.0.0.1", server.serverPort()}, SendTarget::Transport::Tcp};
}

TEST(DatagramSender, CountsWhatItSends) {
    Receiving receiving;
    auto sender = DatagramSender::connect(receiving.target());
    ASSERT_TRUE(sender.has_value());
    for (std::size_t i = 0; i < 10; ++i) {
        ASSERT_TRUE(sender->send(numbered(760, i)).has_value());
    }
    EXPECT_EQ(sender->sent(), 10U);
    EXPECT_EQ(sender->refused(), 0U);
    EXPECT_TRUE(eventually([&] { return receiving.packets() == 10; }));
}

TEST(DatagramSender, TcpCarriesDatagramsBackToBack) {
    QTcpServer server;
    ASSERT_TRUE(server.listen(QHostAddress::LocalHost));
    auto sender = DatagramSender::connect(tcp(server));
    ASSERT_TRUE(sender.has_value()) << sender.error().text;
    ASSERT_TRUE(server.waitForNewConnection(5000));
    const std::unique_ptr<QTcpSocket> peer(server.nextPendingConnection());
    std::vector<std::byte> expected;
    for (std::size_t i = 0; i < 20; ++i) {
        const auto datagram = numbered(760 + i, i);
        expected.insert(expected.end(), datagram.begin(), datagram.end());
        ASSERT_TRUE(sender->send(datagram).has_value());
    }
    ASSERT_TRUE(sender->flush().has_value());
    QByteArray got;
    while (got.size() < static_cast<qsizetype>(expected.size()) && peer->waitForReadyRead(5000)) {
        got += peer->readAll();
    }
    EXPECT_TRUE(
        equal(std::as_bytes(std::span(got.constData(), static_cast<std::size_t>(got.size()))), expected));
}

TEST(DatagramSender, TcpWithoutReceiverIsAClearError) {
    std::uint16_t port = 0;
    {
        QTcpServer server;
        ASSERT_TRUE(server.listen(QHostAddress::LocalHost));
        port = server.serverPort();
    }
    const auto sender = DatagramSender::connect({{"127.0.0.1", port}, SendTarget::Transport::Tcp});
    ASSERT_FALSE(sender.has_value());
    EXPECT_EQ(sender.error().kind, NetError::Kind::NotConnected);
    EXPECT_THAT(sender.error().text, HasSubstr("127.0.0.1:" + std::to_string(port)));
}

TEST(DatagramSender, TcpThatEndedIsAnError) {
    QTcpServer server;
    ASSERT_TRUE(server.listen(QHostAddress::LocalHost));
    auto sender = DatagramSender::connect(tcp(server));
    ASSERT_TRUE(sender.has_value());
    ASSERT_TRUE(server.waitForNewConnection(5000));
    delete server.nextPendingConnection();
    NetResult<void> result;
    EXPECT_TRUE(eventually([&] {
        result = sender->send(numbered(100'000, 1));
        return !result.has_value();
    }));
    EXPECT_EQ(result.error().kind, NetError::Kind::NotConnected);
}

TEST(DatagramSender, DatagramTooLongForUdpIsCounted) {
    const Receiving receiving;
    auto sender = DatagramSender::connect(receiving.target());
    ASSERT_TRUE(sender->send(numbered(70'000, 1)).has_value());
    EXPECT_EQ(sender->refused(), 1U);
}

} // namespace
} // namespace posewire::net
