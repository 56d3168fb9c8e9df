// SPDX-License-Identifier: MIT
#include "core/export/json_value.h"

#include <array>
#include <charconv>
#include <cmath>

namespace posewire::exporting {

JsonValue floatJson(float value) {
    std::array<char, 32> digits{};
    const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    double number = value;
    std::from_chars(digits.data(), end, number);
    return number;
}

std::string jsonText(const JsonValue& value, int indent) {
    return value.dump(indent, ' ', false, JsonValue::error_handler_t::replace);
}

} // namespace posewire::exporting
