// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/usage/completion.h"

#include <algorithm>

namespace posewire::usage {
namespace {

std::string fishQuoted(std::string_view text) {
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') {
            out += '\\';
        }
        out += c;
    }
    return out + '\'';
}

/// ` -s o -l output`
std::string fishNamesOf(const Option& option) {
    std::string text;
    for (const std::string& name : option.names) {
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    return text;
}

/// What may follow the option: a value (-r), and files (-F) or not (-f).
std::string fishValueOf(const Option& option) {
    std::string text = !needsValue(option) ? "" : takesFile(option) ? " -r -F" : " -r -f";
    if (const std::vector<std::string> choices = choicesOf(option); !choices.empty()) {
        text += " -a " + fishQuoted(joined(choices, " "));
    }
    return text;
}

/// One line for each option; `start` ends with the condition.
std::string optionLines(const std::string& start, const std::vector<Option>& options) {
    std::string text;
    for (const Option& option : options) {
        if (!isArgument(option)) {
            text += start + fishNamesOf(option) + fishValueOf(option) + " -d " +
                    fishQuoted(shortText(option.text)) + '\n';
        }
    }
    return text;
}

/// Files are offered unless told otherwise.
std::string filesLine(const std::string& start, const std::vector<Option>& options) {
    const bool takesFiles = std::ranges::any_of(
        options, [](const Option& option) { return isArgument(option) && takesFile(option); });
    return start + (takesFiles ? " -F\n" : " -f\n");
}

} // namespace

std::string fishCompletion(const Program& program) {
    const std::string start = "complete -c " + program.name;
    std::string text = "# fish completion for " + program.name + ", made from its options\n";
    if (program.commands.empty()) {
        return text + filesLine(start, program.options) + optionLines(start, program.options);
    }
    const std::string first = start + " -n __fish_use_subcommand";
    text += first + " -f\n" + optionLines(first, program.options);
    for (const Command& command : program.commands) {
        const std::string then = start + " -n " + fishQuoted("__fish_seen_subcommand_from " + command.name);
        text += first + " -a " + command.name + " -d " + fishQuoted(shortText(command.text)) + '\n';
        text += filesLine(then, command.options) + optionLines(then, command.options);
    }
    return text;
}

} // namespace posewire::usage
