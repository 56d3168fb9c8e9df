// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/receiver.h"
#include "tests/app/net/net_fixture.h"
#include "tests/app/net/tcp_sending.h"

#include <QHostAddress>
#include <QTcpSocket>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <vector>

#ifdef __linux__
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>
#endif

namespace posewire::net {
namespace {

using std::chrono::seconds;
using ::testing::HasSubstr;

/// The system's clock, which a test can set forward.
class ForwardClock final : public log::Clock {
public:
    [[nodiscard]] log::WallTime wall() const override { return m_system.wall() + m_ahead.load(); }
    [[nodiscard]] log::Moment monotonic() const override { return m_system.monotonic() + m_ahead.load(); }
    void forward(log::Duration by) { m_ahead = m_ahead.load() + by; }

private:
    log::SystemClock m_system;
    std::atomic<log::Duration> m_ahead{};
};

/// A TCP listener with all its places taken, or not.
class TcpRoomTest : public ::testing::Test {
protected:
    using Socket = std::unique_ptr<QTcpSocket>;

    TcpRoomTest() { EXPECT_TRUE(receiver->addTcpListener({"127.0.0.1", 0})); }

    Socket connected() {
        auto socket = std::make_unique<QTcpSocket>();
        socket->connectToHost(QHostAddress::LocalHost, status().endpoint.port);
        EXPECT_TRUE(socket->waitForConnected(5000));
        return socket;
    }
    std::vector<Socket> fill() {
        std::vector<Socket> sockets;
        while (sockets.size() < Receiver::kMostPeers) {
            sockets.push_back(connected());
        }
        EXPECT_TRUE(eventually([&] { return status().peers.size() == Receiver::kMostPeers; }));
        return sockets;
    }
    /// One whole datagram by each.
    void allSend(std::vector<Socket>& sockets) {
        const std::uint64_t before = status().datagrams;
        for (const Socket& socket : sockets) {
            send(*socket, datagram(1));
        }
        EXPECT_TRUE(eventually([&] { return status().datagrams == before + sockets.size(); }));
    }
    [[nodiscard]] InputStatus status() const { return receiver->inputs().at(0); }
    static bool isOpen(QTcpSocket& socket) {
        socket.waitForReadyRead(50);
        return socket.state() == QAbstractSocket::ConnectedState;
    }

    log::PacketLog log;
    ForwardClock clock;
    std::unique_ptr<Receiver> receiver = std::make_unique<Receiver>(log, clock);
};

TEST_F(TcpRoomTest, SilentConnectionsKeepNobodyOut) {
    const auto silent = fill();
    const Socket mvn = connected();
    send(*mvn, datagram(1));
    ASSERT_TRUE(eventually([&] { return status().datagrams == 1; }));
    EXPECT_EQ(status().closedPeers, 1U);
    EXPECT_EQ(status().refusedPeers, 0U);
    EXPECT_EQ(status().peers.size(), Receiver::kMostPeers);
    EXPECT_EQ(status().text, "64 connected; 1 idle connection was closed to make room");
    EXPECT_FALSE(isOpen(*silent[0])) << "the oldest goes";
    EXPECT_TRUE(isOpen(*silent[1]));
}

TEST_F(TcpRoomTest, ConnectionsInUseAreKeptAndTheNewOneIsRefused) {
    auto peers = fill();
    allSend(peers);
    const Socket late = connected();
    ASSERT_TRUE(eventually([&] { return status().refusedPeers == 1; }));
    EXPECT_EQ(status().closedPeers, 0U);
    EXPECT_THAT(status().note, HasSubstr("1 connection was refused: 64 are open and in use"));
}

TEST_F(TcpRoomTest, OneDatagramAndSilenceKeepNobodyOut) {
    auto peers = fill();
    allSend(peers);
    clock.forward(seconds(6));
    const Socket mvn = connected();
    send(*mvn, datagram(1));
    ASSERT_TRUE(eventually([&] { return status().datagrams == peers.size() + 1; }));
    EXPECT_EQ(status().refusedPeers, 0U);
    EXPECT_THAT(status().note, HasSubstr("1 idle connection was closed to make room"));
    EXPECT_FALSE(isOpen(*peers[0])) << "the longest silent goes";
    EXPECT_TRUE(isOpen(*peers[1]));
}

TEST_F(TcpRoomTest, ASenderThatPausesIsNotPutOutByThoseWhoNeverSent) {
    auto peers = fill();
    send(*peers[0], datagram(1));
    ASSERT_TRUE(eventually([&] { return status().datagrams == 1; }));
    clock.forward(seconds(6));
    const Socket late = connected();
    ASSERT_TRUE(eventually([&] { return status().closedPeers == 1; }));
    EXPECT_TRUE(isOpen(*peers[0]));
    EXPECT_FALSE(isOpen(*peers[1]));
}

TEST_F(TcpRoomTest, AHalfOpenConnectionGoesBeforeAnIdleOne) {
    auto peers = fill();
    for (std::size_t i = 0; i + 1 < peers.size(); ++i) {
        send(*peers[i], datagram(1));
    }
    ASSERT_TRUE(eventually([&] { return status().datagrams == peers.size() - 1; }));
    clock.forward(seconds(31)); // now all of them are idle, and the last is half-open
    const Socket late = connected();
    ASSERT_TRUE(eventually([&] { return status().closedPeers == 1; }));
    EXPECT_FALSE(isOpen(*peers.back()));
    EXPECT_TRUE(isOpen(*peers.front()));
}

TEST_F(TcpRoomTest, WhoTricklesBytesGivesWayLikeWhoIsSilent) {
    auto peers = fill();
    allSend(peers);
    clock.forward(seconds(31));
    const auto whole = datagram(2);
    for (std::size_t i = 1; i < peers.size(); ++i) {
        send(*peers[i], whole);
    }
    send(*peers[0], std::span(whole).first(5)); // bytes, and no datagram
    ASSERT_TRUE(eventually([&] { return status().datagrams == 2 * peers.size() - 1; }));
    const Socket late = connected();
    ASSERT_TRUE(eventually([&] { return status().closedPeers == 1; }));
    EXPECT_FALSE(isOpen(*peers[0]));
    EXPECT_TRUE(eventually([&] { return log.figures().end == 2 * peers.size(); })) << "the five bytes too";
}

TEST_F(TcpRoomTest, WhatTheClosedConnectionHadSentIsKept) {
    auto peers = fill();
    std::vector<std::byte> garbage(300'000, std::byte{0x55}); // in no hurry to become a datagram
    send(*peers[0], garbage);
    const Socket late = connected();
    ASSERT_TRUE(eventually([&] { return status().closedPeers == 1; }));
    EXPECT_FALSE(isOpen(*peers[0]));
    EXPECT_EQ(status().bytes, garbage.size());
    EXPECT_EQ(status().skippedBytes, garbage.size());
}

#ifdef __linux__
TEST_F(TcpRoomTest, WhereTheSystemLetsNobodyInThatIsToldAndTriedAgain) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(status().endpoint.port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int client = ::socket(AF_INET, SOCK_STREAM, 0);
    std::vector<int> files;
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
    const rlimit few{std::min<rlim_t>(before.rlim_cur, 512), before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
    for (int file = ::dup(client); file >= 0; file = ::dup(client)) {
        files.push_back(file);
    }
    const bool isConnected = ::connect(client, reinterpret_cast<sockaddr*>(&place), sizeof place) == 0;
    const bool isTold = eventually([&] { return !status().problem.empty(); });
    const std::string problem = status().problem;
    std::ranges::for_each(files, ::close);
    ::setrlimit(RLIMIT_NOFILE, &before);
    EXPECT_TRUE(isConnected && isTold);
    EXPECT_THAT(problem, HasSubstr("the system lets nobody in ("));
    EXPECT_TRUE(eventually([&] { return status().peers.size() == 1; })) << "it is let in when there is room";
    EXPECT_EQ(status().problem, "");
    ::close(client);
}
#endif

TEST_F(TcpRoomTest, OthersThanThoseListenedToAreClosedAndCounted) {
    const Socket before = connected();
    ASSERT_TRUE(eventually([&] { return status().peers.size() == 1; }));
    receiver->listenTo(*AllowList::of({"192.0.2.0/24"}));
    EXPECT_FALSE(isOpen(*before));
    const Socket after = connected();
    ASSERT_TRUE(eventually([&] { return status().refusedPeers == 2; }));
    EXPECT_TRUE(status().peers.empty());
    EXPECT_THAT(status().text, HasSubstr("2 connections were closed: only chosen hosts are listened to"));
    receiver->listenTo({});
    const Socket again = connected();
    EXPECT_TRUE(eventually([&] { return status().peers.size() == 1; }));
}

} // namespace
} // namespace posewire::net
