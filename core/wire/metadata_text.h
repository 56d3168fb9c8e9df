// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::wire {

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

/// The inverse: "name:value\n" for each tag.
[[nodiscard]] std::string joinTags(const std::vector<Tag>& tags);

/// The specified tags (name, xmid, color) and those that real senders are known to send.
[[nodiscard]] std::span<const std::string_view> knownTags();
/// True for one of them.
[[nodiscard]] bool isKnownTag(std::string_view name);

} // namespace posewire::wire
