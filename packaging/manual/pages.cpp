// SPDX-License-Identifier: GPL-3.0-or-later
#include "packaging/manual/pages.h"

#include <algorithm>
#include <iterator>

namespace posewire::manual {

using usage::alternativesOf;
using usage::choicesOf;
using usage::Command;
using usage::isArgument;
using usage::joined;
using usage::needsValue;
using usage::Option;
using usage::Program;
using usage::takesFile;

namespace {

constexpr std::string_view kFiles =
    "compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- \"$word\")";

std::string words(const std::vector<std::string>& list, const std::string& place = "") {
    return "mapfile -t " + place + "COMPREPLY < <(compgen -W '" + joined(list, " ") + "' -- \"$word\")";
}

/// The commands that complete the value of an option: from its choices, from file names, or not at all.
std::string valueAction(const Option& option) {
    const std::vector<std::string> choices = choicesOf(option);
    const std::string files = takesFile(option) ? std::string(kFiles) + "; " : "";
    const std::string place = files.empty() ? "" : "-O ${#COMPREPLY[@]} ";
    return choices.empty() ? files : files + words(choices, place) + "; ";
}

/// Of the program itself (`command` empty) or of one command.
std::string valueCases(const std::string& command, const std::vector<Option>& options) {
    std::string text;
    for (const Option& option : options) {
        if (isArgument(option) || !needsValue(option)) {
            continue;
        }
        std::vector<std::string> patterns;
        for (const std::string& name : option.names) {
            patterns.push_back(command + ':' + name);
        }
        text += "        " + joined(patterns, "|") + ") " + valueAction(option) + "return ;;\n";
    }
    return text;
}

std::string optionCase(const std::string& command, const std::vector<Option>& options) {
    std::vector<std::string> names;
    for (const Option& option : options) {
        names.insert(names.end(), option.names.begin(), option.names.end());
    }
    return "            '" + command + "') " + words(names) + " ;;\n";
}

std::string argumentCase(const std::string& command, const std::vector<Option>& options) {
    const bool takesOne = std::ranges::any_of(
        options, [](const Option& option) { return isArgument(option) && takesFile(option); });
    return takesOne ? "        '" + command + "') " + std::string(kFiles) + " ;;\n" : "";
}

std::vector<std::string> namesOf(const std::vector<Command>& commands) {
    std::vector<std::string> names;
    std::ranges::transform(commands, std::back_inserter(names), &Command::name);
    return names;
}

std::string findCommand(const std::vector<Command>& commands) {
    if (commands.empty()) {
        return {};
    }
    return "    local i\n"
           "    for ((i = 1; i < COMP_CWORD; ++i)); do\n"
           "        case ${COMP_WORDS[i]} in\n"
           "            " +
           joined(namesOf(commands), "|") +
           ") command=${COMP_WORDS[i]}; break ;;\n"
           "        esac\n"
           "    done\n";
}

} // namespace

std::string bashCompletion(const Program& program) {
    std::string values = valueCases("", program.options);
    std::string options = optionCase("", program.options);
    std::string arguments = program.commands.empty()
                                ? argumentCase("", program.options)
                                : "        '') " + words(namesOf(program.commands)) + " ;;\n";
    for (const Command& command : program.commands) {
        values += valueCases(command.name, command.options);
        options += optionCase(command.name, command.options);
        arguments += argumentCase(command.name, command.options);
    }
    std::string function = '_' + program.name;
    std::replace(function.begin(), function.end(), '-', '_');
    return "# bash completion for " + program.name + ", made from its options\n" + function +
           "() {\n"
           "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=\n"
           "    COMPREPLY=()\n"
           "    # --option=value comes as three words\n"
           "    if [[ $word == '=' ]]; then\n"
           "        word=\n"
           "    elif [[ $before == '=' ]]; then\n"
           "        before=${COMP_WORDS[COMP_CWORD-2]}\n"
           "    fi\n" +
           findCommand(program.commands) + "    case $command:$before in\n" + values +
           "    esac\n"
           "    if [[ $word == -* ]]; then\n"
           "        case $command in\n" +
           options +
           "        esac\n"
           "        return\n"
           "    fi\n"
           "    case $command in\n" +
           arguments +
           "    esac\n"
           "}\n"
           "complete -F " +
           function + ' ' + program.name + '\n';
}

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

/// Literal words are bold, placeholders italic.
std::string formText(const Option& option) {
    const std::vector<std::string> choices = choicesOf(option);
    std::vector<std::string> parts;
    for (const std::string& alternative : alternativesOf(option.form)) {
        const bool isTyped = std::ranges::find(choices, alternative) != choices.end();
        parts.push_back(isTyped ? bold(alternative) : italic(alternative));
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

} // namespace posewire::manual
