// SPDX-License-Identifier: MIT
#include "core/words/fact.h"

#include "core/model/text.h"

#include <algorithm>

namespace posewire::words {

bool operator==(const Fact& one, const Fact& other) {
    return one.kind == other.kind && one.values == other.values;
}

const Value* find(const Fact& fact, std::string_view name) {
    const auto found = std::ranges::find(fact.values, name, &NamedValue::name);
    return found == fact.values.end() ? nullptr : &found->value;
}

void set(Fact& fact, std::string_view name, Value value) {
    const auto found = std::ranges::find(fact.values, name, &NamedValue::name);
    if (found != fact.values.end()) {
        found->value = std::move(value);
    } else {
        fact.values.push_back({name, std::move(value)});
    }
}

void add(Fact& fact, std::string_view name, Value value) {
    if (find(fact, name) == nullptr) {
        fact.values.push_back({name, std::move(value)});
    }
}

void clip(Fact& fact, std::size_t most) {
    for (NamedValue& each : fact.values) {
        if (auto* text = std::get_if<std::string>(&each.value)) {
            *text = model::clippedText(std::move(*text), most);
        } else if (auto* part = std::get_if<Fact>(&each.value)) {
            clip(*part, most);
        } else if (auto* parts = std::get_if<std::vector<Fact>>(&each.value)) {
            const std::uint64_t left = parts->size() > kMostListed ? parts->size() - (kMostListed - 1) : 0;
            parts->resize(parts->size() - left);
            parts->shrink_to_fit();
            for (Fact& one : *parts) {
                clip(one, most / (3 * parts->size()));
            }
            if (left != 0) {
                each.value = Fact{Kind::NamesAndMore, {{"names", std::move(*parts)}, {"n", left}}};
            }
        }
    }
}

std::size_t memoryBytes(const Fact& fact) {
    std::size_t bytes = fact.values.capacity() * sizeof(NamedValue);
    for (const NamedValue& each : fact.values) {
        if (const auto* text = std::get_if<std::string>(&each.value)) {
            bytes += text->capacity();
        } else if (const auto* part = std::get_if<Fact>(&each.value)) {
            bytes += memoryBytes(*part);
        } else if (const auto* parts = std::get_if<std::vector<Fact>>(&each.value)) {
            bytes += parts->capacity() * sizeof(Fact);
            for (const Fact& one : *parts) {
                bytes += memoryBytes(one);
            }
        } else if (const auto* names = std::get_if<std::vector<std::string>>(&each.value)) {
            bytes += names->capacity() * sizeof(std::string);
        }
    }
    return bytes;
}

Fact sharedFact(std::uint8_t datagrams) {
    constexpr std::uint8_t kMost = 7; // more are not counted
    const std::string count = std::to_string(datagrams) + (datagrams < kMost ? "" : " or more");
    return {Kind::SharedPacket, {{"n", count}}};
}

Fact typesFact(const std::vector<std::uint8_t>& types) {
    std::vector<std::string> digits;
    for (const std::uint8_t type : types) {
        digits.push_back(model::padded(type, 2));
    }
    return {Kind::Types, {{"types", std::move(digits)}}};
}

} // namespace posewire::words
