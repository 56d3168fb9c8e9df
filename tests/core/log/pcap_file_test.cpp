// SPDX-License-Identifier: MIT
#include "tests/core/log/capture_fixture.h"
#include "tests/core/log/recording_fixture.h"

#include <gmock/gmock.h>

#include <random>

namespace posewire::log {
namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kMicrosecondFile = 0xa1b2c3d4;
constexpr std::uint32_t kNanosecondFile = 0xa1b23c4d;
constexpr std::uint32_t kRawIpFile = 101;

/// What was read, and whether the file was sound.
struct Reading {
    std::vector<Recorded> packets;
    tl::expected<void, FileError> result;
};

Reading readingOf(std::span<const std::byte> file, bool fails = false) {
    Reading reading;
    BytesSource source(file, fails);
    reading.result = readFile(source, [&](const FileRecord& record) {
        reading.packets.push_back({{record.bytes.begin(), record.bytes.end()},
                                   record.sender.value_or(SenderInfo{}),
                                   record.time ? asStamp(*record.time) : Stamp::min()});
    });
    return reading;
}

ByteVector posePacket(std::uint32_t sample, std::size_t segments = 2) {
    return ipv4(udp(poseDatagram(sample, segments)));
}

/// A record by itself; `original` bytes were on the wire.
ByteVector record(const ByteVector& frame, std::size_t original, bool bigEndian = false) {
    return CaptureBytes(bigEndian)
        .number(1, 4)
        .number(2, 4)
        .number(frame.size(), 4)
        .number(original, 4)
        .bytes(frame)
        .all();
}

TEST(PcapFile, KeepsEveryStampThatTheFormatCanHold) {
    for (const bool bigEndian : {false, true}) {
        for (const auto& [magic, unit] :
             {std::pair{kMicrosecondFile, Duration(1us)}, {kNanosecondFile, 1ns}}) {
            std::vector<Captured> packets;
            std::vector<Stamp> stamps;
            const std::uint32_t most = magic == kMicrosecondFile ? 999'999 : 999'999'999;
            for (const std::uint32_t seconds : {0U, 1U, 0x7fffffffU, 0x80000000U, 0xffffffffU}) {
                for (const std::uint32_t fraction : {0U, 1U, most}) {
                    packets.push_back({seconds, fraction, posePacket(1)});
                    stamps.emplace_back(std::chrono::seconds(seconds) + fraction * unit);
                }
            }
            const Reading reading = readingOf(pcap(packets, magic, kRawIpFile, bigEndian));
            ASSERT_TRUE(reading.result);
            ASSERT_EQ(reading.packets.size(), stamps.size());
            for (std::size_t i = 0; i < stamps.size(); ++i) {
                EXPECT_EQ(reading.packets[i].stamp, stamps[i]);
            }
        }
    }
}

/// The upper bits of the link type say how long a frame check sequence is.
TEST(PcapFile, LooksAtTheLowerBitsOfTheLinkTypeOnly) {
    for (const std::uint32_t upper : {0x00000000U, 0x10000000U, 0x40000000U, 0xf0000000U}) {
        const Reading reading =
            readingOf(pcap({{1, 2, ethernet(posePacket(7))}}, kMicrosecondFile, upper | 1, false));
        ASSERT_EQ(reading.packets.size(), 1U) << upper;
        EXPECT_EQ(reading.packets[0].bytes, poseDatagram(7, 2));
    }
    EXPECT_TRUE(
        readingOf(pcap({{1, 2, posePacket(7)}}, kMicrosecondFile, 0x07654321, false)).packets.empty());
}

/// A capture with a short snap length has the beginning of a packet: its datagram is cut off.
TEST(PcapFile, GivesWhatWasCapturedOfACutPacket) {
    const ByteVector packet = posePacket(7);
    for (const bool bigEndian : {false, true}) {
        const ByteVector header = pcap({}, kNanosecondFile, kRawIpFile, bigEndian);
        for (const std::size_t size : {29U, 60U, 100U}) {
            const ByteVector cut(packet.begin(), packet.begin() + static_cast<std::ptrdiff_t>(size));
            const Reading reading = readingOf(joined(
                {header, record(cut, packet.size(), bigEndian), record(packet, packet.size(), bigEndian)}));
            ASSERT_TRUE(reading.result);
            ASSERT_EQ(reading.packets.size(), 2U) << size;
            EXPECT_EQ(reading.packets[0].bytes.size(), size - 28);
            EXPECT_EQ(reading.packets[1].bytes, poseDatagram(7, 2));
        }
    }
}

TEST(PcapFile, ReadsEmptyFilesAndEmptyPackets) {
    EXPECT_TRUE(readingOf(pcap({}, kMicrosecondFile, 1, true)).result);
    const Reading reading =
        readingOf(pcap({{0, 0, {}}, {0, 0, posePacket(1)}, {0, 0, {}}}, kMicrosecondFile, kRawIpFile, true));
    EXPECT_TRUE(reading.result);
    EXPECT_EQ(reading.packets.size(), 1U);
}

TEST(PcapFile, RefusesAPacketThatIsLongerThanAnyCanBe) {
    for (const std::uint32_t size : {0x01000001U, 0x7fffffffU, 0xffffffffU}) {
        ByteVector file = pcap({{1, 1, posePacket(1)}}, kMicrosecondFile, kRawIpFile, true);
        const std::size_t first = file.size();
        file = CaptureBytes().bytes(file).zeros(8).number(size, 4).number(size, 4).zeros(100).all();
        const Reading reading = readingOf(file);
        ASSERT_FALSE(reading.result) << size;
        EXPECT_THAT(reading.result.error().text,
                    testing::HasSubstr("is damaged at byte " + std::to_string(first)));
        EXPECT_EQ(reading.packets.size(), 1U) << "what comes before it was read";
    }
}

TEST(PcapFile, KeepsWhatCameBeforeAFailureOfTheDevice) {
    const ByteVector file =
        pcap({{1, 1, posePacket(1)}, {2, 2, posePacket(2)}}, kMicrosecondFile, kRawIpFile, false);
    const std::size_t packet = (file.size() - 24) / 2;
    for (std::size_t size = 0; size <= file.size(); ++size) {
        const Reading reading = readingOf(std::span(file).first(size), true);
        ASSERT_FALSE(reading.result) << size;
        EXPECT_EQ(reading.result.error().text, "memory: the device is gone");
        EXPECT_EQ(reading.packets.size(), size < 24 ? 0U : (size - 24) / packet) << size;
    }
}

/// Any packets: what goes in comes out, in order, with stamps.
TEST(PcapFile, GivesBackGeneratedPackets) {
    std::mt19937 random(8);
    for (int round = 0; round < 40; ++round) {
        const bool bigEndian = random() % 2 == 0;
        std::vector<Captured> packets;
        for (std::uint32_t i = 0; i < random() % 30; ++i) {
            packets.push_back({static_cast<std::uint32_t>(random()),
                               static_cast<std::uint32_t>(random() % 1'000'000'000),
                               posePacket(i, random() % 67)});
        }
        const Reading reading = readingOf(pcap(packets, kNanosecondFile, kRawIpFile, bigEndian));
        ASSERT_TRUE(reading.result);
        ASSERT_EQ(reading.packets.size(), packets.size());
        for (std::size_t i = 0; i < packets.size(); ++i) {
            const ByteVector& packet = packets[i].frame;
            EXPECT_EQ(reading.packets[i].bytes, ByteVector(packet.begin() + 28, packet.end()));
            EXPECT_EQ(reading.packets[i].stamp,
                      Stamp(std::chrono::seconds(packets[i].seconds) + Duration(packets[i].fraction)));
        }
    }
}

} // namespace
} // namespace posewire::log
