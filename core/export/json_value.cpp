// SPDX-License-Identifier: MIT
#include "core/export/json_value.h"

#include <nlohmann/json.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace posewire::exporting {
namespace {

using Written = nlohmann::ordered_json;

Written jsonOf(const JsonValue& value);

struct ToJson {
    Written operator()(std::monostate) const { return nullptr; }
    Written operator()(const JsonValue::List& values) const {
        Written list = Written::array();
        for (const JsonValue& value : values) {
            list.push_back(jsonOf(value));
        }
        return list;
    }
    Written operator()(const JsonValue::Object& members) const {
        Written object = Written::object();
        for (const auto& [key, value] : members) {
            object[key] = jsonOf(value);
        }
        return object;
    }
    Written operator()(const auto& scalar) const { return scalar; }
};

Written jsonOf(const JsonValue& value) {
    return std::visit(ToJson{}, value.value());
}

/// The double with the same shortest decimal digits as `value`.
double sameDigits(float value) {
    std::array<char, 32> digits{};
    const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    double number = std::numeric_limits<double>::quiet_NaN();
    std::from_chars(digits.data(), end, number);
    return number;
}

} // namespace

JsonValue::JsonValue(float value) : m_value(std::isfinite(value) ? sameDigits(value) : double{value}) {}

JsonValue& JsonValue::operator[](std::string_view key) {
    if (std::holds_alternative<std::monostate>(m_value)) {
        m_value = Object{};
    }
    auto& members = std::get<Object>(m_value);
    const auto found = std::ranges::find(members, key, &Member::first);
    return found != members.end() ? found->second
                                  : members.emplace_back(std::string(key), JsonValue()).second;
}

std::string JsonValue::text(int indent) const {
    return jsonOf(*this).dump(indent, ' ', false, Written::error_handler_t::replace);
}

} // namespace posewire::exporting
