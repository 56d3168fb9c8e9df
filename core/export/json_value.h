// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace posewire::exporting {

/// A JSON document as exports build it; keys keep their order. The library that writes it is behind
/// json_value.cpp alone.
class JsonValue {
public:
    using Member = std::pair<std::string, JsonValue>;
    using List = std::vector<JsonValue>;
    using Object = std::vector<Member>;

    JsonValue() = default; ///< null
    JsonValue(std::same_as<bool> auto value) : m_value(value) {}
    JsonValue(std::signed_integral auto value) : m_value(std::int64_t{value}) {}
    template <std::unsigned_integral T>
    requires(!std::same_as<T, bool>) JsonValue(T value) : m_value(std::uint64_t{value}) {}
    /// Written with as few digits as distinguish it from its neighbours of the same type; null if not finite.
    JsonValue(float value);
    JsonValue(double value) : m_value(value) {}
    /// Bytes that are not UTF-8 are written as U+FFFD.
    JsonValue(std::string value) : m_value(std::move(value)) {}
    JsonValue(std::string_view value) : m_value(std::string(value)) {}
    JsonValue(const char* value) : m_value(std::string(value)) {}
    JsonValue(List values) : m_value(std::move(values)) {}
    /// An object.
    JsonValue(std::initializer_list<Member> members) : m_value(Object(members)) {}

    /// The member of that name of an object, added where there is none; null becomes an object.
    JsonValue& operator[](std::string_view key);

    /// One line, or indented by this many spaces per level.
    [[nodiscard]] std::string text(int indent = -1) const;

    [[nodiscard]] const auto& value() const { return m_value; }

private:
    std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string, List, Object>
        m_value;
};

template <class Item, class ToJson>
JsonValue listOf(const std::vector<Item>& items, ToJson toJson) {
    JsonValue::List list;
    std::ranges::transform(items, std::back_inserter(list), toJson);
    return list;
}

} // namespace posewire::exporting
