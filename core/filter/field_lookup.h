// SPDX-License-Identifier: MIT
#pragma once

#include "core/filter/field.h"

namespace posewire::filter {

/// What a name in a filter may mean: fields of that name, and one of their components.
struct FieldMatch {
    std::vector<const FieldInfo*> fields; ///< those of the packet first
    bool hasComponent = false;
    std::size_t component = 0;
    bool isTag = false;
    std::string_view tag; ///< of "tag.name": "name"
};

/// Understands "sample", "position.z", "segments.position.z", "header.sample", "tag", "tag.name". No fields
/// (and no tag) if nothing has that name.
[[nodiscard]] FieldMatch findFields(std::string_view name);

/// The names of a vector's components: "x", "y" …; empty beyond its end.
[[nodiscard]] std::string_view componentName(std::size_t components, std::size_t component);

/// The name to use for `field`: with its qualifier only if another field shares the name.
[[nodiscard]] std::string askedName(const FieldInfo& field);

/// The field name closest to one that does not exist; empty if none is close.
[[nodiscard]] std::string nearestField(std::string_view name);
/// The closest of some words.
[[nodiscard]] std::string nearestOf(std::string_view word, std::span<const std::string_view> words);

/// What fields of a kind are called, and what can be compared with them, in words.
struct KindWords {
    std::string_view name;
    std::string_view value;
};
[[nodiscard]] KindWords kindWords(Kind kind);

/// The number that a word spells: decimal, 0x…, with a sign, inf; empty if it is not a number.
[[nodiscard]] std::optional<double> numberOf(std::string_view word);

} // namespace posewire::filter
