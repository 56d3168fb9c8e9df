// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/receiver.h"
#include "tests/app/net/net_fixture.h"

#include <QHostAddress>
#include <QNetworkInterface>
#include <QUdpSocket>

#include <gtest/gtest.h>

namespace posewire::net {
namespace {

QNetworkInterface loopback() {
    for (const QNetworkInterface& interface : QNetworkInterface::allInterfaces()) {
        if (interface.flags().testFlag(QNetworkInterface::IsLoopBack)) {
            return interface;
        }
    }
    return {};
}

/// Sends one datagram to a group by the loopback interface, so that it goes to no network. False where the
/// system does not let it.
bool sendToGroup(const QHostAddress& group, std::uint16_t port) {
    QUdpSocket socket;
    const bool isIpv4 = group.protocol() == QAbstractSocket::IPv4Protocol;
    socket.bind(isIpv4 ? QHostAddress::LocalHost : QHostAddress::LocalHostIPv6, 0);
    socket.setMulticastInterface(loopback());
    const auto bytes = numbered(760, 1);
    return socket.writeDatagram(reinterpret_cast<const char*>(bytes.data()), 760, group, port) == 760;
}

class GroupsTest : public ::testing::TestWithParam<ReceivePath> {
protected:
    [[nodiscard]] static ReceiverOptions options() {
        ReceiverOptions options;
        options.path = GetParam();
        return options;
    }
    Receiving receiving{options(), 0};
};

TEST_P(GroupsTest, HearsAnIpv4GroupAndUnicastOfBothKindsAtOnePort) {
    UdpInput where{Endpoint{"", 0}, {}};
    where.groups.emplace_back("239.255.42.99");
    const auto id = receiving.receiver->addUdp(where);
    ASSERT_TRUE(id) << id.error().text;
    if (!sendToGroup(QHostAddress(QStringLiteral("239.255.42.99")), receiving.endpoint().port)) {
        GTEST_SKIP() << "this system sends no multicast by loopback";
    }
    EXPECT_TRUE(eventually([&] { return receiving.packets() == 1; }));
    for (const char* host : {"127.0.0.1", "::1"}) {
        const std::uint64_t before = receiving.packets();
        auto sender = DatagramSender::connect({{host, receiving.endpoint().port}});
        ASSERT_TRUE(sender->send(numbered(760, 2)).has_value());
        if (sender->refused() == 0) { // else this computer has no IPv6
            EXPECT_TRUE(eventually([&] { return receiving.packets() == before + 1; })) << host;
        }
    }
    EXPECT_EQ(receiving.receiver->inputs().size(), 1U);
    EXPECT_EQ(receiving.receiver->inputs()[0].datagrams, receiving.packets());
}

TEST_P(GroupsTest, HearsAnIpv6Group) {
    UdpInput where{Endpoint{"", 0}, {}};
    where.groups.emplace_back("ff15::4d58:5450");
    const auto id = receiving.receiver->addUdp(where);
    if (!id) {
        GTEST_SKIP() << "no IPv6 multicast here: " << id.error().text;
    }
    if (!sendToGroup(QHostAddress(QStringLiteral("ff15::4d58:5450")), receiving.endpoint().port)) {
        GTEST_SKIP() << "this system sends no IPv6 multicast by loopback";
    }
    EXPECT_TRUE(eventually([&] { return receiving.packets() == 1; }));
}

TEST_P(GroupsTest, AGroupAsHostIsJoined) {
    const auto id = receiving.receiver->addUdp(Endpoint{"239.255.42.98", 0});
    ASSERT_TRUE(id) << id.error().text;
    if (!sendToGroup(QHostAddress(QStringLiteral("239.255.42.98")), receiving.endpoint().port)) {
        GTEST_SKIP() << "this system sends no multicast by loopback";
    }
    EXPECT_TRUE(eventually([&] { return receiving.packets() == 1; }));
}

TEST_P(GroupsTest, HearsBroadcasts) {
    ASSERT_TRUE(receiving.receiver->addUdp(Endpoint{"", 0}));
    auto sender = DatagramSender::connect({{"127.255.255.255", receiving.endpoint().port}});
    ASSERT_TRUE(sender);
    ASSERT_TRUE(sender->send(numbered(760, 1)).has_value());
    if (sender->refused() != 0) {
        GTEST_SKIP() << "this system sends no broadcast by loopback";
    }
    EXPECT_TRUE(eventually([&] { return receiving.packets() == 1; }));
}

INSTANTIATE_TEST_SUITE_P(Paths, GroupsTest, ::testing::Values(ReceivePath::Native, ReceivePath::Portable),
                         &pathName);

} // namespace
} // namespace posewire::net
