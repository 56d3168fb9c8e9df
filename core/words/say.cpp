// SPDX-License-Identifier: MIT
#include "core/words/say.h"

#include "core/model/text.h"

#include <algorithm>
#include <string_view>

namespace posewire::words {
namespace {

const Text& textOf(const Wording& row, Form form) {
    const auto either = [](const Text& text, const Text& other) -> const Text& {
        return text.text != nullptr ? text : other;
    };
    switch (form) {
    case Form::Headline:
        break;
    case Form::Sentence:
        return either(row.sentence, row.headline);
    case Form::Narrow:
        return either(row.narrow, row.headline);
    case Form::Line:
        return either(row.line, either(row.sentence, row.headline));
    case Form::Brief:
        return either(row.brief, row.headline);
    case Form::Cell:
        return either(row.cell, either(row.brief, row.headline));
    case Form::Advice:
        return row.advice;
    }
    return row.headline;
}

const Wording& rowOf(Kind kind) {
    return wordings()[static_cast<std::size_t>(kind)];
}

/// The first value of a text that the fact has; null if it has none.
const Value* firstOf(const Fact& fact, std::string_view text) {
    for (std::size_t at = text.find('{'); at != std::string_view::npos; at = text.find('{', at + 1)) {
        if (const Value* value = find(fact, text.substr(at + 1, text.find('}', at) - at - 1))) {
            return value;
        }
    }
    return nullptr;
}

std::uint64_t numberOf(const Fact& fact, std::string_view text);

struct NumberOf {
    std::uint64_t operator()(const std::string& /*name*/) const { return 1; }
    std::uint64_t operator()(std::uint64_t count) const { return count; }
    std::uint64_t operator()(const Number& number) const { return number.value == 1 ? 1 : 2; }
    template <class Part>
    std::uint64_t operator()(const std::vector<Part>& parts) const {
        return parts.size();
    }
    std::uint64_t operator()(const Fact& part) const {
        const char* text = rowOf(part.kind).headline.text;
        return text == nullptr ? 1 : numberOf(part, text);
    }
};

std::uint64_t numberOf(const Fact& fact, std::string_view text) {
    const Value* first = firstOf(fact, text);
    return first == nullptr ? 1 : std::visit(NumberOf(), *first);
}

std::string numberText(const Number& number) {
    std::string text = model::fixedText(number.value, number.decimals);
    if (number.isTrimmed && text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        text.erase(text.find_last_not_of('.') + 1);
    }
    return text;
}

/// One fact in one form.
struct Phrase {
    const Fact& fact;
    Form form;
    Language language;

    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(std::uint64_t count) const { return model::grouped(count); }
    std::string operator()(const Number& number) const { return numberText(number); }
    std::string operator()(const std::vector<std::string>& names) const;
    /// Advice on a part that has some, else what it is.
    std::string operator()(const Fact& part) const {
        const bool isBare = form == Form::Advice && rowOf(part.kind).advice.text == nullptr;
        return say(part, isBare ? Form::Headline : form, language);
    }
    std::string operator()(const std::vector<Fact>& parts) const {
        std::vector<std::string> names;
        std::ranges::transform(parts, std::back_inserter(names), *this);
        return (*this)(names);
    }

    [[nodiscard]] std::string whole(std::string_view text) const {
        std::string said;
        while (!text.empty()) {
            const std::size_t open = std::min(text.find('['), text.size());
            fill(text.substr(0, open), said);
            text.remove_prefix(open);
            if (!text.empty()) {
                const std::size_t close = text.find(']');
                said += firstWhole(text.substr(1, close - 1));
                text.remove_prefix(close + 1);
            }
        }
        return said;
    }

    /// The first of several alternatives whose values are all there.
    [[nodiscard]] std::string firstWhole(std::string_view group) const {
        while (true) {
            const std::size_t bar = std::min(group.find('|'), group.size());
            if (std::string said; fill(group.substr(0, bar), said)) {
                return said;
            }
            if (bar == group.size()) {
                return {};
            }
            group.remove_prefix(bar + 1);
        }
    }

    /// Appends a text with its values. False if one is missing, or says nothing.
    bool fill(std::string_view text, std::string& said) const {
        bool isWhole = true;
        while (!text.empty()) {
            const std::size_t open = std::min(text.find('{'), text.size());
            said += text.substr(0, open);
            text.remove_prefix(open);
            if (!text.empty()) {
                const std::size_t close = text.find('}');
                const Value* value = find(fact, text.substr(1, close - 1));
                const std::string part = value == nullptr ? std::string() : std::visit(*this, *value);
                isWhole = isWhole && !part.empty();
                said += part;
                text.remove_prefix(close + 1);
            }
        }
        return isWhole;
    }
};

/// "a, b and c"; beyond four "a, b, c and 7 more", of which clip() has left "a, b, c".
std::string Phrase::operator()(const std::vector<std::string>& names) const {
    const bool isClipped = fact.kind == Kind::NamesAndMore;
    const std::size_t first = isClipped                    ? names.size()
                              : names.size() > kMostListed ? kMostListed - 1
                                                           : std::max<std::size_t>(names.size(), 1) - 1;
    std::string joined;
    for (std::size_t i = 0; i < first; ++i) {
        joined += (i == 0 ? "" : ", ") + names[i];
    }
    if (isClipped) {
        return joined;
    }
    if (first == 0) {
        return names.empty() ? joined : names.front();
    }
    const std::size_t left = names.size() - first;
    return left > 1
               ? say({Kind::NamesAndMore, {{"names", joined}, {"n", std::uint64_t{left}}}}, form, language)
               : say({Kind::NamesAndLast, {{"names", joined}, {"last", names.back()}}}, form, language);
}

} // namespace

std::string english(const Text& text, std::uint64_t number) {
    return number == 1 && text.one != nullptr ? text.one : text.text;
}

std::string say(const Fact& fact, Form form, Language language) {
    const Text& text = textOf(rowOf(fact.kind), form);
    return text.text == nullptr
               ? std::string()
               : Phrase{fact, form, language}.whole(language(text, numberOf(fact, text.text)));
}

} // namespace posewire::words
