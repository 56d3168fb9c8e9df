// SPDX-License-Identifier: MIT
#include "core/model/accounting/other_formats.h"

#include "core/wire/byte_order.h"
#include "core/wire/header.h"
#include "core/wire/text.h"
#include "core/words/say.h"

#include <algorithm>
#include <array>

namespace posewire::model {
namespace {

using Kind = words::Kind;

struct Mark {
    std::string_view text;
    Kind kind;
};

// clang-format off
/// Formats by their first bytes, the more special ones first; compressed are gzip, zip, xz, zstd and bzip2.
constexpr std::array<Mark, 14> kBeginnings{{
    {"XTLP", Kind::LooksLikeXtlp}, {"Art-Net", Kind::LooksLikeArtNet}, {"GET ", Kind::LooksLikeHttp},
    {"POST ", Kind::LooksLikeHttp}, {"fr ", Kind::LooksLikeDTrack},
    {"{\"type\":\"transport\"", Kind::LooksLikeTransport}, {"{", Kind::LooksLikeJson},
    {"Kaydara FBX", Kind::LooksLikeFbx}, {"; FBX", Kind::LooksLikeFbx},
    {"\x1f\x8b", Kind::LooksLikeCompressed}, {"PK\x03\x04", Kind::LooksLikeCompressed},
    {"\xfd\x37zXZ", Kind::LooksLikeCompressed}, {"\x28\xb5\x2f\xfd", Kind::LooksLikeCompressed},
    {"BZh", Kind::LooksLikeCompressed}}};
/// The kind of XML, by its first elements.
constexpr std::array<Mark, 8> kElements{{
    {"<mvnx", Kind::LooksLikeMvnx}, {"<frame ", Kind::LooksLikeMvnx},
    {"<CaptureStart", Kind::LooksLikeTrigger}, {"<CaptureStop", Kind::LooksLikeTrigger},
    {"<Identify", Kind::LooksLikeRemote}, {"<StartRecording", Kind::LooksLikeRemote},
    {"<StopRecording", Kind::LooksLikeRemote}, {"<CaptureName", Kind::LooksLikeRemote}}};
// clang-format on

/// An address such as "/body/hip" that ends with a zero and is padded to four bytes, then the types of its
/// arguments after a comma; or several of these.
bool isOsc(std::string_view text) {
    const std::size_t end = text.find('\0');
    const std::size_t next = (end / 4 + 1) * 4;
    const bool isAddress =
        text.starts_with('/') && end != std::string_view::npos &&
        std::ranges::all_of(text.substr(0, end), [](char c) { return c > ' ' && c <= '~'; });
    return text.starts_with("#bundle") ||
           (isAddress && next <= text.size() && (next == text.size() || text[next] == ','));
}

/// A message number and the size of what follows, both little-endian; frames are 7, descriptions 5.
bool isNatNet(wire::Bytes bytes) {
    return bytes.size() >= 4 && wire::load16(bytes.data() + 2) != 0 &&
           (wire::load16(bytes.data()) == 0x0500 || wire::load16(bytes.data()) == 0x0700);
}

/// Frame number, count of items, then the first item: number 0 and 72 bytes, little-endian.
bool isVicon(wire::Bytes bytes) {
    return bytes.size() >= 8 && bytes[4] != std::byte{} && (wire::load32(bytes.data() + 4) << 8U) == 0x480000;
}

/// A packet's size and its kind, one of a few.
bool isQualisys(wire::Bytes bytes) {
    return bytes.size() >= 8 && wire::load16(bytes.data()) == 0 && wire::load16(bytes.data() + 2) != 0 &&
           wire::load32(bytes.data() + 4) <= 9;
}

bool isText(std::string_view text) {
    constexpr std::size_t kLeast = 8;
    constexpr std::size_t kCut = 3; // bytes of a character at the end
    const bool isPlain = std::ranges::all_of(text, [](char c) {
        return static_cast<unsigned char>(c) >= ' ' || c == '\n' || c == '\r' || c == '\t';
    });
    return isPlain && text.size() >= kLeast && wire::firstInvalidUtf8(text) + kCut >= text.size();
}

/// The offset of a whole datagram behind other bytes; 0 if there is none.
std::size_t datagramIn(wire::Bytes bytes) {
    for (std::size_t from = 1; from < bytes.size(); ++from) {
        if (wire::startsDatagram(bytes.subspan(from))) {
            return from;
        }
    }
    return 0;
}

Kind kindOf(std::string_view text, const auto& marks, const auto& isMet) {
    const auto met = std::ranges::find_if(marks, [&](const Mark& mark) { return isMet(text, mark.text); });
    return met == marks.end() ? Kind::Nothing : met->kind;
}

void append(std::string& list, std::uint64_t count, const std::string& what) {
    if (count != 0) {
        list += (list.empty() ? "" : ", ") + std::to_string(count) + ' ' + what;
    }
}

std::string ofCapture(const log::CaptureContents& contents) {
    if (contents.packets == 0) {
        return "is a capture without packets; record again while the sender streams";
    }
    std::string list;
    append(list, contents.udp, "UDP");
    append(list, contents.tcp, "TCP");
    append(list, contents.withoutIp, "neither");
    append(list, contents.ofOtherLinks,
           "of link type " + std::to_string(contents.otherLink) + ", which is not looked through");
    const bool isAllUnknown = contents.ofOtherLinks == contents.packets;
    return "has no MXTP datagram in " + std::to_string(contents.packets) +
           (contents.packets == 1 ? " packet (" : " packets (") + list + "); " +
           (isAllUnknown ? "capture at an Ethernet or a loopback interface"
                         : "capture where the sender sends to, while it streams");
}

words::Fact otherFile(const log::FileContents& contents, std::string_view name) {
    const words::Fact seen = name.ends_with(".mvn") ? Kind::LooksLikeMvn : looksLike(contents.head);
    return contents.datagrams == 0 ? words::Fact{Kind::HoldsNoMxtp, {{"looks", seen}}}
                                   : words::Fact{Kind::HoldsLittleMxtp,
                                                 {{"n", contents.datagrams},
                                                  {"value", contents.skipped},
                                                  {"all", contents.skipped + contents.bytes},
                                                  {"looks", seen}}};
}

} // namespace

words::Fact looksLike(wire::Bytes head) {
    const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
    const auto contains = [](std::string_view all, std::string_view part) {
        return all.find(part) != std::string_view::npos;
    };
    const auto begins = [](std::string_view all, std::string_view part) { return all.starts_with(part); };
    if (const std::size_t before = datagramIn(head); before != 0) {
        return words::counted(Kind::MxtpBehind, before);
    }
    if (const Kind kind = kindOf(text, kBeginnings, begins); kind != Kind::Nothing) {
        return kind;
    }
    if (text.starts_with('<') || text.starts_with("\xef\xbb\xbf<")) {
        const Kind kind = kindOf(text, kElements, contains);
        return kind != Kind::Nothing ? kind : Kind::LooksLikeXml;
    }
    return isOsc(text)        ? contains(text, "/VMC/") ? Kind::LooksLikeVmc : Kind::LooksLikeOsc
           : isNatNet(head)   ? Kind::LooksLikeNatNet
           : isVicon(head)    ? Kind::LooksLikeVicon
           : isQualisys(head) ? Kind::LooksLikeQualisys
           : isText(text)     ? Kind::LooksLikeText
                              : Kind::Nothing;
}

std::string otherContents(const log::FileContents& contents, std::string_view name) {
    if (contents.isEmpty) {
        return "is empty; was it copied whole?";
    }
    if (contents.capture) {
        return contents.datagrams == 0 ? ofCapture(*contents.capture) : std::string();
    }
    if (!contents.isMostlyOther()) {
        return {};
    }
    const words::Fact fact = otherFile(contents, name);
    return say(fact, words::Form::Sentence) + ' ' + say(fact, words::Form::Advice);
}

} // namespace posewire::model
