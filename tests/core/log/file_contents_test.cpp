// SPDX-License-Identifier: MIT
#include "core/log/byte_io.h"

#include "core/log/recording_file.h"
#include "tests/support/stream_source.h"

#include <gmock/gmock.h>

#include <sstream>

namespace posewire::log {
namespace {

using testing::HasSubstr;

/// Appends numbers of four bytes in the order of this computer, as pcap may have them.
std::string nativeWords(std::initializer_list<std::uint32_t> numbers) {
    std::string bytes;
    for (const std::uint32_t number : numbers) {
        bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    return bytes;
}

std::string captureOf(std::uint32_t linkType, const std::vector<std::string>& frames) {
    std::string file = nativeWords({0xa1b2c3d4, 0x00040002, 0, 0, 65535, linkType});
    for (const std::string& frame : frames) {
        const auto size = static_cast<std::uint32_t>(frame.size());
        file += nativeWords({1, 0, size, size}) + frame;
    }
    return file;
}

/// A UDP packet over IPv4 in an Ethernet frame.
std::string packetOfOthers(const std::string& payload, std::uint8_t protocol = 17) {
    const std::string udp = std::string("\x13\x88\x13\x89\0", 5) + static_cast<char>(8 + payload.size()) +
                            std::string(2, '\0') + payload;
    std::string ip(20, '\0');
    ip[0] = 0x45;
    ip[3] = static_cast<char>(20 + udp.size());
    ip[9] = static_cast<char>(protocol);
    return std::string(12, '\0') + std::string("\x08\0", 2) + ip + udp;
}

std::string otherIn(const std::string& file) {
    std::istringstream stream(file);
    FileContents contents;
    const auto source = test::readingFrom(stream, "file");
    EXPECT_TRUE(readFile(
        *source, [](const FileRecord&) {}, {}, &contents));
    return otherContents(contents);
}

TEST(FileContents, AreNamedWhereTheyAreNoneOfOurs) {
    EXPECT_THAT(otherIn(""), HasSubstr("is empty"));
    EXPECT_THAT(otherIn("a letter to somebody"), HasSubstr("no MXTP datagram and is no capture"));
    EXPECT_EQ(otherIn("\x1f\x8b\x08 and more"), "is compressed; unpack it first");
    EXPECT_THAT(otherIn(captureOf(1, {})), HasSubstr("a capture without packets; record again"));
    EXPECT_THAT(otherIn(captureOf(199, {"abc", "def"})),
                HasSubstr("no MXTP datagram in 2 packets (2 of link type 199, which is not looked through); "
                          "capture at an Ethernet"));
    EXPECT_THAT(
        otherIn(captureOf(
            1, {packetOfOthers("hello"), packetOfOthers("you", 6), packetOfOthers("ping", 1), "short"})),
        HasSubstr("no MXTP datagram in 4 packets (1 UDP, 1 TCP, 2 neither); capture where the sender"));
}

TEST(FileContents, AreNotNamedWhereSomethingIsOurs) {
    EXPECT_EQ(otherIn(captureOf(1, {packetOfOthers("hello"), packetOfOthers("MXTP cut")})), "");
}

} // namespace
} // namespace posewire::log
