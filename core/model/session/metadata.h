// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::wire {
struct MetaData;
}

namespace posewire::model {

/// One tag of a character's metadata with its history.
struct MetadataTag {
    struct Value {
        std::string text;
        std::uint64_t packet = 0; ///< the packet that brought it first
        log::Stamp stamp{};
    };
    std::string name;
    bool isKnown = false;      ///< specified, or known from real senders
    log::Stamp lastSeen{};     ///< when it was last sent, changed or not
    std::vector<Value> values; ///< each change, oldest first; never empty

    /// The value as of a packet number; null where the tag had not been sent by then.
    [[nodiscard]] const Value* at(std::uint64_t packet) const;
};

/// The type 12 messages of one character. A packet may carry any of the tags (§2.6.3), so
/// values are kept until they change. Bounded: at most kMaxTags tags of kMaxValues values; older values go
/// first.
class Metadata {
public:
    static constexpr std::size_t kMaxTags = 64;
    static constexpr std::size_t kMaxValues = 256;

    void add(const wire::MetaData& message, std::uint64_t packet, log::Stamp stamp);

    /// In the order in which they were first seen.
    [[nodiscard]] std::span<const MetadataTag> tags() const { return m_tags; }
    [[nodiscard]] const MetadataTag* find(std::string_view name) const;

    /// Value of a tag as of a packet; empty where there is none.
    [[nodiscard]] std::string_view value(std::string_view name, std::uint64_t packet) const;

private:
    std::vector<MetadataTag> m_tags;
};

/// Colour as in the tag "color": RRGGBB, hexadecimal, with or without '#'. Components 0 to 1.
struct Colour {
    float red = 0;
    float green = 0;
    float blue = 0;
    friend bool operator==(const Colour&, const Colour&) = default;
};
[[nodiscard]] std::optional<Colour> parseColour(std::string_view text);

/// A colour for characters that have not sent one; distinct for the first eight.
[[nodiscard]] Colour defaultColour(std::size_t index);

} // namespace posewire::model
