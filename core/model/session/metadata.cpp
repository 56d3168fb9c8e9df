// SPDX-License-Identifier: MIT
#include "core/model/session/metadata.h"

#include "core/wire/messages.h"
#include "core/wire/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

namespace posewire::model {

namespace {

enum Need { kSuperseded, kBytes, kUnknownTag, kKnownTag };

} // namespace

const MetadataTag::Value* MetadataTag::at(std::uint64_t packet) const {
    const auto after = std::ranges::upper_bound(values, packet, {}, &Value::packet);
    return after == values.begin() ? nullptr : &*std::prev(after);
}

std::size_t MetadataTag::memoryBytes() const {
    std::size_t bytes = sizeof(*this) + name.memoryBytes() + values.size() * sizeof(Value);
    for (const Value& value : values) {
        bytes += value.text.memoryBytes();
    }
    return bytes;
}

void Metadata::add(const wire::MetaData& message, std::uint64_t packet, log::Stamp stamp) {
    for (const wire::Tag& tag : wire::parseTags(message.text).tags) {
        auto found = std::ranges::find_if(m_tags, [&](const auto& each) { return each.name.isOf(tag.name); });
        if (found == m_tags.end()) {
            if (m_tags.size() == kMaxTags) {
                continue;
            }
            m_tags.push_back({tag.name, wire::isKnownTag(tag.name), stamp, {}});
            found = std::prev(m_tags.end());
        }
        found->lastSeen = stamp;
        std::vector<MetadataTag::Value>& values = found->values;
        if (values.empty() || !values.back().text.isOf(tag.value)) {
            if (values.size() == kMaxValues) {
                values.erase(values.begin());
                ++found->dropped;
            }
            if (!values.empty()) {
                values.back().text.forgetExact();
            }
            values.push_back({tag.value, packet, stamp});
        }
    }
}

const MetadataTag* Metadata::find(std::string_view name) const {
    const auto found = std::ranges::find_if(m_tags, [&](const auto& each) { return each.name.isOf(name); });
    return found == m_tags.end() ? nullptr : &*found;
}

const ForeignText& Metadata::value(std::string_view name, std::uint64_t packet) const {
    static const ForeignText none;
    const MetadataTag* tag = find(name);
    const MetadataTag::Value* value = tag != nullptr ? tag->at(packet) : nullptr;
    return value != nullptr ? value->text : none;
}

std::size_t Metadata::memoryBytes() const {
    std::size_t bytes = 0;
    for (const MetadataTag& tag : m_tags) {
        bytes += tag.memoryBytes();
    }
    return bytes;
}

std::optional<Metadata::Place> Metadata::oldestPlace() const {
    std::optional<Place> oldest;
    for (std::size_t i = 0; i < m_tags.size(); ++i) {
        const MetadataTag& tag = m_tags[i];
        const bool hasBytes = tag.name.hasForgettable() || tag.values.back().text.hasForgettable();
        const Droppable what = tag.values.size() > 1 ? Droppable{kSuperseded, tag.values.front().stamp}
                               : hasBytes            ? Droppable{kBytes, tag.lastSeen}
                               : tag.isKnown         ? Droppable{kKnownTag, tag.lastSeen}
                                                     : Droppable{kUnknownTag, tag.lastSeen};
        if (!oldest || what < oldest->what) {
            oldest = Place{what, i};
        }
    }
    return oldest;
}

std::optional<Droppable> Metadata::oldest() const {
    const auto place = oldestPlace();
    return place ? std::optional(place->what) : std::nullopt;
}

std::size_t Metadata::dropOldest() {
    const auto place = oldestPlace();
    if (!place) {
        return 0;
    }
    const auto tag = m_tags.begin() + static_cast<std::ptrdiff_t>(place->tag);
    std::vector<MetadataTag::Value>& values = tag->values;
    if (place->what.need == kSuperseded) {
        const std::size_t freed = sizeof(MetadataTag::Value) + values.front().text.memoryBytes();
        values.erase(values.begin());
        ++tag->dropped;
        if (values.capacity() > 4 * values.size()) {
            values.shrink_to_fit();
        }
        return freed;
    }
    const std::size_t before = tag->memoryBytes();
    if (place->what.need == kBytes) {
        tag->name.forgetExact();
        values.back().text.forgetExact();
        return before - tag->memoryBytes();
    }
    m_tags.erase(tag);
    ++m_droppedTags;
    return before;
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

std::string colourText(const Colour& colour) {
    std::array<std::byte, 3> bytes{};
    std::ranges::transform(std::array{colour.red, colour.green, colour.blue}, bytes.begin(), [](float part) {
        return static_cast<std::byte>(std::lround(std::clamp(part, 0.0F, 1.0F) * 255));
    });
    return '#' + wire::hexadecimal(bytes);
}

Colour defaultColour(std::size_t index) {
    constexpr std::array<std::string_view, 8> colours{"3f7fd0", "e07a2c", "3f9f68", "b05bc0",
                                                      "c9a227", "d0555f", "2fa5b5", "8a8f98"};
    return *parseColour(colours[index % colours.size()]);
}

} // namespace posewire::model
