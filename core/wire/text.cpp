// SPDX-License-Identifier: MIT
#include "core/wire/text.h"

#include <algorithm>
#include <charconv>

namespace posewire::wire {
namespace {

/// What may follow a lead byte: how many bytes, and the range of the first of them (RFC 3629 section 4).
struct Sequence {
    std::size_t following;
    unsigned char low;
    unsigned char high;
};

Sequence sequenceOf(unsigned char lead) {
    if (lead < 0xc2 || lead > 0xf4) {
        return {0, 1, 0};
    }
    if (lead < 0xe0) {
        return {1, 0x80, 0xbf};
    }
    if (lead < 0xf0) {
        return {2, static_cast<unsigned char>(lead == 0xe0 ? 0xa0 : 0x80),
                static_cast<unsigned char>(lead == 0xed ? 0x9f : 0xbf)};
    }
    return {3, static_cast<unsigned char>(lead == 0xf0 ? 0x90 : 0x80),
            static_cast<unsigned char>(lead == 0xf4 ? 0x8f : 0xbf)};
}

} // namespace

std::size_t firstInvalidUtf8(std::string_view text) {
    std::size_t i = 0;
    while (i < text.size()) {
        const auto lead = static_cast<unsigned char>(text[i]);
        if (lead < 0x80) {
            ++i;
            continue;
        }
        const Sequence sequence = sequenceOf(lead);
        if (sequence.following == 0 || text.size() - i <= sequence.following) {
            return i;
        }
        const auto second = static_cast<unsigned char>(text[i + 1]);
        if (second < sequence.low || second > sequence.high) {
            return i;
        }
        for (std::size_t k = 2; k <= sequence.following; ++k) {
            if ((static_cast<unsigned char>(text[i + k]) & 0xc0) != 0x80) {
                return i;
            }
        }
        i += sequence.following + 1;
    }
    return text.size();
}

std::string lowered(std::string_view text) {
    std::string all(text);
    std::ranges::transform(all, all.begin(), lower);
    return all;
}

std::string hexadecimal(Bytes bytes) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    text.reserve(2 * bytes.size());
    for (const std::byte byte : bytes) {
        text += digits[std::to_integer<unsigned>(byte >> 4)];
        text += digits[std::to_integer<unsigned>(byte & std::byte{15})];
    }
    return text;
}

std::optional<std::vector<std::byte>> fromHexadecimal(std::string_view text) {
    if (text.size() % 2 != 0) {
        return std::nullopt;
    }
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 2);
    for (std::size_t i = 0; i < text.size(); i += 2) {
        const char* from = text.data() + i;
        std::uint8_t value = 0;
        if (std::from_chars(from, from + 2, value, 16).ptr != from + 2) {
            return std::nullopt;
        }
        bytes.push_back(std::byte{value});
    }
    return bytes;
}

TagList parseTags(std::string_view text) {
    TagList list;
    const char* const begin = text.data();
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        const std::string_view line = text.substr(0, end);
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos || end == std::string_view::npos) {
            list.firstStray =
                list.strayLines == 0 ? static_cast<std::size_t>(line.data() - begin) : list.firstStray;
            ++list.strayLines;
        }
        if (colon != std::string_view::npos) {
            list.tags.push_back({line.substr(0, colon), line.substr(colon + 1)});
        }
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return list;
}

std::span<const std::string_view> knownTags() {
    static constexpr std::array<std::string_view, 5> known{"name", "xmid", "color", "count", "timeOffset"};
    return known;
}

bool isKnownTag(std::string_view name) {
    return std::ranges::find(knownTags(), name) != knownTags().end();
}

} // namespace posewire::wire
