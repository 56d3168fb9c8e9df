// SPDX-License-Identifier: MIT
#pragma once

#include "core/words/fact.h"

#include <cstdint>
#include <span>
#include <string>

/// Facts in words.
namespace posewire::words {

enum class Form : std::uint8_t {
    Headline, ///< what, to whom and why, without a stop
    Sentence, ///< with its stop and what it rests on, without whom
    Narrow,   ///< of a verdict: a headline with its end first, if that may have no room
    Line,     ///< beside columns that say whom and why
    Brief,    ///< a few words, with the cause
    Cell,     ///< without the cause
    Advice,   ///< what follows from it, and what to do
};
inline constexpr std::size_t kForms = 7;

/// A text of the table: the source string of a translation, and its singular if it has one. The number is
/// that of the first placeholder: a count, or the size of a list.
///
/// "{name}" is the value of that name, a part in the form of the whole. "[… {name} …|…]" is the first of
/// these alternatives whose values are all there, or nothing.
struct Text {
    const char* text = nullptr;
    const char* one = nullptr;
};

/// All that is said of one kind. Without a text a sentence and a narrow one are the headline, a line is the
/// sentence, a brief the headline, a cell the brief.
struct Wording {
    Kind kind{};
    Text headline{};
    Text sentence{};
    Text line{};
    Text brief{};
    Text cell{};
    Text narrow{};
    Text advice{};
};
/// By kind: what catalogues of other languages are made from.
[[nodiscard]] std::span<const Wording> wordings();
/// The rows of findings.cpp, which are the last ones of wordings().
[[nodiscard]] std::span<const Wording> findingWordings();

/// The text for a number in one language.
using Language = std::string (*)(const Text& text, std::uint64_t number);
[[nodiscard]] std::string english(const Text& text, std::uint64_t number);

/// With numbers, plurals and lists of names: the one place that makes text of a fact.
[[nodiscard]] std::string say(const Fact& fact, Form form, Language language = english);

} // namespace posewire::words
