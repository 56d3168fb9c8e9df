// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/usage/usage.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace posewire::usage {

namespace {

bool isCapital(char c) {
    return c >= 'A' && c <= 'Z';
}

/// Tells placeholders, such as FILE, from alternatives that are typed as they are.
bool isPlaceholder(std::string_view alternative) {
    return alternative.size() > 1 && isCapital(alternative[0]) && isCapital(alternative[1]);
}

/// Letters to insert, remove or replace until one word is the other.
std::size_t distanceOf(std::string_view one, std::string_view other) {
    std::vector<std::size_t> row(other.size() + 1); // from what `one` has so far to each beginning of `other`
    std::iota(row.begin(), row.end(), 0U);
    for (const char letter : one) {
        std::size_t corner = std::exchange(row[0], row[0] + 1);
        for (std::size_t i = 1; i < row.size(); ++i) {
            const std::size_t replaced = corner + (letter != other[i - 1] ? 1 : 0);
            corner = std::exchange(row[i], std::min({replaced, row[i] + 1, row[i - 1] + 1}));
        }
    }
    return row.back();
}

} // namespace

bool isArgument(const Option& option) {
    return option.names.empty();
}

bool needsValue(const Option& option) {
    const std::string& form = option.form;
    const bool isBracketed = form.starts_with('[') && form.find(']') == form.size() - 1;
    return !form.empty() && !isBracketed;
}

std::vector<std::string> alternativesOf(std::string_view form) {
    std::vector<std::string> alternatives;
    while (!form.empty()) {
        const std::size_t end = std::min(form.find('|'), form.size());
        alternatives.emplace_back(form.substr(0, end));
        form.remove_prefix(std::min(end + 1, form.size()));
    }
    return alternatives;
}

std::vector<std::string> choicesOf(const Option& option) {
    std::vector<std::string> choices = alternativesOf(option.form);
    if (choices.size() < 2) {
        return {};
    }
    std::erase_if(choices, isPlaceholder);
    return choices;
}

bool takesFile(const Option& option) {
    return std::ranges::any_of(alternativesOf(option.form), [](const std::string& alternative) {
        return alternative == "FILE" || alternative.starts_with("FILE.");
    });
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
    std::string text;
    for (const std::string& word : words) {
        text.append(text.empty() ? "" : separator).append(word);
    }
    return text;
}

std::string nearest(std::string_view word, const std::vector<std::string>& known) {
    std::string best;
    std::size_t least = (word.size() + 1) / 3 + 1;
    for (const std::string& one : known) {
        if (const std::size_t distance = distanceOf(word, one); distance < least) {
            best = one;
            least = distance;
        }
    }
    return best;
}

} // namespace posewire::usage
