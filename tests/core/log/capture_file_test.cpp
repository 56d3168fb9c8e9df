// SPDX-License-Identifier: MIT
#include "core/log/ip_packet.h"
#include "core/log/recording_file.h"

#include "tests/core/log/capture_fixture.h"

#include <gmock/gmock.h>

#include <random>
#include <sstream>

namespace posewire::log {
namespace {

using namespace std::chrono_literals;

struct Seen {
    std::uint64_t offset;
    ByteVector bytes;
    std::optional<WallTime> stamp;
    std::string address;
};

/// In memory; reads at most `step` bytes at a time.
class MemorySource final : public ByteSource {
public:
    explicit MemorySource(std::span<const std::byte> bytes, std::size_t step = 1000)
        : m_bytes(bytes), m_step(step) {}
    tl::expected<std::size_t, FileError> read(std::span<std::byte> into) override {
        const std::size_t count = std::min({into.size(), m_bytes.size(), m_step});
        std::copy_n(m_bytes.begin(), count, into.begin());
        m_bytes = m_bytes.subspan(count);
        return count;
    }
    [[nodiscard]] std::string name() const override { return "test.pcap"; }

private:
    std::span<const std::byte> m_bytes;
    std::size_t m_step;
};

std::vector<Seen> seenIn(std::span<const std::byte> file, bool isSound = true) {
    std::vector<Seen> all;
    MemorySource source(file, 7);
    const auto result = readFile(source, [&](const FileRecord& record) {
        EXPECT_FALSE(record.flags.skipped);
        all.push_back({record.offset,
                       {record.bytes.begin(), record.bytes.end()},
                       record.time,
                       record.sender ? record.sender->address : ""});
    });
    EXPECT_EQ(result.has_value() || result.error().kind == FileError::Kind::Cut, isSound);
    return all;
}

constexpr std::uint32_t kMicroseconds = 0xa1b2c3d4;
constexpr std::uint32_t kNanoseconds = 0xa1b23c4d;

TEST(CaptureFile, ReadsPcapInBothByteOrdersAndResolutions) {
    const ByteVector pose = poseDatagram(7);
    for (const bool bigEndian : {false, true}) {
        for (const std::uint32_t magic : {kMicroseconds, kNanoseconds}) {
            const ByteVector frame = ethernet(ipv4(udp(pose)));
            const ByteVector file =
                pcap({{1700000000, 123456, frame}, {1700000001, 5, frame}}, magic, 1, bigEndian);
            const auto seen = seenIn(file);
            ASSERT_EQ(seen.size(), 2U);
            const Duration unit = magic == kMicroseconds ? 1us : 1ns;
            EXPECT_EQ(seen[0].stamp, WallTime(1'700'000'000s + 123'456 * unit));
            EXPECT_EQ(seen[1].stamp, WallTime(1'700'000'001s + 5 * unit));
            EXPECT_EQ(seen[0].offset, 24U + 16 + 14 + 20 + 8);
            EXPECT_EQ(seen[1].offset, 24U + 16 + frame.size() + 16 + 14 + 20 + 8);
            EXPECT_EQ(seen[0].bytes, pose);
            EXPECT_EQ(seen[1].bytes, pose);
            EXPECT_EQ(seen[0].address, "10.0.0.2:40001");
        }
    }
}

TEST(CaptureFile, ReadsPcapngInBothByteOrdersWithItsInterfaces) {
    const ByteVector pose = poseDatagram(7);
    for (const bool bigEndian : {false, true}) {
        const ByteVector start =
            joined({sectionHeader(bigEndian), interfaceBlock(1, 9, bigEndian),
                    interfaceBlock(101, 6, bigEndian), block(0xbad, textBytes("not known"), bigEndian)});
        const ByteVector file =
            joined({start, enhancedPacket(0, 1700000000'123456789, ethernet(ipv4(udp(pose))), bigEndian),
                    enhancedPacket(1, 1700000000'123456, ipv4(udp(pose)), bigEndian),
                    sectionHeader(!bigEndian), interfaceBlock(101, 3, !bigEndian),
                    enhancedPacket(0, 1700000000'123, ipv4(udp(pose)), !bigEndian)});
        const auto seen = seenIn(file);
        ASSERT_EQ(seen.size(), 3U);
        EXPECT_EQ(seen[0].stamp, WallTime(1'700'000'000s + 123'456'789ns));
        EXPECT_EQ(seen[1].stamp, WallTime(1'700'000'000s + 123'456us));
        EXPECT_EQ(seen[2].stamp, WallTime(1'700'000'000s + 123ms));
        for (const Seen& one : seen) {
            EXPECT_EQ(one.bytes, pose);
            EXPECT_TRUE(
                std::equal(pose.begin(), pose.end(), file.begin() + static_cast<std::ptrdiff_t>(one.offset)));
        }
    }
}

TEST(CaptureFile, ReadsSimplePacketsWithoutAStamp) {
    const ByteVector pose = poseDatagram(7);
    const ByteVector packet = ipv4(udp(pose));
    const ByteVector simple =
        block(3, CaptureBytes(false).number(packet.size(), 4).bytes(packet).all(), false);
    const auto seen = seenIn(joined({sectionHeader(false), interfaceBlock(101, 6, false), simple}));
    ASSERT_EQ(seen.size(), 1U);
    EXPECT_EQ(seen[0].bytes, pose);
    EXPECT_EQ(seen[0].stamp, std::nullopt);
}

TEST(CaptureFile, PassesOverWhatIsNotMxtp) {
    const ByteVector other = ethernet(ipv4(udp(textBytes("who is there?"), 5353, 5353)));
    const ByteVector tcp = ethernet(ipv4(udp(poseDatagram(1)), 0, 6));
    const ByteVector arp = ethernet(textBytes("anything"), 0x0806);
    const ByteVector tiny = textBytes("x");
    EXPECT_TRUE(seenIn(pcap({{0, 0, other}, {0, 0, tcp}, {0, 0, arp}, {0, 0, tiny}, {0, 0, {}}},
                            kMicroseconds, 1, false))
                    .empty());
}

TEST(CaptureFile, ReadsUpToTheLastWholePacketWhereverItIsCut) {
    const ByteVector frame = ethernet(ipv4(udp(poseDatagram(7, 2))));
    const ByteVector pcapFile = pcap({{1, 1, frame}, {2, 2, frame}}, kNanoseconds, 1, false);
    for (std::size_t size = 4; size < pcapFile.size(); ++size) {
        EXPECT_EQ(seenIn(std::span(pcapFile).first(size)).size(), size < 24 + 16 + frame.size() ? 0U : 1U)
            << size;
    }
    const ByteVector start = joined({sectionHeader(true), interfaceBlock(1, 9, true)});
    const ByteVector packet = enhancedPacket(0, 1, frame, true);
    const ByteVector pcapngFile = joined({start, packet, packet});
    for (std::size_t size = 4; size < pcapngFile.size(); ++size) {
        const std::size_t whole = size < start.size() ? 0 : (size - start.size()) / packet.size();
        EXPECT_EQ(seenIn(std::span(pcapngFile).first(size)).size(), whole) << size;
    }
}

/// Every byte but the ends of blocks, and nothing of a raw file.
TEST(CaptureFile, TellsTheByteWhereItIsCut) {
    const ByteVector frame = ethernet(ipv4(udp(poseDatagram(7, 2))));
    const ByteVector header = pcap({}, kNanoseconds, 1, false);
    const ByteVector whole = pcap({{1, 1, frame}, {2, 2, frame}}, kNanoseconds, 1, false);
    const std::size_t packet = (whole.size() - header.size()) / 2;
    for (std::size_t size = 4; size <= whole.size(); ++size) {
        const auto part = std::span(whole).first(size);
        MemorySource source(part);
        const auto result = readFile(source, [](const FileRecord&) {});
        const bool isWhole = size >= header.size() && (size - header.size()) % packet == 0;
        ASSERT_EQ(result.has_value(), isWhole) << size;
        if (!result) {
            EXPECT_EQ(result.error().kind, FileError::Kind::Cut);
            EXPECT_EQ(result.error().text, "test.pcap: is cut off: it ends at byte " + std::to_string(size) +
                                               ", amidst a packet; what comes before that packet was read");
        }
    }
    const auto datagramPart = std::span(whole).subspan(header.size() + 58, 40);
    MemorySource raw(datagramPart);
    EXPECT_TRUE(readFile(raw, [](const FileRecord&) {}));
}

TEST(CaptureFile, NamesThePlaceOfDamage) {
    ByteVector file =
        pcap({{1, 1, ethernet(ipv4(udp(poseDatagram(1))))}, {2, 2, {}}}, kMicroseconds, 1, true);
    file[file.size() - 8] = std::byte{0xff};
    EXPECT_EQ(seenIn(file, false).size(), 1U);
    ByteVector blocks = joined({sectionHeader(false), interfaceBlock(1, 6, false)});
    blocks[sectionHeader(false).size() + 4] = std::byte{3};
    MemorySource source(blocks);
    const auto result = readFile(source, [](const FileRecord&) {});
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().text, testing::HasSubstr("test.pcap: is damaged at byte 32"));
}

TEST(CaptureFile, SurvivesDamageAnywhere) {
    const ByteVector sound =
        joined({sectionHeader(false), interfaceBlock(1, 6, false),
                enhancedPacket(0, 1, ethernet(ipv6(udp(poseDatagram(7, 2))), 0x86dd), false)});
    std::mt19937 random(1);
    for (int round = 0; round < 20000; ++round) {
        ByteVector damaged = sound;
        for (std::size_t changes = 1 + random() % 3; changes > 0; --changes) {
            damaged[4 + random() % (damaged.size() - 4)] = static_cast<std::byte>(random());
        }
        MemorySource source(damaged);
        static_cast<void>(readFile(source, [&](const FileRecord& record) {
            EXPECT_LE(record.offset + record.bytes.size(), damaged.size());
        }));
    }
}

TEST(IpPacket, IsFoundBehindEveryLinkType) {
    const ByteVector content = udp(poseDatagram(1, 1));
    const ByteVector four = ipv4(content);
    const ByteVector six = ipv6(content);
    const auto after = [](std::size_t zeros, std::uint16_t word, const ByteVector& rest) {
        return CaptureBytes().zeros(zeros).number(word, 2).bytes(rest).all();
    };
    const std::vector<std::pair<std::uint32_t, ByteVector>> frames{
        {1, ethernet(four)},
        {1, ethernet(six, 0x86dd)},
        {1, ethernet(joined({CaptureBytes().number(5, 2).number(0x0800, 2).all(), four}), 0x8100)},
        {0, joined({CaptureBytes(false).number(2, 4).all(), four})},
        {108, joined({CaptureBytes().number(24, 4).all(), six})},
        {12, four},
        {101, six},
        {228, four},
        {229, six},
        {113, after(14, 0x0800, four)},
        {113, after(14, 0x86dd, six)},
        {276, joined({CaptureBytes().number(0x0800, 2).zeros(18).all(), four})}};
    for (const auto& [linkType, frame] : frames) {
        const auto packet = ipPacketOf({linkType, frame});
        ASSERT_TRUE(packet) << linkType;
        const auto payload = udpPayloadOf(*packet);
        ASSERT_TRUE(payload) << linkType;
        EXPECT_EQ(ByteVector(payload->bytes.begin(), payload->bytes.end()), poseDatagram(1, 1)) << linkType;
        EXPECT_EQ(payload->offset, frame.size() - poseDatagram(1, 1).size()) << linkType;
        EXPECT_EQ(payload->targetPort, 9763);
        EXPECT_THAT(endpointText({packet->sender, 1}), testing::AnyOf("10.0.0.2:1", "[fe80::1]:1"));
    }
    EXPECT_FALSE(ipPacketOf({999, four}));
}

TEST(UdpPayload, LeavesOutThePaddingOfShortFrames) {
    const ByteVector frame = CaptureBytes().bytes(ethernet(ipv4(udp(textBytes("MXTP"))))).zeros(14).all();
    const auto packet = ipPacketOf({1, frame});
    EXPECT_EQ(udpPayloadOf(*packet)->bytes.size(), 4U);
}

TEST(IpPacket, TellsFragments) {
    const ByteVector content = udp(poseDatagram(1));
    EXPECT_FALSE(ipPacketOf({101, ipv4(content)})->isFragment());
    EXPECT_TRUE(ipPacketOf({101, ipv4(content, 0x2000)})->hasMoreFragments);
    EXPECT_EQ(ipPacketOf({101, ipv4(content, 0x00b9)})->fragmentOffset, 8U * 0xb9);
}

TEST(IpPacket, SurvivesAFrameCutAnywhere) {
    for (const ByteVector& frame :
         {ethernet(ipv4(udp(textBytes("MXTP02")))), ethernet(ipv6(udp(textBytes("MXTP02"))), 0x86dd)}) {
        for (std::size_t size = 0; size < frame.size(); ++size) {
            const auto packet = ipPacketOf({1, std::span(frame).first(size)});
            const auto payload = packet ? udpPayloadOf(*packet) : std::nullopt;
            EXPECT_TRUE(!payload || payload->bytes.size() < 6) << size;
        }
    }
}

} // namespace
} // namespace posewire::log
