// SPDX-License-Identifier: MIT
#pragma once

#include "core/filter/field.h"

namespace posewire::filter {

/// What a name in a filter may mean: fields of that name, and which of their numbers.
struct FieldMatch {
    std::vector<const FieldInfo*> fields; ///< those of the packet first
    bool hasComponent = false;
    std::size_t component = 0;
    bool isTag = false;
    std::string_view tag; ///< of "tag.name": "name"
};

/// Understands "sample", "position.z", "segments.position.z", "header.sample", "tag", "tag.name". No fields
/// (and no tag) where nothing has that name.
[[nodiscard]] FieldMatch findFields(std::string_view name);

/// The numbers of a vector, as they are asked for: "x", "y" …; empty beyond its end.
[[nodiscard]] std::string_view componentName(std::size_t components, std::size_t component);

/// The name that `field` is asked for by: the qualifier only where another field has the name too.
[[nodiscard]] std::string askedName(const FieldInfo& field);

/// The name of a field that is nearest to one that does not exist; empty where none is near.
[[nodiscard]] std::string nearestField(std::string_view name);
/// The nearest of some words.
[[nodiscard]] std::string nearestOf(std::string_view word, std::span<const std::string_view> words);

/// Number that a word of a filter spells: decimal, 0x…, with a sign, inf; nothing where it is none.
[[nodiscard]] std::optional<double> numberOf(std::string_view word);

} // namespace posewire::filter
