// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/foreign_text.h"
#include "core/model/keeping.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace posewire::wire {
struct MetaData;
}

namespace posewire::model {

/// One tag of a character's metadata with its history.
struct MetadataTag {
    struct Value {
        ForeignText text;         ///< the bytes are known of the newest value alone
        std::uint64_t packet = 0; ///< the packet that brought it first
        log::Stamp stamp{};
    };
    ForeignText name;
    bool isKnown = false;      ///< specified, or known from real senders
    log::Stamp lastSeen{};     ///< when it was last sent, changed or not
    std::vector<Value> values; ///< each change, oldest first; never empty
    std::uint64_t dropped = 0; ///< older values that were given up

    /// The value as of a packet number; null where the tag had not been sent by then, or its value of then
    /// was given up.
    [[nodiscard]] const Value* at(std::uint64_t packet) const;
    [[nodiscard]] std::size_t memoryBytes() const;
};

/// The type 12 messages of one character. A packet may carry any of the tags (§2.6.3), so values are kept
/// until they change, and each once however often it is sent. Bounded: at most kMaxTags tags of kMaxValues
/// values; older values go first. Who keeps many of these keeps them within a budget (keepWithin).
class Metadata {
public:
    static constexpr std::size_t kMaxTags = 64;
    static constexpr std::size_t kMaxValues = 64;

    void add(const wire::MetaData& message, std::uint64_t packet, log::Stamp stamp);

    /// In the order in which they were first seen.
    [[nodiscard]] std::span<const MetadataTag> tags() const { return m_tags; }
    [[nodiscard]] const MetadataTag* find(std::string_view name) const;

    /// Value of a tag as of a packet; empty where there is none.
    [[nodiscard]] const ForeignText& value(std::string_view name, std::uint64_t packet) const;

    /// Tags that were given up.
    [[nodiscard]] std::uint64_t droppedTags() const { return m_droppedTags; }

    [[nodiscard]] std::size_t memoryBytes() const;
    /// Values that have changed since go first, then the bytes of long values, then tags nobody knows, the
    /// others last.
    [[nodiscard]] std::optional<Droppable> oldest() const;
    /// Returns the bytes that are free now.
    std::size_t dropOldest();

private:
    struct Place {
        Droppable what;
        std::size_t tag = 0;
    };
    [[nodiscard]] std::optional<Place> oldestPlace() const;

    std::vector<MetadataTag> m_tags;
    std::uint64_t m_droppedTags = 0;
};

/// Colour as in the tag "color": RRGGBB, hexadecimal, with or without '#'. Components 0 to 1.
struct Colour {
    float red = 0;
    float green = 0;
    float blue = 0;
    friend bool operator==(const Colour&, const Colour&) = default;
};
[[nodiscard]] std::optional<Colour> parseColour(std::string_view text);
/// The inverse: "#e96417".
[[nodiscard]] std::string colourText(const Colour& colour);

/// A colour for characters that have not sent one; distinct for the first eight.
[[nodiscard]] Colour defaultColour(std::size_t index);

} // namespace posewire::model
