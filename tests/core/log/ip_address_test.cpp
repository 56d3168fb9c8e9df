// SPDX-License-Identifier: MIT
#include "core/log/ip_packet.h"

#include <gmock/gmock.h>

namespace posewire::log {
namespace {

TEST(IpEndpoint, ComesBackFromItsText) {
    for (const std::string text :
         {"0.0.0.0:0", "127.0.0.1:40001", "255.255.255.255:65535", "[::]:1", "[::1]:9763", "[fe80::1]:40001",
          "[2001:db8:0:1:1:1:1:1]:5", "[1:2:3:4:5:6:7:8]:9", "[2001:db8::]:7", "[1::8]:3"}) {
        const auto endpoint = parseIpEndpoint(text);
        ASSERT_TRUE(endpoint.has_value()) << text;
        EXPECT_EQ(endpointText(*endpoint), text);
    }
}

TEST(IpEndpoint, PassesOverTheZone) {
    const auto endpoint = parseIpEndpoint("[fe80::1%eth0]:40001");
    ASSERT_TRUE(endpoint.has_value());
    EXPECT_EQ(endpointText(*endpoint), "[fe80::1]:40001");
}

TEST(IpEndpoint, IsNothingWhereTheTextIsNone) {
    for (const std::string text : {"",
                                   ":",
                                   ":1",
                                   "1.2.3.4",
                                   "1.2.3.4:",
                                   "1.2.3:4",
                                   "1.2.3.4.5:6",
                                   "256.1.1.1:1",
                                   "1.2.3.4:65536",
                                   "1.2.3.4:-1",
                                   "1.2.3.4: 1",
                                   "[]:1",
                                   "[1]:1",
                                   "::1:1",
                                   "[1:2:3:4:5:6:7:8:9]:1",
                                   "[1::2::3]:1",
                                   "[1:2:3:4::5:6:7:8]:1",
                                   "[12345::]:1",
                                   "[g::]:1",
                                   "localhost:1",
                                   "walk.pcapng",
                                   "Performer 1"}) {
        EXPECT_FALSE(parseIpEndpoint(text).has_value()) << text;
    }
}

TEST(IpEndpoint, KnowsLoopback) {
    EXPECT_TRUE(isLoopback(parseIpEndpoint("127.1.2.3:1")->address));
    EXPECT_TRUE(isLoopback(parseIpEndpoint("[::1]:1")->address));
    EXPECT_FALSE(isLoopback(parseIpEndpoint("10.0.0.1:1")->address));
    EXPECT_FALSE(isLoopback(parseIpEndpoint("[fe80::1]:1")->address));
    EXPECT_FALSE(isLoopback(parseIpEndpoint("[::]:1")->address));
}

} // namespace
} // namespace posewire::log
