// SPDX-License-Identifier: MIT
#include "core/model/accounting/other_formats.h"

#include "core/log/recording_file.h"
#include "tests/support/facts.h"
#include "tests/support/stream_source.h"

#include <gmock/gmock.h>

#include <sstream>

namespace posewire::model {
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

std::string otherIn(const std::string& file, const std::string& name = "file") {
    std::istringstream stream(file);
    log::FileContents contents;
    const auto source = test::readingFrom(stream, "file");
    EXPECT_TRUE(log::readFile(
        *source, [](const log::FileRecord&) {}, {}, &contents));
    return otherContents(contents, name);
}

TEST(OtherContents, AreNamedWhereTheyAreNoneOfOurs) {
    EXPECT_THAT(otherIn(""), HasSubstr("is empty"));
    EXPECT_THAT(otherIn("a letter to somebody"), HasSubstr("no MXTP datagram and is no capture"));
    EXPECT_THAT(otherIn("\x1f\x8b\x08 and more"),
                HasSubstr("looks like a compressed file. Unpack it first."));
    EXPECT_THAT(otherIn("XSMR\x01\x02", "Walk-001.mvn"), HasSubstr("Only MVN reads it"));
    EXPECT_THAT(otherIn(captureOf(1, {})), HasSubstr("a capture without packets; record again"));
    EXPECT_THAT(otherIn(captureOf(199, {"abc", "def"})),
                HasSubstr("no MXTP datagram in 2 packets (2 of link type 199, which is not looked through); "
                          "capture at an Ethernet"));
    EXPECT_THAT(
        otherIn(captureOf(
            1, {packetOfOthers("hello"), packetOfOthers("you", 6), packetOfOthers("ping", 1), "short"})),
        HasSubstr("no MXTP datagram in 4 packets (1 UDP, 1 TCP, 2 neither); capture where the sender"));
}

TEST(OtherContents, AreNotNamedWhereSomethingIsOurs) {
    EXPECT_EQ(otherIn(captureOf(1, {packetOfOthers("hello"), packetOfOthers("MXTP cut")})), "");
}

/// A datagram of type 24 without its derivatives: 36 bytes.
std::string datagram() {
    std::string bytes("MXTP24\0\0\0\1\x80\0\0\0\0\0\0\0\0\0\0\0\0\x0c", 24);
    return bytes + std::string(12, '\0');
}

TEST(OtherContents, AreNamedWhereMostOfAFileIsSomethingElse) {
    EXPECT_EQ(otherIn(datagram() + std::string(30, '\1')), "");
    EXPECT_THAT(otherIn(datagram() + std::string(40, '\1')),
                HasSubstr("1 MXTP datagram, but 40 of its 76 bytes belong to none"));
    EXPECT_THAT(otherIn("# Notes\n\n" + std::string(40, 'x') + datagram()),
                HasSubstr("looks like plain text"));
}

words::Kind kindOf(std::string_view text) {
    return looksLike(std::as_bytes(std::span(text))).kind;
}

TEST(LooksLike, KnowsWhatUsuallyComesToThesePorts) {
    using namespace std::string_view_literals;
    using Kind = words::Kind;
    EXPECT_EQ(kindOf("#bundle\0"sv), Kind::LooksLikeOsc);
    EXPECT_EQ(kindOf("/body/hip\0\0\0,fff\0\0\0\0"sv), Kind::LooksLikeOsc);
    EXPECT_EQ(kindOf("/go\0"sv), Kind::LooksLikeOsc);
    EXPECT_EQ(kindOf("/cut\0"sv), Kind::Nothing);
    EXPECT_EQ(kindOf("\xfd"
                     "7zXZ\0"sv),
              Kind::LooksLikeCompressed);
    EXPECT_EQ(kindOf("#bundle\0\0\0\0\0\0\0\0\1\0\0\0\x20/VMC/Ext/Bone/Pos\0,s"sv), Kind::LooksLikeVmc);
    EXPECT_EQ(kindOf("/VMC/Ext/OK\0,i\0\0"sv), Kind::LooksLikeVmc);
    EXPECT_EQ(kindOf("// a program, with MXTP in it"), Kind::LooksLikeText);
    EXPECT_EQ(kindOf("\x07\x00\x40\x02\x01\x00\x00\x00"sv), Kind::LooksLikeNatNet);
    EXPECT_EQ(kindOf("\x10\x00\x00\x00\x02\x00\x48\x00Subject"sv), Kind::LooksLikeVicon);
    EXPECT_EQ(kindOf("\x00\x00\x00\x40\x00\x00\x00\x03"sv), Kind::LooksLikeQualisys);
    EXPECT_EQ(kindOf("{\"type\":1}"), Kind::LooksLikeJson);
    EXPECT_EQ(kindOf("{\"type\":\"transport\",\"value\":\"record\"}"), Kind::LooksLikeTransport);
    EXPECT_EQ(kindOf("GET / HTTP/1.1"), Kind::LooksLikeHttp);
    EXPECT_EQ(kindOf("\xff\xfe\xfd"), Kind::Nothing);
    EXPECT_EQ(kindOf(""), Kind::Nothing);
    const std::string_view prefixed = "\x00\x00\x02\xf8MXTP02"sv;
    EXPECT_EQ(looksLike(std::as_bytes(std::span(prefixed))), counted(Kind::MxtpBehind, 4));
}

TEST(LooksLike, TellsXmlApartByItsElements) {
    using Kind = words::Kind;
    const std::string prolog = R"(<?xml version="1.0" encoding="UTF-8" standalone="no" ?>)";
    EXPECT_EQ(kindOf(prolog + R"(<CaptureStart><Name VALUE="a"/></CaptureStart>)"), Kind::LooksLikeTrigger);
    EXPECT_EQ(kindOf(prolog + "\r\n<mvnx version=\"4\">"), Kind::LooksLikeMvnx);
    EXPECT_EQ(kindOf("<IdentifyReq/>"), Kind::LooksLikeRemote);
    EXPECT_EQ(kindOf("<CaptureName><Name VALUE=\"\"/></CaptureName>"), Kind::LooksLikeRemote);
    EXPECT_EQ(kindOf(prolog + "<html>"), Kind::LooksLikeXml);
}

TEST(LooksLike, KnowsFilesOfOthers) {
    using namespace std::string_view_literals;
    EXPECT_EQ(kindOf("Kaydara FBX Binary  \0"sv), words::Kind::LooksLikeFbx);
    EXPECT_EQ(kindOf("# Posewire\n\nShows motion capture, spr\xc3"), words::Kind::LooksLikeText);
    EXPECT_EQ(kindOf("XTLP\x01\0\0\0"sv), words::Kind::LooksLikeXtlp);
}

} // namespace
} // namespace posewire::model
