// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/field_tree.h"

#include <string>
#include <string_view>

namespace posewire::filter {

/// A filter for packets that have this value: ("character", "1") gives `character == 1`, ("source",
/// "192.168.1.20:4001") gives `sender == "192.168.1.20:4001"`. Segment ids become names. Empty where no
/// filter field has that name.
[[nodiscard]] std::string expressionFor(std::string_view field, std::string_view value);

/// The same for a node of the inspector: a field with its value (vectors by component), an item by what it is
/// about, a list by being there. Empty where no filter could say it.
[[nodiscard]] std::string expressionFor(const wire::FieldTree& tree, std::int32_t node);

} // namespace posewire::filter
