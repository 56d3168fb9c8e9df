// SPDX-License-Identifier: MIT
#include "core/wire/metadata_text.h"

#include <algorithm>
#include <array>

namespace posewire::wire {

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

std::string joinTags(const std::vector<Tag>& tags) {
    std::string text;
    for (const Tag& tag : tags) {
        text.append(tag.name).append(":").append(tag.value).append("\n");
    }
    return text;
}

std::span<const std::string_view> knownTags() {
    static constexpr std::array<std::string_view, 5> known{"name", "xmid", "color", "count", "timeOffset"};
    return known;
}

bool isKnownTag(std::string_view name) {
    return std::ranges::find(knownTags(), name) != knownTags().end();
}

} // namespace posewire::wire
