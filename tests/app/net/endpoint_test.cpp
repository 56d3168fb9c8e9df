// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/endpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace posewire::net {
namespace {

TEST(Endpoint, ReadsPortAddressAndBoth) {
    EXPECT_EQ(parseEndpoint("9763"), (Endpoint{"", 9763}));
    EXPECT_EQ(parseEndpoint(":9763"), (Endpoint{"", 9763}));
    EXPECT_EQ(parseEndpoint("127.0.0.1:0"), (Endpoint{"127.0.0.1", 0}));
    EXPECT_EQ(parseEndpoint("studio-pc:65535"), (Endpoint{"studio-pc", 65535}));
    EXPECT_EQ(parseEndpoint("[::1]:9764"), (Endpoint{"::1", 9764}));
}

TEST(Endpoint, RejectsWhatIsNone) {
    for (const char* text : {"", ":", "host", "host:", "host:65536", "host:-1", "host:12x", "::1", "::1:9763",
                             "[::1]", "[::1:9763", "host: 1", "a]:1"}) {
        const auto endpoint = parseEndpoint(text);
        ASSERT_FALSE(endpoint.has_value()) << text;
        EXPECT_EQ(endpoint.error().kind, NetError::Kind::BadEndpoint);
        EXPECT_THAT(endpoint.error().text, ::testing::HasSubstr(text));
    }
}

TEST(Endpoint, TextReadsBack) {
    for (const char* text : {":9763", "127.0.0.1:1", "[fe80::1%eth0]:9763", "studio-pc:9763"}) {
        const auto endpoint = parseEndpoint(text);
        ASSERT_TRUE(endpoint.has_value()) << text;
        EXPECT_EQ(textOf(*endpoint), text);
    }
}

} // namespace
} // namespace posewire::net
