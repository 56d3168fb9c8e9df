// SPDX-License-Identifier: MIT
#include "core/model/session/metadata.h"

#include "core/wire/messages.h"
#include "core/wire/text.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace posewire::model {

const MetadataTag::Value* MetadataTag::at(std::uint64_t packet) const {
    const auto after = std::ranges::upper_bound(values, packet, {}, &Value::packet);
    return after == values.begin() ? nullptr : &*std::prev(after);
}

void Metadata::add(const wire::MetaData& message, std::uint64_t packet, log::Stamp stamp) {
    for (const wire::Tag& tag : wire::parseTags(message.text).tags) {
        auto found = std::ranges::find(m_tags, tag.name, &MetadataTag::name);
        if (found == m_tags.end()) {
            if (m_tags.size() == kMaxTags) {
                continue;
            }
            m_tags.push_back({std::string(tag.name), wire::isKnownTag(tag.name), stamp, {}});
            found = std::prev(m_tags.end());
        }
        found->lastSeen = stamp;
        if (found->values.empty() || found->values.back().text != tag.value) {
            if (found->values.size() == kMaxValues) {
                found->values.erase(found->values.begin());
            }
            found->values.push_back({std::string(tag.value), packet, stamp});
        }
    }
}

const MetadataTag* Metadata::find(std::string_view name) const {
    const auto found = std::ranges::find(m_tags, name, &MetadataTag::name);
    return found == m_tags.end() ? nullptr : &*found;
}

std::string_view Metadata::value(std::string_view name, std::uint64_t packet) const {
    const MetadataTag* tag = find(name);
    const MetadataTag::Value* value = tag != nullptr ? tag->at(packet) : nullptr;
    return value != nullptr ? std::string_view(value->text) : std::string_view();
}

std::optional<Colour> parseColour(std::string_view text) {
    if (!text.empty() && text.front() == '#') {
        text.remove_prefix(1);
    }
    std::uint32_t rgb = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, rgb, 16);
    if (text.size() != 6 || error != std::errc{} || stop != end) {
        return std::nullopt;
    }
    const auto component = [&](unsigned shift) { return static_cast<float>(rgb >> shift & 0xff) / 255.0F; };
    return Colour{component(16), component(8), component(0)};
}

Colour defaultColour(std::size_t index) {
    constexpr std::array<std::string_view, 8> colours{"3f7fd0", "e07a2c", "3f9f68", "b05bc0",
                                                      "c9a227", "d0555f", "2fa5b5", "8a8f98"};
    return *parseColour(colours[index % colours.size()]);
}

} // namespace posewire::model
