// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/json.h"
#include "core/wire/layouts.h"
#include "core/wire/text.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <utility>

/// JSON values from layouts and back: one overload for each kind of field. Used by core/export only.
namespace posewire::exporting {

/// Keeps the order of keys and computes in 32-bit floats, so that a float is written with as few digits as
/// distinguish it from its neighbours.
using Json = nlohmann::basic_json<nlohmann::ordered_map, std::vector, std::string, bool, std::int64_t,
                                  std::uint64_t, float>;

/// Collects where reading went wrong, from the inside out.
struct FieldFault {
    std::string path;
    std::string text;

    bool fail(std::string what) {
        text = std::move(what);
        return false;
    }
    bool under(std::string_view key) {
        path = std::string(key) + (path.empty() || path.front() == '[' ? "" : ".") + path;
        return false;
    }
};

/// Of a text of tag lines, which is a list of [name, value] pairs.
inline constexpr const char* kTagsKey = "tags";

/// The length of what follows it is not in JSON: it is known from that.
inline bool isLength(const wire::About& about) {
    return about.unit == wire::Unit::ByteCount;
}

// Values to JSON.

inline Json jsonOf(float value) {
    if (std::isnan(value)) {
        return "NaN";
    }
    if (std::isinf(value)) {
        return value > 0 ? "Infinity" : "-Infinity";
    }
    return value;
}

template <std::size_t N>
Json jsonOf(const std::array<float, N>& values) {
    Json list = Json::array();
    for (const float value : values) {
        list.push_back(jsonOf(value));
    }
    return list;
}

/// Text that is not UTF-8 cannot be in JSON: each byte out of place becomes a question mark.
inline Json jsonOf(std::string text) {
    for (std::size_t bad = 0; (bad = wire::firstInvalidUtf8(text)) != text.size();) {
        text[bad] = '?';
    }
    return text;
}

template <std::size_t N>
Json jsonOf(const std::array<char, N>& characters) {
    return jsonOf(std::string(characters.data(), N));
}

Json jsonOf(std::integral auto value) {
    return value;
}

template <class T, wire::Form F>
Json objectOf(const T& value);

template <wire::Form F, class Item>
Json listOf(const std::vector<Item>& items) {
    Json list = Json::array();
    for (const Item& item : items) {
        list.push_back(objectOf<Item, F>(item));
    }
    return list;
}

inline Json tagsOf(const std::string& text) {
    Json tags = Json::array();
    for (const wire::Tag& tag : wire::parseTags(text).tags) {
        tags.push_back(Json::array({std::string(tag.name), std::string(tag.value)}));
    }
    return tags;
}

/// A message's or item's fields as an object.
template <class T, wire::Form F>
Json objectOf(const T& value) {
    Json object = Json::object();
    wire::forEachField<T, F>([&]<class FieldType>(const FieldType& field) {
        const auto& member = value.*FieldType::kMember;
        const std::string key(field.about.name);
        if constexpr (requires { FieldType::kItemForm; }) {
            object[key] = listOf<FieldType::kItemForm>(member);
        } else if constexpr (requires { FieldType::kKind; }) {
            const bool isTags = field.about.unit == wire::Unit::TagLines;
            object[isTags ? kTagsKey : key] = isTags ? tagsOf(member) : jsonOf(member);
        } else if (!isLength(field.about)) {
            object[key] = jsonOf(member);
        }
    });
    return object;
}

// JSON to values. False where it does not fit; the fault says where and what is needed.

inline bool readJson(const Json& json, float& value, FieldFault& fault) {
    if (json.is_number()) {
        value = json.get<float>();
        return true;
    }
    const auto* text = json.get_ptr<const std::string*>();
    if (text != nullptr && *text == "NaN") {
        value = std::numeric_limits<float>::quiet_NaN();
    } else if (text != nullptr && *text == "Infinity") {
        value = std::numeric_limits<float>::infinity();
    } else if (text != nullptr && *text == "-Infinity") {
        value = -std::numeric_limits<float>::infinity();
    } else {
        return fault.fail("needs a number, or \"NaN\", \"Infinity\" or \"-Infinity\"");
    }
    return true;
}

template <std::size_t N>
bool readJson(const Json& json, std::array<float, N>& values, FieldFault& fault) {
    if (!json.is_array() || json.size() != N) {
        return fault.fail("needs " + std::to_string(N) + " numbers in brackets");
    }
    for (std::size_t i = 0; i < N; ++i) {
        if (!readJson(json[i], values[i], fault)) {
            return fault.under("[" + std::to_string(i) + "]");
        }
    }
    return true;
}

inline bool readJson(const Json& json, std::string& text, FieldFault& fault) {
    const auto* string = json.get_ptr<const std::string*>();
    if (string == nullptr) {
        return fault.fail("needs a string");
    }
    text = *string;
    return true;
}

template <std::size_t N>
bool readJson(const Json& json, std::array<char, N>& characters, FieldFault& fault) {
    const auto* string = json.get_ptr<const std::string*>();
    if (string == nullptr || string->size() != N) {
        return fault.fail("needs a string of " + std::to_string(N) + " characters");
    }
    std::copy(string->begin(), string->end(), characters.begin());
    return true;
}

template <std::integral Integer>
bool readJson(const Json& json, Integer& value, FieldFault& fault) {
    using Limits = std::numeric_limits<Integer>;
    const bool isNumber = json.is_number_integer();
    const bool isBelow = isNumber && !json.is_number_unsigned();
    const bool fits = isBelow ? std::cmp_greater_equal(json.get<std::int64_t>(), Limits::min())
                              : isNumber && std::cmp_less_equal(json.get<std::uint64_t>(), Limits::max());
    if (!fits) {
        return fault.fail("needs a whole number from " + std::to_string(Limits::min()) + " to " +
                          std::to_string(Limits::max()));
    }
    value = json.get<Integer>();
    return true;
}

inline bool readJson(const Json& json, bool& value, FieldFault& fault) {
    if (!json.is_boolean()) {
        return fault.fail("needs true or false");
    }
    value = json.get<bool>();
    return true;
}

/// Reads a member of an object that must be there.
template <class Value>
bool readMember(const Json& object, std::string_view key, Value& value, FieldFault& fault) {
    const auto found = object.find(std::string(key));
    const bool isThere = found != object.end();
    const bool isRead = isThere ? readJson(*found, value, fault) : fault.fail("is missing");
    return isRead || fault.under(key);
}

template <class T, wire::Form F>
bool readObject(const Json& json, T& value, FieldFault& fault);

template <wire::Form F, class Item>
bool readList(const Json& object, std::string_view key, std::vector<Item>& items, FieldFault& fault) {
    const auto list = object.find(std::string(key));
    if (list == object.end() || !list->is_array()) {
        return fault.fail("needs a list") || fault.under(key);
    }
    items.resize(list->size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (!readObject<Item, F>((*list)[i], items[i], fault)) {
            return fault.under("[" + std::to_string(i) + "]") || fault.under(key);
        }
    }
    return true;
}

inline bool readTags(const Json& object, std::string& into, FieldFault& fault) {
    const auto tags = object.find(kTagsKey);
    bool isList = tags != object.end() && tags->is_array();
    std::string text;
    for (std::size_t i = 0; isList && i < tags->size(); ++i) {
        const Json& tag = (*tags)[i];
        isList = tag.is_array() && tag.size() == 2 && tag[0].is_string() && tag[1].is_string();
        if (isList) {
            text += tag[0].get<std::string>() + ':' + tag[1].get<std::string>() + '\n';
        }
    }
    into = std::move(text);
    return isList || fault.fail("needs a list of [name, value] pairs") || fault.under(kTagsKey);
}

/// Reads a message's or item's fields from an object.
template <class T, wire::Form F>
bool readObject(const Json& json, T& value, FieldFault& fault) {
    if (!json.is_object()) {
        return fault.fail("needs an object in braces");
    }
    const auto read = [&]<class FieldType>(const FieldType& field) {
        auto& member = value.*FieldType::kMember;
        if constexpr (requires { FieldType::kItemForm; }) {
            return readList<FieldType::kItemForm>(json, field.about.name, member, fault);
        } else if constexpr (requires { FieldType::kKind; }) {
            return field.about.unit == wire::Unit::TagLines
                       ? readTags(json, member, fault)
                       : readMember(json, field.about.name, member, fault);
        } else {
            return isLength(field.about) || readMember(json, field.about.name, member, fault);
        }
    };
    bool isRead = true;
    wire::forEachField<T, F>([&](const auto& field) { isRead = isRead && read(field); });
    return isRead;
}

/// The bytes of the datagram that an object stands for.
[[nodiscard]] tl::expected<std::vector<std::byte>, JsonFault> datagramFromObject(const Json& object);

} // namespace posewire::exporting
