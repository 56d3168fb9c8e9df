// SPDX-License-Identifier: MIT
#include "core/export/json_value.h"

#include <array>
#include <charconv>
#include <cmath>

namespace posewire::exporting {

JsonValue floatJson(float value) {
    const std::string digits = numberText(value);
    double number = value;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return number;
}

std::string numberText(float value) {
    if (std::isnan(value)) {
        return "NaN";
    }
    if (std::isinf(value)) {
        return value > 0 ? "Infinity" : "-Infinity";
    }
    std::array<char, 32> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string jsonText(const JsonValue& value, int indent) {
    return value.dump(indent, ' ', false, JsonValue::error_handler_t::replace);
}

} // namespace posewire::exporting
