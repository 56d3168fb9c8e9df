// SPDX-License-Identifier: MIT
#include "core/log/ip_packet.h"

#include "tests/core/log/capture_fixture.h"

#include <gmock/gmock.h>

namespace posewire::log {
namespace {

constexpr std::uint32_t kEthernet = 1;
constexpr std::uint32_t kRawIp = 101;
constexpr std::uint16_t kVlan = 0x8100;
constexpr std::uint16_t kServiceVlan = 0x88a8;
constexpr std::uint16_t kOldServiceVlan = 0x9100; // of switches older than the standard

ByteVector content() {
    return udp(poseDatagram(1, 1));
}

ByteVector payloadOf(std::uint32_t linkType, const ByteVector& frame) {
    const auto packet = ipPacketOf({linkType, frame});
    const auto payload = packet ? udpPayloadOf(*packet) : std::nullopt;
    return payload ? ByteVector(payload->bytes.begin(), payload->bytes.end()) : ByteVector{};
}

/// An Ethernet frame with VLAN tags before an EtherType (IEEE 802.1Q).
ByteVector tagged(const std::vector<std::uint16_t>& tags, std::uint16_t type, const ByteVector& packet) {
    CaptureBytes frame;
    frame.zeros(12);
    for (const std::uint16_t tag : tags) {
        frame.number(tag, 2).number(0x2005, 2);
    }
    return frame.number(type, 2).bytes(packet).all();
}

TEST(IpPacketInEthernet, IsFoundBehindAnyVlanTags) {
    for (const std::vector<std::uint16_t>& tags : {std::vector<std::uint16_t>{},
                                                   {kVlan},
                                                   {kServiceVlan, kVlan},
                                                   {kOldServiceVlan, kVlan},
                                                   {kVlan, kVlan, kVlan, kVlan}}) {
        const ByteVector four = tagged(tags, 0x0800, ipv4(content()));
        EXPECT_EQ(payloadOf(kEthernet, four), poseDatagram(1, 1)) << tags.size();
        EXPECT_EQ(ipPacketOf({kEthernet, four})->offset, 14 + 4 * tags.size() + 20);
        EXPECT_EQ(payloadOf(kEthernet, tagged(tags, 0x86dd, ipv6(content()))), poseDatagram(1, 1));
        EXPECT_FALSE(ipPacketOf({kEthernet, tagged(tags, 0x0806, ipv4(content()))}));
    }
}

TEST(IpPacketInEthernet, IsNothingWhereTheFrameEndsInItsTags) {
    const ByteVector frame = tagged({kVlan, kVlan}, 0x0800, {});
    for (std::size_t size = 0; size <= frame.size(); ++size) {
        EXPECT_FALSE(ipPacketOf({kEthernet, std::span(frame).first(size)})) << size;
    }
    EXPECT_FALSE(
        ipPacketOf({kEthernet, CaptureBytes().zeros(12).bytes(ByteVector(400, std::byte{0x81})).all()}));
}

/// IPv4 with `words` of options (RFC 791 section 3.1) and any total length.
ByteVector ipv4WithOptions(std::size_t words, std::size_t totalSize, const ByteVector& rest) {
    return CaptureBytes()
        .number(0x40 | (5 + words), 1)
        .number(0, 1)
        .number(totalSize, 2)
        .zeros(5)
        .number(17, 1)
        .zeros(2)
        .number(0x0a000002, 4)
        .number(0x0a000003, 4)
        .bytes(ByteVector(4 * words, std::byte{1}))
        .bytes(rest)
        .all();
}

TEST(IpPacketOfVersion4, IsFoundBehindOptionsOfAnyLength) {
    for (std::size_t words = 0; words <= 10; ++words) {
        const ByteVector packet = ipv4WithOptions(words, 20 + 4 * words + content().size(), content());
        EXPECT_EQ(payloadOf(kRawIp, packet), poseDatagram(1, 1)) << words;
        EXPECT_EQ(ipPacketOf({kRawIp, packet})->offset, 20 + 4 * words);
    }
}

TEST(IpPacketOfVersion4, EndsWithItsTotalLength) {
    const auto sizeWith = [](std::size_t totalSize) {
        const auto packet = ipPacketOf({kRawIp, ipv4WithOptions(0, totalSize, ByteVector(100))});
        return packet ? packet->bytes.size() : SIZE_MAX;
    };
    EXPECT_EQ(sizeWith(120), 100U);
    EXPECT_EQ(sizeWith(50), 30U) << "the rest is padding of the frame";
    EXPECT_EQ(sizeWith(20), 0U);
    EXPECT_EQ(sizeWith(1500), 100U) << "cut by the capture";
    EXPECT_EQ(sizeWith(0), 100U) << "the card fills the length in later";
}

TEST(IpPacketOfVersion4, IsNothingWithAHeaderShorterThanTwentyBytes) {
    for (unsigned words = 0; words < 5; ++words) {
        ByteVector packet = ipv4(content());
        packet[0] = static_cast<std::byte>(0x40 | words);
        EXPECT_FALSE(ipPacketOf({kRawIp, packet})) << words;
    }
    ByteVector packet = ipv4({});
    packet[0] = std::byte{0x46}; // announces options that are not there
    EXPECT_FALSE(ipPacketOf({kRawIp, packet}));
}

/// The fragment offset counts eight bytes; "do not fragment" is no fragment (RFC 791).
TEST(IpPacketOfVersion4, ReadsFlagsAndOffsetOfFragments) {
    const auto with = [](std::uint16_t word) { return *ipPacketOf({kRawIp, ipv4(content(), word)}); };
    EXPECT_FALSE(with(0x4000).isFragment());
    EXPECT_FALSE(with(0x8000).isFragment());
    EXPECT_TRUE(with(0x2000).isFragment());
    EXPECT_EQ(with(0x2000).fragmentOffset, 0U);
    EXPECT_TRUE(with(0x0001).isFragment());
    EXPECT_EQ(with(0x0001).fragmentOffset, 8U);
    EXPECT_FALSE(with(0x0001).hasMoreFragments);
    EXPECT_EQ(with(0x3fff).fragmentOffset, 65'528U);
    EXPECT_TRUE(with(0x3fff).hasMoreFragments);
    EXPECT_EQ(with(0x2000).identity, 1U);
}

/// An extension header of RFC 8200: its number, and its bytes but for the first, the number of the next.
struct Extension {
    std::uint8_t number;
    ByteVector rest;
};

Extension extension(std::uint8_t number, std::uint8_t eights = 0) {
    return {number, CaptureBytes().number(eights, 1).zeros(6U + 8U * eights).all()};
}
Extension fragmentHeader(std::uint16_t offsetAndMore, std::uint32_t identity) {
    return {44, CaptureBytes().number(0, 1).number(offsetAndMore, 2).number(identity, 4).all()};
}

/// `announced`: what the length says; nothing for what is right.
ByteVector ipv6With(const std::vector<Extension>& extensions, const ByteVector& rest, std::uint8_t last = 17,
                    std::optional<std::size_t> announced = std::nullopt) {
    CaptureBytes body;
    for (std::size_t i = 0; i < extensions.size(); ++i) {
        body.number(i + 1 < extensions.size() ? extensions[i + 1].number : last, 1).bytes(extensions[i].rest);
    }
    body.bytes(rest);
    return CaptureBytes()
        .number(0x60000000, 4)
        .number(announced.value_or(body.size()), 2)
        .number(extensions.empty() ? last : extensions[0].number, 1)
        .number(64, 1)
        .zeros(15)
        .number(2, 1)
        .zeros(15)
        .number(3, 1)
        .bytes(body.all())
        .all();
}

TEST(IpPacketOfVersion6, IsFoundBehindExtensionHeadersInAnyOrder) {
    for (const std::vector<Extension>& extensions :
         {std::vector<Extension>{},
          {extension(0)},
          {extension(43)},
          {extension(60)},
          {extension(0, 3)},
          {extension(60, 255)},
          {extension(0), extension(60), extension(43), extension(60)},
          {extension(60), extension(0, 1), extension(43, 2)}}) {
        const ByteVector packet = ipv6With(extensions, content());
        EXPECT_EQ(payloadOf(kRawIp, packet), poseDatagram(1, 1)) << extensions.size();
        EXPECT_EQ(ipPacketOf({kRawIp, packet})->offset, packet.size() - content().size());
        EXPECT_FALSE(ipPacketOf({kRawIp, packet})->isFragment());
    }
}

TEST(IpPacketOfVersion6, ReadsTheFragmentHeader) {
    const auto packet =
        ipPacketOf({kRawIp, ipv6With({extension(0), fragmentHeader(0x0559, 0xabcdef01)}, content())});
    ASSERT_TRUE(packet);
    EXPECT_EQ(packet->fragmentOffset, 0x0558U);
    EXPECT_TRUE(packet->hasMoreFragments);
    EXPECT_EQ(packet->identity, 0xabcdef01U);
    EXPECT_EQ(packet->protocol, kUdp);
}

/// A packet in one fragment (RFC 6946) is whole.
TEST(IpPacketOfVersion6, LooksBehindAFragmentHeaderOfAWholePacket) {
    const ByteVector packet = ipv6With({fragmentHeader(0, 7), extension(60)}, content());
    EXPECT_EQ(payloadOf(kRawIp, packet), poseDatagram(1, 1));
    EXPECT_FALSE(ipPacketOf({kRawIp, packet})->isFragment());
}

TEST(IpPacketOfVersion6, StopsAtProtocolsThatAreNoExtensions) {
    for (const std::uint8_t protocol : std::initializer_list<std::uint8_t>{6, 50, 58, 59, 132, 255}) {
        const auto packet = ipPacketOf({kRawIp, ipv6With({extension(60)}, content(), protocol)});
        ASSERT_TRUE(packet);
        EXPECT_EQ(packet->protocol, protocol);
        EXPECT_FALSE(udpPayloadOf(*packet));
    }
}

TEST(IpPacketOfVersion6, EndsWithItsPayloadLength) {
    const auto sizeWith = [](std::size_t announced) {
        return ipPacketOf({kRawIp, ipv6With({}, ByteVector(100), 17, announced)})->bytes.size();
    };
    EXPECT_EQ(sizeWith(100), 100U);
    EXPECT_EQ(sizeWith(40), 40U);
    EXPECT_EQ(sizeWith(1400), 100U) << "cut by the capture";
    EXPECT_EQ(sizeWith(0), 100U) << "a jumbogram, or filled in later";
}

TEST(IpPacketOfVersion6, IsNothingWhereAnExtensionRunsPastTheEnd) {
    EXPECT_FALSE(
        ipPacketOf({kRawIp, ipv6With({{60, CaptureBytes().number(200, 1).zeros(6).all()}}, content())}));
    const ByteVector packet = ipv6With({extension(0), extension(60, 2)}, content());
    for (std::size_t size = 0; size < packet.size(); ++size) {
        const auto cut = ipPacketOf({kRawIp, std::span(packet).first(size)});
        EXPECT_TRUE(!cut || cut->offset + cut->bytes.size() == size) << size;
    }
}

TEST(IpPacket, GoesByItsVersionWhateverTheLinkTypeSays) {
    EXPECT_TRUE(ipPacketOf({229, ipv4(content())}));
    EXPECT_TRUE(ipPacketOf({228, ipv6(content())}));
    for (const unsigned version : {0U, 1U, 5U, 7U, 15U}) {
        ByteVector packet = ipv4(content());
        packet[0] = static_cast<std::byte>(version << 4 | 5);
        EXPECT_FALSE(ipPacketOf({kRawIp, packet})) << version;
    }
}

TEST(IpPacket, IsNothingInCookedFramesOfOtherProtocols) {
    for (const std::uint16_t protocol : std::initializer_list<std::uint16_t>{0x0806, 0x0004, 0x88cc, 0}) {
        EXPECT_FALSE(ipPacketOf({276, CaptureBytes().number(protocol, 2).zeros(18).bytes(ipv4({})).all()}));
        EXPECT_FALSE(ipPacketOf({113, CaptureBytes().zeros(14).number(protocol, 2).bytes(ipv4({})).all()}));
    }
    const ByteVector six = CaptureBytes().number(0x86dd, 2).zeros(18).bytes(ipv6(content())).all();
    EXPECT_EQ(payloadOf(276, six), poseDatagram(1, 1));
    for (std::size_t size = 0; size < 20; ++size) {
        EXPECT_FALSE(ipPacketOf({276, std::span(six).first(size)})) << size;
    }
}

TEST(IpPacket, IsFoundBehindVlanTagsInCookedFrames) {
    const ByteVector tags = CaptureBytes().number(5, 2).number(kVlan, 2).number(7, 2).number(0x0800, 2).all();
    const ByteVector packet = joined({tags, ipv4(content())});
    EXPECT_EQ(payloadOf(113, CaptureBytes().zeros(14).number(kServiceVlan, 2).bytes(packet).all()),
              poseDatagram(1, 1));
    const ByteVector second = CaptureBytes().number(kServiceVlan, 2).zeros(18).bytes(packet).all();
    EXPECT_EQ(payloadOf(276, second), poseDatagram(1, 1));
    for (std::size_t size = 0; size < 20 + tags.size(); ++size) {
        EXPECT_FALSE(ipPacketOf({276, std::span(second).first(size)})) << size;
    }
}

TEST(UdpPayload, EndsWithTheLengthOfUdp) {
    IpPacket packet;
    packet.protocol = kUdp;
    const auto sizeWith = [&](std::uint16_t announced) {
        const ByteVector segment =
            CaptureBytes().number(1, 2).number(2, 2).number(announced, 2).zeros(2).zeros(50).all();
        packet.bytes = segment;
        return udpPayloadOf(packet)->bytes.size();
    };
    EXPECT_EQ(sizeWith(58), 50U);
    EXPECT_EQ(sizeWith(8), 0U);
    EXPECT_EQ(sizeWith(20), 12U);
    EXPECT_EQ(sizeWith(600), 50U) << "cut by the capture";
    EXPECT_EQ(sizeWith(0), 50U) << "a jumbogram (RFC 2675)";
    EXPECT_EQ(sizeWith(7), 50U) << "no length, as it is shorter than the header";
    for (std::size_t size = 0; size < 8; ++size) {
        const ByteVector tooShort(size);
        packet.bytes = tooShort;
        EXPECT_FALSE(udpPayloadOf(packet)) << size;
    }
}

/// RFC 5952 section 4: the longest run of zeros, the first of equal ones, never a single group.
TEST(EndpointText, ShortensIpv6AsRecommended) {
    const auto textOf = [](const std::array<std::uint16_t, 8>& groups) {
        IpAddress address{{}, true};
        for (std::size_t i = 0; i < 8; ++i) {
            address.bytes[2 * i] = static_cast<std::byte>(groups[i] >> 8);
            address.bytes[2 * i + 1] = static_cast<std::byte>(groups[i] & 0xff);
        }
        return endpointText({address, 1});
    };
    EXPECT_EQ(textOf({0x2001, 0xdb8, 0, 0, 0, 0, 2, 1}), "[2001:db8::2:1]:1");
    EXPECT_EQ(textOf({0x2001, 0xdb8, 0, 1, 1, 1, 1, 1}), "[2001:db8:0:1:1:1:1:1]:1");
    EXPECT_EQ(textOf({0x2001, 0, 0, 1, 0, 0, 0, 1}), "[2001:0:0:1::1]:1");
    EXPECT_EQ(textOf({0x2001, 0xdb8, 0, 0, 1, 0, 0, 1}), "[2001:db8::1:0:0:1]:1");
    EXPECT_EQ(textOf({0, 0, 0, 0, 0, 0, 0, 0}), "[::]:1");
    EXPECT_EQ(textOf({0, 0, 1, 0, 0, 0, 0, 0}), "[0:0:1::]:1");
    EXPECT_EQ(textOf({0xABCD, 0xef, 0x10, 0x100, 0x1000, 1, 2, 3}), "[abcd:ef:10:100:1000:1:2:3]:1");
}

} // namespace
} // namespace posewire::log
