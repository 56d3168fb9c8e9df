// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace posewire::exporting {

/// A JSON document as exports build it; keys keep their order. Numbers that are not finite are null.
using JsonValue = nlohmann::ordered_json;

/// With as few digits as distinguish the number from its neighbours of 32 bits.
[[nodiscard]] JsonValue floatJson(float value);

/// As floats are written, with as few digits; "NaN", "Infinity" or "-Infinity", which JSON has no numbers
/// for.
[[nodiscard]] std::string numberText(float value);

/// One line, or indented by this many spaces per level. Bytes that are not UTF-8 are written as U+FFFD.
[[nodiscard]] std::string jsonText(const JsonValue& value, int indent = -1);

template <class Item, class ToJson>
JsonValue listOf(const std::vector<Item>& items, ToJson toJson) {
    JsonValue list = JsonValue::array();
    std::ranges::transform(items, std::back_inserter(list), toJson);
    return list;
}

} // namespace posewire::exporting
