// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/field_tree.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Help with writing filters.
namespace posewire::filter {

/// One way to continue a filter.
struct Completion {
    std::size_t offset = 0; ///< of the bytes that are replaced
    std::size_t length = 0;
    std::string text;  ///< what is there afterwards
    std::string about; ///< one line: kind, unit and meaning
};

/// What can come at the cursor (a byte offset), best first: fields where a condition begins, then operators
/// that suit the field, then its values. Works within a word and in texts that are wrong elsewhere.
[[nodiscard]] std::vector<Completion> completions(std::string_view text, std::size_t cursor);

/// Completes signals alike: functions, fields, figures, items, units, arithmetic, and filters after `where`.
[[nodiscard]] std::vector<Completion> signalCompletions(std::string_view text, std::size_t cursor);

/// A filter for packets that have this value: ("character", "1") gives `character == 1`, ("source",
/// "192.168.1.20:4001") gives `source == "192.168.1.20:4001"`. Segment ids become names. Empty where no
/// filter field has that name.
[[nodiscard]] std::string expressionFor(std::string_view field, std::string_view value);

/// The same for a node of the inspector: a field with its value (vectors by component), an item by what it is
/// about, a list by being there. Empty where no filter could say it.
[[nodiscard]] std::string expressionFor(const wire::FieldTree& tree, std::int32_t node);

} // namespace posewire::filter
