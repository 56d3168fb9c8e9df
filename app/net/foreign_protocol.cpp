// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/foreign_protocol.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace posewire::net {

namespace {

using Bytes = std::span<const std::byte>;

unsigned at(Bytes bytes, std::size_t index) {
    return index < bytes.size() ? std::to_integer<unsigned>(bytes[index]) : 0U;
}

unsigned littleEndian16(Bytes bytes, std::size_t index) {
    return at(bytes, index) | at(bytes, index + 1) << 8;
}

std::string_view textOf(Bytes bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// An address such as "/body/hip" that ends with a zero, padded to four bytes.
bool isOsc(Bytes bytes) {
    const std::string_view text = textOf(bytes);
    return text.starts_with("#bundle") ||
           (text.starts_with('/') && bytes.size() >= 4 && std::ranges::all_of(text.substr(1, 3), [](char c) {
                return c == '\0' || (c >= ' ' && c <= '~');
            }));
}

/// A message number and the size of what follows, both little-endian; frames are 7, descriptions 5.
bool isNatNet(Bytes bytes) {
    const unsigned message = littleEndian16(bytes, 0);
    return bytes.size() >= 4 && (message == 5 || message == 7) && littleEndian16(bytes, 2) != 0;
}

/// Frame number, count of items, then the first item: number 0 and 72 bytes.
bool isVicon(Bytes bytes) {
    return bytes.size() >= 8 && at(bytes, 4) != 0 && at(bytes, 5) == 0 && littleEndian16(bytes, 6) == 72;
}

/// A packet's size, big-endian, and its kind, one of a few.
bool isQualisys(Bytes bytes) {
    return bytes.size() >= 8 && at(bytes, 0) == 0 && at(bytes, 1) == 0 && at(bytes, 4) == 0 &&
           at(bytes, 5) == 0 && at(bytes, 6) == 0 && at(bytes, 7) <= 9 && at(bytes, 2) + at(bytes, 3) != 0;
}

} // namespace

std::string protocolThatBegins(Bytes bytes) {
    struct Beginning {
        std::string_view text;
        std::string_view name;
    };
    constexpr std::array kBeginnings{Beginning{"Art-Net", "Art-Net (lighting)"},
                                     Beginning{"GET ", "HTTP (a web browser)"},
                                     Beginning{"POST ", "HTTP (a web browser)"},
                                     Beginning{"fr ", "ART DTrack"},
                                     Beginning{"{", "JSON text (Rokoko, or MVN's own remote control)"},
                                     Beginning{"<", "XML text (MVN's own remote control, or a web page)"}};
    const std::string_view text = textOf(bytes);
    if (const auto mark = text.find("MXTP"); mark != std::string_view::npos && mark != 0) {
        return "MXTP behind " + std::to_string(mark) + " other bytes (a tunnel, or a length prefix)";
    }
    for (const Beginning& beginning : kBeginnings) {
        if (text.starts_with(beginning.text)) {
            return std::string(beginning.name);
        }
    }
    if (isOsc(bytes)) {
        return "OSC";
    }
    if (isNatNet(bytes)) {
        return "NatNet (OptiTrack Motive)";
    }
    if (isVicon(bytes)) {
        return "Vicon's object stream";
    }
    return isQualisys(bytes) ? "Qualisys QTM's real-time protocol" : std::string();
}

std::string shownBytes(Bytes bytes) {
    constexpr std::size_t kShown = 16;
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string hexadecimal;
    std::string readable;
    for (const std::byte byte : bytes.first(std::min(bytes.size(), kShown))) {
        const auto value = std::to_integer<unsigned char>(byte);
        hexadecimal += kDigits[value >> 4];
        hexadecimal += kDigits[value & 0xf];
        hexadecimal += ' ';
        readable += value >= ' ' && value <= '~' ? static_cast<char>(value) : '.';
    }
    return hexadecimal + ' ' + readable;
}

} // namespace posewire::net
