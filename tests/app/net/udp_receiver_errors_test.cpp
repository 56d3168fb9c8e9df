// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/port_holder.h"
#include "app/net/udp_receiver.h"
#include "tests/app/net/net_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#ifdef __linux__
#include <unistd.h>
#endif

namespace posewire::net {
namespace {

using ::testing::HasSubstr;

class UdpReceiverErrorsTest : public ::testing::TestWithParam<ReceivePath> {
protected:
    [[nodiscard]] static ReceiveOptions on(const Endpoint& endpoint) {
        ReceiveOptions options;
        options.endpoints = {endpoint};
        options.path = GetParam();
        return options;
    }
};

TEST_P(UdpReceiverErrorsTest, PortInUseNamesTheHolder) {
    const Receiving first(on({"127.0.0.1", 0}));
    ASSERT_TRUE(first.isRunning());
    const Endpoint taken = first.target().endpoint;
    const Receiving second(on(taken));
    ASSERT_FALSE(second.isRunning());
    const NetError& error = second.receiver.error();
    EXPECT_EQ(error.kind, NetError::Kind::PortInUse);
    EXPECT_THAT(error.text, HasSubstr("UDP port " + std::to_string(taken.port)));
    EXPECT_THAT(error.text, HasSubstr("in use by"));
    EXPECT_EQ(error.text.find('\n'), std::string::npos);
#ifdef __linux__
    EXPECT_THAT(error.text, HasSubstr("app_net_test"));
    EXPECT_THAT(error.text, HasSubstr(std::to_string(::getpid())));
#endif
}

TEST_P(UdpReceiverErrorsTest, OnePortInUseAmongSeveralOpensNone) {
    const Receiving first(on({"127.0.0.1", 0}));
    ASSERT_TRUE(first.isRunning());
    ReceiveOptions options = on({"127.0.0.1", 0});
    options.endpoints.push_back(first.target().endpoint);
    const Receiving second(options);
    ASSERT_FALSE(second.isRunning());
    EXPECT_EQ(second.receiver.error().kind, NetError::Kind::PortInUse);
}

TEST_P(UdpReceiverErrorsTest, AddressOfAnotherComputerIsClear) {
    const Receiving receiving(on({"192.0.2.1", 0}));
    ASSERT_FALSE(receiving.isRunning());
    EXPECT_EQ(receiving.receiver.error().kind, NetError::Kind::AddressNotHere);
    EXPECT_THAT(receiving.receiver.error().text, HasSubstr("192.0.2.1 is not an address of this computer"));
}

TEST_P(UdpReceiverErrorsTest, NameInsteadOfAnAddressIsClear) {
    const Receiving receiving(on({"not-an-address", 0}));
    ASSERT_FALSE(receiving.isRunning());
    EXPECT_EQ(receiving.receiver.error().kind, NetError::Kind::BadEndpoint);
    EXPECT_THAT(receiving.receiver.error().text, HasSubstr("not-an-address"));
}

INSTANTIATE_TEST_SUITE_P(Paths, UdpReceiverErrorsTest,
                         ::testing::Values(ReceivePath::Native, ReceivePath::Portable), &pathName);

TEST(PortHolder, NothingForAPortThatNobodyHolds) {
    std::uint16_t port = 0;
    {
        ReceiveOptions options;
        options.endpoints = {Endpoint{"127.0.0.1", 0}};
        const Receiving receiving(options);
        ASSERT_TRUE(receiving.isRunning());
        port = receiving.target().endpoint.port;
#ifdef __linux__
        ASSERT_TRUE(holderOfUdpPort(port).has_value());
        EXPECT_EQ(holderOfUdpPort(port)->id, ::getpid());
#endif
    }
    EXPECT_FALSE(holderOfUdpPort(port).has_value());
}

} // namespace
} // namespace posewire::net
