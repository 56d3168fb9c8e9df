// SPDX-License-Identifier: MIT
#pragma once

#include "core/words/say.h"

#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

/// Facts as tests look at them: by kinds and numbers. How they read is held by the golden text of core/words.
namespace posewire::words {

inline std::ostream& operator<<(std::ostream& out, const Fact& fact) {
    return out << say(fact, Form::Headline);
}

/// A part of a fact; Nothing if it has none of that name.
inline Fact partOf(const Fact& fact, std::string_view name) {
    const Value* value = find(fact, name);
    const Fact* part = value == nullptr ? nullptr : std::get_if<Fact>(value);
    return part == nullptr ? Fact() : *part;
}

/// A number or a count; nothing if the fact has none of that name.
inline std::optional<double> numberIn(const Fact& fact, std::string_view name) {
    const Value* value = find(fact, name);
    if (value == nullptr) {
        return std::nullopt;
    }
    const auto* count = std::get_if<std::uint64_t>(value);
    const auto* number = std::get_if<Number>(value);
    return count != nullptr    ? std::optional(static_cast<double>(*count))
           : number != nullptr ? std::optional(number->value)
                               : std::nullopt;
}

/// Names, parts in words, or what is said in their place: "4 characters", "Ana of 192.0.2.1:4000".
inline std::vector<std::string> namesIn(const Fact& fact, std::string_view name) {
    const Value* value = find(fact, name);
    if (value == nullptr) {
        return {};
    }
    if (const auto* names = std::get_if<std::vector<std::string>>(value)) {
        return *names;
    }
    if (const auto* parts = std::get_if<std::vector<Fact>>(value)) {
        std::vector<std::string> names;
        for (const Fact& part : *parts) {
            names.push_back(say(part, Form::Headline));
        }
        return names;
    }
    const auto* text = std::get_if<std::string>(value);
    return {text != nullptr ? *text : say(partOf(fact, name), Form::Headline)};
}

/// What incidents say: what happened, to whom, how much was lost in which unit, and why.
struct Told {
    Kind kind{};
    std::vector<std::string> who{};
    Kind unit{};
    double amount = 0;
    Kind cause{};
};
inline Told toldIn(const Fact& fact) {
    const Fact amount = partOf(partOf(fact, "amount"), "n");
    return {fact.kind, namesIn(fact, "who"), amount.kind, numberIn(amount, "n").value_or(0),
            partOf(fact, "cause").kind};
}

} // namespace posewire::words
