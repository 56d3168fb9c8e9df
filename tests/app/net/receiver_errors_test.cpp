// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/listening.h"
#include "app/net/port_holder.h"
#include "app/net/receiver.h"
#include "tests/app/net/net_fixture.h"

#include <QUdpSocket>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#ifdef __linux__
#include <sys/prctl.h>
#include <unistd.h>
#endif

namespace posewire::net {
namespace {

using ::testing::HasSubstr;

class ReceiverErrorsTest : public ::testing::TestWithParam<ReceivePath> {
protected:
    [[nodiscard]] static ReceiverOptions options() {
        ReceiverOptions options;
        options.path = GetParam();
        return options;
    }
    /// What goes wrong with this input in a receiver that has no other.
    [[nodiscard]] static NetError errorOf(const UdpInput& where) {
        const Receiving receiving(options(), 0);
        const auto id = receiving.receiver->addUdp(where);
        EXPECT_FALSE(id);
        EXPECT_TRUE(receiving.receiver->inputs().empty());
        return id ? NetError{} : id.error();
    }
};

TEST_P(ReceiverErrorsTest, PortInUseNamesTheHolder) {
    const Receiving first(options());
    const Endpoint taken = first.endpoint();
    const NetError error = errorOf({taken, {}});
    EXPECT_EQ(error.kind, NetError::Kind::PortInUse);
    EXPECT_THAT(error.text, HasSubstr("UDP port " + std::to_string(taken.port)));
    EXPECT_THAT(error.text, HasSubstr("in use by"));
    EXPECT_EQ(error.text.find('\n'), std::string::npos);
#ifdef __linux__
    EXPECT_THAT(error.text, HasSubstr("app_net_test"));
    EXPECT_THAT(error.text, HasSubstr(std::to_string(::getpid())));
#endif
}

TEST_P(ReceiverErrorsTest, TcpPortInUseNamesTheHolder) {
    const Receiving receiving(options(), 0);
    ASSERT_TRUE(receiving.receiver->addTcpListener({"127.0.0.1", 0}));
    const Endpoint taken = receiving.endpoint();
    const auto second = receiving.receiver->addTcpListener(taken);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().kind, NetError::Kind::PortInUse);
    EXPECT_THAT(second.error().text, HasSubstr("TCP port " + std::to_string(taken.port)));
#ifdef __linux__
    EXPECT_THAT(second.error().text, HasSubstr("app_net_test"));
#endif
}

TEST_P(ReceiverErrorsTest, AnInputThatFailsLeavesTheOthersAlone) {
    const Receiving receiving(options());
    ASSERT_FALSE(receiving.receiver->addUdp(receiving.endpoint()));
    EXPECT_EQ(receiving.receiver->inputs().size(), 1U);
    auto sender = DatagramSender::connect(receiving.target());
    ASSERT_TRUE(sender->send(numbered(760, 1)).has_value());
    EXPECT_TRUE(eventually([&] { return receiving.packets() == 1; }));
}

TEST_P(ReceiverErrorsTest, AddressOfAnotherComputerIsClear) {
    if (QUdpSocket().bind(QHostAddress(QStringLiteral("192.0.2.1")), 0)) { // as Wine does
        GTEST_SKIP() << "this system takes addresses of other computers";
    }
    const NetError error = errorOf({{"192.0.2.1", 0}, {}});
    EXPECT_EQ(error.kind, NetError::Kind::AddressNotHere);
    EXPECT_THAT(error.text, HasSubstr("192.0.2.1 is not an address of this computer"));
}

TEST_P(ReceiverErrorsTest, NameInsteadOfAnAddressIsClear) {
    const NetError error = errorOf({{"not-an-address", 0}, {}});
    EXPECT_EQ(error.kind, NetError::Kind::BadEndpoint);
    EXPECT_THAT(error.text, HasSubstr("not-an-address"));
}

TEST_P(ReceiverErrorsTest, AnInterfaceThatIsNotHereIsClear) {
    const NetError error = errorOf({{"fe80::1%nope", 0}, {}});
    EXPECT_EQ(error.kind, NetError::Kind::AddressNotHere);
    EXPECT_THAT(error.text, HasSubstr("fe80::1%nope: there is no interface nope here; write one of those"));
    const auto target = lookUp({"fe80::1%nope", 9763});
    ASSERT_FALSE(target);
    EXPECT_THAT(target.error().text, HasSubstr("there is no interface nope here"));
}

TEST_P(ReceiverErrorsTest, GroupsThatAreNoneAreClear) {
    UdpInput where{Endpoint{"", 0}, {}};
    where.groups.emplace_back("10.0.0.1");
    EXPECT_THAT(errorOf(where).text, HasSubstr("10.0.0.1\" is not a multicast group"));
    where = {Endpoint{"127.0.0.1", 0}, {}};
    where.groups.emplace_back("239.1.2.3");
    EXPECT_THAT(errorOf(where).text, HasSubstr("receives no multicast"));
}

INSTANTIATE_TEST_SUITE_P(Paths, ReceiverErrorsTest,
                         ::testing::Values(ReceivePath::Native, ReceivePath::Portable), &pathName);

TEST(PortHolder, NothingForAPortThatNobodyHolds) {
    std::uint16_t port = 0;
    {
        const Receiving receiving;
        port = receiving.endpoint().port;
#ifdef __linux__
        ASSERT_TRUE(holderOfPort(port, false).has_value());
        EXPECT_EQ(holderOfPort(port, false)->id, ::getpid());
#endif
    }
    EXPECT_FALSE(holderOfPort(port, false).has_value());
}

#ifdef __linux__
TEST(PortHolder, ThatIsAnotherPosewireCanRelay) {
    std::array<char, 16> name{};
    ::prctl(PR_GET_NAME, name.data());
    ::prctl(PR_SET_NAME, "posewire");
    const Receiving first;
    const auto second = first.receiver->addUdp({first.endpoint(), {}});
    ::prctl(PR_SET_NAME, name.data());
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().text,
              "UDP port " + std::to_string(first.endpoint().port) +
                  " of 127.0.0.1 is in use by another Posewire (process " + std::to_string(::getpid()) +
                  "); close it, or use another port here and let that Posewire relay to it");
}
#endif

TEST(PortHolder, TellsWhoListensByTcp) {
    const Receiving receiving({}, 0);
    ASSERT_TRUE(receiving.receiver->addTcpListener({"127.0.0.1", 0}));
    const std::uint16_t port = receiving.endpoint().port;
#ifdef __linux__
    ASSERT_TRUE(holderOfPort(port, true).has_value());
    EXPECT_EQ(holderOfPort(port, true)->id, ::getpid());
#endif
    EXPECT_FALSE(holderOfPort(port, false).has_value());
}

} // namespace
} // namespace posewire::net
