// SPDX-License-Identifier: MIT
#include "core/log/pcapng_writer.h"

#include "core/log/ip_packet.h"
#include "core/wire/byte_order.h"
#include "tests/core/log/recording_fixture.h"

#include <gmock/gmock.h>

#include <random>

namespace posewire::log {
namespace {

using namespace std::chrono_literals;

ByteVector written(const std::vector<Recorded>& packets, bool isFinished = true) {
    MemorySink sink;
    PcapngWriter writer(sink);
    EXPECT_TRUE(writer.begin({"this machine", "some system", "Posewire test"}));
    for (const Recorded& one : packets) {
        const Packet packet{0, one.stamp, {}, one.kernelDropsBefore, one.flags, one.bytes};
        EXPECT_TRUE(writer.add(packet, one.sender, one.comments));
    }
    if (isFinished) {
        EXPECT_TRUE(writer.addStatistics());
    }
    EXPECT_EQ(writer.bytes(), sink.bytes.size());
    EXPECT_EQ(writer.packets(), packets.size());
    return sink.bytes;
}

Recorded from(const std::string& address, Transport transport = Transport::Udp, std::uint16_t port = 9763) {
    Recorded one{poseDatagram(7)};
    one.sender = {address, transport, port};
    return one;
}

Recorded with(PacketFlags flags, std::uint32_t drops = 0) {
    Recorded one{poseDatagram(7)};
    one.flags = flags;
    one.kernelDropsBefore = drops;
    one.stamp = Stamp(5ns);
    return one;
}

Recorded commented(const std::vector<std::string>& comments) {
    Recorded one{poseDatagram(7)};
    one.comments = comments;
    return one;
}

ByteVector bytesOf(std::size_t size) {
    ByteVector bytes(size);
    for (std::size_t i = 0; i < size; ++i) {
        bytes[i] = static_cast<std::byte>(i * 7 + (i >> 8));
    }
    return bytes;
}

std::vector<Recorded> everyKind() {
    std::vector<Recorded> all{
        from("10.0.0.2:40001"),
        from("[fe80::1]:40001"),
        from("127.0.0.1:40001", Transport::Udp, 9764),
        from("[::1]:40001"),
        from("10.0.0.2:40001", Transport::Tcp),
        from("[fe80::1%eth0]:40001"),
        from("walk \"2\"; from here.bin", Transport::File, 0),
        from("", Transport::File, 0),
        from("", Transport::Udp, 5),
        from("Performer\n1", Transport::Performer, 0),
        from("unknown sender"),
        from("0.0.0.0:0", Transport::Performer, 0),
        with({.stampedByKernel = true}, 3),
        with({.stampedByKernel = true}, 0xffffffff),
        with({.truncated = true, .stampedByKernel = true}),
        with({.stampedByKernel = true, .afterClosed = true}),
        with({.stampedByKernel = true, .isFromBefore = true}),
        with({.stampedByKernel = true, .shared = 2}),
        with({.truncated = true, .shared = 7}),
        with({}),
        with({.truncated = true, .skipped = true}),
        commented({"look at this — é"}),
        commented({"one", "two"}),
        commented({"Posewire: TCP", "x"}),
        commented({"Posewire: is nice"}),
    };
    for (const std::size_t size : {0U, 3U, 1471U}) {
        all.push_back(with({.stampedByKernel = true}));
        all.back().bytes = bytesOf(size);
    }
    all.push_back(with({.skipped = true, .isDropRecord = true}, 8));
    all.back().bytes.clear();
    return all;
}

TEST(PcapngWriter, GivesBackEveryKindOfPacket) {
    const auto packets = everyKind();
    const auto seen = recordedIn(written(packets));
    ASSERT_EQ(seen.size(), packets.size());
    for (std::size_t i = 0; i < packets.size(); ++i) {
        EXPECT_EQ(seen[i], packets[i]) << i;
    }
}

TEST(PcapngWriter, GivesBackPacketsOfAnyLength) {
    std::vector<Recorded> packets;
    for (const std::size_t size : {65'507U, 65'508U, 65'527U, 65'528U, 65'536U, 70'001U, 1'000'000U}) {
        for (const Recorded& kind :
             {from("10.0.0.2:1"), from("[::1]:1", Transport::Tcp, 2), from("a file", Transport::File, 0)}) {
            packets.push_back(kind);
            packets.back().bytes = bytesOf(size);
        }
    }
    const auto seen = recordedIn(written(packets));
    ASSERT_EQ(seen.size(), packets.size());
    for (std::size_t i = 0; i < packets.size(); ++i) {
        EXPECT_EQ(seen[i], packets[i]) << i;
    }
}

TEST(PcapngWriter, GivesBackStampsBefore1970) {
    std::vector<Recorded> packets;
    for (const std::int64_t nanoseconds : {5LL, -1LL, 0LL, -800'000'000LL, -2'000'000'000'000'000'001LL}) {
        packets.push_back({poseDatagram(7)});
        packets.back().stamp = stampOf(nanoseconds);
    }
    EXPECT_EQ(recordedIn(written(packets)), packets);
}

TEST(PcapngWriter, WritesTheSameFileFromWhatWasReadBack) {
    const ByteVector first = written(everyKind());
    EXPECT_EQ(written(recordedIn(first)), first);
}

TEST(PcapngWriter, GivesBackRandomPackets) {
    std::mt19937 random(4);
    std::vector<Recorded> packets;
    for (int i = 0; i < 500; ++i) {
        Recorded one{bytesOf(random() % 3000)};
        one.sender.localPort = static_cast<std::uint16_t>(random());
        one.sender.transport = static_cast<Transport>(random() % 4);
        one.stamp = Stamp(Duration((std::uint64_t{random()} << 32 | random()) >> 2));
        one.kernelDropsBefore = random() % 3 == 0 ? static_cast<std::uint32_t>(random()) : 0;
        one.flags = {random() % 2 == 0, random() % 2 == 0, random() % 2 == 0, random() % 2 == 0};
        packets.push_back(one);
    }
    const auto seen = recordedIn(written(packets));
    ASSERT_EQ(seen.size(), packets.size());
    for (std::size_t i = 0; i < packets.size(); ++i) {
        ASSERT_EQ(seen[i], packets[i]) << i;
    }
}

TEST(PcapngWriter, OpensUpToTheLastWholeBlockWhereverTheFileIsCut) {
    const std::vector<Recorded> packets{{poseDatagram(1, 1)},
                                        {poseDatagram(2, 1), {"f", Transport::File, 0}}};
    const std::size_t none = written({}, false).size();
    const std::size_t one = written({packets[0]}, false).size();
    const std::size_t both = written(packets, false).size();
    const ByteVector file = written(packets);
    for (std::size_t size = 4; size < file.size(); ++size) {
        const auto seen = recordedIn(std::span(file).first(size));
        ASSERT_EQ(seen.size(), size < one ? 0U : size < both ? 1U : 2U) << size << " of " << none;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            ASSERT_EQ(seen[i], packets[i]);
        }
    }
}

TEST(PcapngWriter, StopsWhereTheDiskIsFull) {
    MemorySink sink(500);
    PcapngWriter writer(sink);
    ASSERT_TRUE(writer.begin({}));
    const ByteVector pose = poseDatagram(1);
    const auto result = writer.add({0, Stamp(1ns), {}, 0, {}, pose}, {"10.0.0.1:1", Transport::Udp, 1});
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().text, testing::HasSubstr("full"));
}

/// RFC 1071: the sum over data with its checksum is all ones.
std::uint16_t sumOf(std::span<const std::byte> bytes, std::uint64_t sum) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        sum += std::to_integer<std::uint64_t>(bytes[i]) << (i % 2 == 0 ? 8 : 0);
    }
    while (sum >> 16 != 0) {
        sum = (sum >> 16) + (sum & 0xffff);
    }
    return static_cast<std::uint16_t>(sum);
}

TEST(UdpFrame, HasRightChecksumsForAnyContent) {
    std::mt19937 random(1);
    for (int i = 0; i < 300; ++i) {
        ByteVector payload(random() % 40);
        std::ranges::generate(payload, [&] { return static_cast<std::byte>(random()); });
        ByteVector ipv4;
        appendUdpFrame(ipv4, *parseIpEndpoint("10.1.2.3:40001"), *parseIpEndpoint("0.0.0.0:9763"), payload);
        EXPECT_EQ(sumOf(std::span(ipv4).first(20), 0), 0xffff);
        EXPECT_EQ(sumOf(std::span(ipv4).subspan(12), 17 + payload.size() + 8), 0xffff);
        ByteVector ipv6;
        appendUdpFrame(ipv6, *parseIpEndpoint("[fe80::1]:40001"), *parseIpEndpoint("[::]:9763"), payload);
        EXPECT_EQ(sumOf(std::span(ipv6).subspan(8), 17 + payload.size() + 8), 0xffff);
    }
}

TEST(UdpFrame, NeverHasTheChecksumThatMeansNone) {
    ByteVector payload(2);
    for (unsigned value = 0; value <= 0xffff; ++value) {
        wire::store16(payload.data(), static_cast<std::uint16_t>(value));
        ByteVector frame;
        appendUdpFrame(frame, *parseIpEndpoint("10.1.2.3:1"), *parseIpEndpoint("0.0.0.0:1"), payload);
        ASSERT_NE(wire::load16(frame.data() + 26), 0);
    }
}

TEST(RecordedOrigin, ReadsOnlyItsOwnWords) {
    EXPECT_EQ(originText({Transport::Tcp, {.stampedByKernel = false}, "[fe80::1%eth0]:40001"}),
              "Posewire: TCP; stamped on reading; from [fe80::1%eth0]:40001");
    for (const char* text :
         {"", "Posewire", "Posewire: ", "Posewire: SCTP", "Posewire: TCP!",
          "Posewire: TCP; stamped on reading; truncated", "posewire: TCP", "Posewire: TCP; clock set by ",
          "Posewire: TCP; clock set by 1 s", "Posewire: TCP; clock set by 1.5 s",
          "Posewire: TCP; clock set by --1.500000000 s",
          "Posewire: TCP; clock set by 99999999999.000000000 s",
          "Posewire: TCP; clock set by 1.50000000x s"}) {
        EXPECT_EQ(parseOrigin(text), std::nullopt) << text;
    }
}

TEST(RecordedMark, IsReadBackFromItsWords) {
    const RecordedMark whole{12, "03:28:07.123", "left hand jumps: at 3"};
    EXPECT_EQ(markText(whole), "Mark on packet 12 at 03:28:07.123: left hand jumps: at 3");
    for (const RecordedMark& mark :
         {whole, RecordedMark{0, "", ""}, RecordedMark{7, "03:28:07.123", ""}, RecordedMark{7, "", "here"}}) {
        EXPECT_EQ(parseMark(markText(mark)), mark) << markText(mark);
    }
    for (const char* other :
         {"", "Mark on packet", "Mark on packet x", "Mark on packet 12 of it",
          "In an earlier file: Mark on packet 3", "Mark on packet 99999999999999999999"}) {
        EXPECT_EQ(parseMark(other), std::nullopt) << other;
    }
}

TEST(Reception, IsReadBackFromItsWords) {
    const Reception reception{12'031ms, 1'700ms, 4'194'304};
    const std::string text = receptionText(reception);
    EXPECT_EQ(text, "Posewire: received for 12.031000000 s, the last 1.700000000 s without a packet; "
                    "receive buffer 4194304 bytes");
    EXPECT_EQ(parseReception(text), reception);
    for (std::size_t size = 0; size < text.size(); ++size) {
        EXPECT_EQ(parseReception(text.substr(0, size)), std::nullopt) << size;
    }
    EXPECT_EQ(parseReception(text + '!'), std::nullopt);
    EXPECT_EQ(parseReception("Posewire: TCP"), std::nullopt);
    for (const Reception& strange : {Reception{-1ns, 0ns, 0}, Reception{1s, -1ns, 0},
                                     Reception{8'761h, 1s, 0}, Reception{1s, 2'500'000h, 0}}) {
        EXPECT_EQ(parseReception(receptionText(strange)), std::nullopt) << receptionText(strange);
    }
    EXPECT_NE(parseReception(receptionText({8'760h, 8'760h, 0})), std::nullopt);
}

} // namespace
} // namespace posewire::log
