// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/types.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Texts in datagrams, and bytes as text.
namespace posewire::wire {

/// Index of the first byte that is not part of a well-formed UTF-8 sequence (RFC 3629: no overlong forms, no
/// surrogates, nothing above U+10FFFF); text.size() if all is well.
[[nodiscard]] std::size_t firstInvalidUtf8(std::string_view text);

/// The small letter of a capital of ASCII; anything else as it is.
[[nodiscard]] constexpr char lower(char character) {
    return character >= 'A' && character <= 'Z' ? static_cast<char>(character - 'A' + 'a') : character;
}
[[nodiscard]] std::string lowered(std::string_view text);

/// Two small letters or digits a byte, nothing between them.
[[nodiscard]] std::string hexadecimal(Bytes bytes);

/// The inverse; capitals are accepted. Empty if there is anything but whole bytes.
[[nodiscard]] std::optional<std::vector<std::byte>> fromHexadecimal(std::string_view text);

/// One line of a type 12 text (§2.6.3). Views into the text that was parsed.
struct Tag {
    std::string_view name;
    std::string_view value;
    friend bool operator==(const Tag&, const Tag&) = default;
};

/// The tags in wire order. Each line is split at its first colon, since values may contain colons; empty
/// lines and lines without a colon are left out (`strayLines` counts them, a last line without newline
/// included in both if it has a tag).
struct TagList {
    std::vector<Tag> tags;
    unsigned strayLines = 0;
    std::size_t firstStray = 0; ///< where the first of those begins in the text
};
[[nodiscard]] TagList parseTags(std::string_view text);

/// The specified tags (name, xmid, color) and those that real senders are known to send.
[[nodiscard]] std::span<const std::string_view> knownTags();
/// True for one of them.
[[nodiscard]] bool isKnownTag(std::string_view name);

} // namespace posewire::wire
