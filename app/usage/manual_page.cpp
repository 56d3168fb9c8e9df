// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/usage/usage.h"

#include <algorithm>
#include <iterator>

namespace posewire::usage {
namespace {

/// As text of a line: roff takes nothing in it for a request or an escape, and a minus can be copied as one.
std::string plain(std::string_view text) {
    std::string out;
    if (text.starts_with('.') || text.starts_with('\'')) {
        out += "\\&";
    }
    for (const char c : text) {
        switch (c) {
        case '\\':
            out += "\\e";
            break;
        case '-':
            out += "\\-";
            break;
        case '"':
            out += "\\(dq";
            break;
        default:
            out += c;
        }
    }
    return out;
}

std::string bold(std::string_view text) {
    return "\\fB" + plain(text) + "\\fR";
}

std::string italic(std::string_view text) {
    return "\\fI" + plain(text) + "\\fR";
}

/// What is typed as it stands is bold, what stands for something italic.
std::string formText(const Option& option) {
    const bool hasChoices = !choicesOf(option).empty();
    std::vector<std::string> parts;
    for (const std::string& alternative : alternativesOf(option)) {
        parts.push_back(hasChoices && !isPlaceholder(alternative) ? bold(alternative) : italic(alternative));
    }
    return joined(parts, "|");
}

std::string nameList(const std::vector<std::string>& names) {
    std::vector<std::string> parts;
    std::ranges::transform(names, std::back_inserter(parts), [](const std::string& name) {
        return name.starts_with('-') ? bold(name) : italic(name);
    });
    return joined(parts, ", ");
}

/// With a capital and a stop.
std::string sentence(std::string text) {
    if (text.empty()) {
        return text;
    }
    if (text.front() >= 'a' && text.front() <= 'z') {
        text.front() = static_cast<char>(text.front() - 'a' + 'A');
    }
    return text.ends_with('.') ? text : text + '.';
}

std::string entry(const Option& option) {
    std::string text = ".TP\n" + nameList(option.names);
    if (!option.form.empty()) {
        text += (isArgument(option) ? "" : " ") + formText(option);
    }
    text += '\n' + plain(sentence(option.text));
    if (!option.range.empty()) {
        text += " From " + plain(option.range) + '.';
    }
    if (!option.usual.empty()) {
        text += " Default: " + bold(option.usual) + '.';
    }
    if (!option.needs.empty()) {
        text += " Needs " + nameList(option.needs) + '.';
    }
    if (!option.excludes.empty()) {
        text += " Not together with " + nameList(option.excludes) + '.';
    }
    return text + '\n';
}

/// Arguments first; then options under their headings, in the order in which they were declared.
std::string entries(std::vector<Option> options) {
    std::stable_partition(options.begin(), options.end(), isArgument);
    std::string text;
    std::string group;
    for (const Option& option : options) {
        if (option.group != group) {
            group = option.group;
            text += group.empty() ? "" : ".PP\n" + plain(group) + ":\n";
        }
        text += entry(option);
    }
    return text;
}

std::string argumentText(const Option& option) {
    const std::string name = italic(option.form) + (option.isRepeatable ? "..." : "");
    return option.isRequired ? ' ' + name : " [" + name + ']';
}

std::string synopsisLine(const std::string& name, const std::vector<Option>& options) {
    std::string text = bold(name) + " [" + italic("OPTION") + "]...";
    for (const Option& option : options) {
        if (isArgument(option)) {
            text += argumentText(option);
        } else if (option.isRequired) {
            text += ' ' + bold(option.names.back()) + ' ' + formText(option);
        }
    }
    return text + '\n';
}

std::string synopsis(const Program& program) {
    if (program.commands.empty()) {
        return synopsisLine(program.name, program.options);
    }
    std::string text;
    for (const Command& command : program.commands) {
        text += text.empty() ? "" : ".br\n";
        text += synopsisLine(program.name + ' ' + command.name, command.options);
    }
    return text;
}

std::string commandSections(const std::vector<Command>& commands) {
    std::string text;
    for (const Command& command : commands) {
        text += ".SS " + plain(command.name) + '\n' + plain(sentence(command.text)) + '\n' +
                entries(command.options);
    }
    return text;
}

} // namespace

tl::expected<std::string, std::string> manualPage(const Program& program, std::string_view frame,
                                                  const PageFacts& facts) {
    std::vector<std::pair<std::string, std::string>> parts{{"@VERSION@", facts.version},
                                                           {"@DATE@", facts.date},
                                                           {"@SYNOPSIS@\n", synopsis(program)},
                                                           {"@OPTIONS@\n", entries(program.options)}};
    if (!program.commands.empty()) {
        parts.emplace_back("@COMMANDS@\n", commandSections(program.commands));
    }
    std::string page(frame);
    for (const auto& [mark, text] : parts) {
        const std::size_t place = page.find(mark);
        if (place == std::string::npos) {
            return tl::unexpected("no " + mark.substr(0, mark.rfind('@') + 1) + " in the frame");
        }
        page.replace(place, mark.size(), text);
    }
    return page;
}

} // namespace posewire::usage
