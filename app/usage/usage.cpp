// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/usage/usage.h"

#include <algorithm>

namespace posewire::usage {
namespace {

bool isCapital(char c) {
    return c >= 'A' && c <= 'Z';
}

} // namespace

std::string_view version() {
    return POSEWIRE_VERSION;
}

bool isArgument(const Option& option) {
    return option.names.empty();
}

bool needsValue(const Option& option) {
    const std::string& form = option.form;
    const bool isBracketed = form.starts_with('[') && form.find(']') == form.size() - 1;
    return !form.empty() && !isBracketed;
}

std::vector<std::string> alternativesOf(const Option& option) {
    std::vector<std::string> alternatives;
    std::string_view left = option.form;
    while (!left.empty()) {
        const std::size_t end = std::min(left.find('|'), left.size());
        alternatives.emplace_back(left.substr(0, end));
        left.remove_prefix(std::min(end + 1, left.size()));
    }
    return alternatives;
}

bool isPlaceholder(std::string_view alternative) {
    return alternative.size() > 1 && isCapital(alternative[0]) && isCapital(alternative[1]);
}

std::vector<std::string> choicesOf(const Option& option) {
    std::vector<std::string> choices = alternativesOf(option);
    if (choices.size() < 2) {
        return {};
    }
    std::erase_if(choices, isPlaceholder);
    return choices;
}

bool takesFile(const Option& option) {
    return std::ranges::any_of(alternativesOf(option), [](const std::string& alternative) {
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

} // namespace posewire::usage
