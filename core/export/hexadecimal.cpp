// SPDX-License-Identifier: MIT
#include "core/export/hexadecimal.h"

#include <charconv>

namespace posewire::exporting {

std::string hexadecimal(wire::Bytes bytes) {
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

} // namespace posewire::exporting
