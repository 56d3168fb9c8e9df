// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/usage/usage.h"

#include <algorithm>
#include <iterator>

namespace posewire::usage {
namespace {

constexpr std::string_view kFiles =
    "compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- \"$word\")";

std::string words(const std::vector<std::string>& list) {
    return "mapfile -t COMPREPLY < <(compgen -W '" + joined(list, " ") + "' -- \"$word\")";
}

/// What completes the value of an option: its choices, else files, else nothing.
std::string valueAction(const Option& option) {
    const std::vector<std::string> choices = choicesOf(option);
    const std::string files = takesFile(option) ? std::string(kFiles) + "; " : "";
    if (!choices.empty() && files.empty()) {
        return words(choices) + "; ";
    }
    if (!choices.empty()) {
        return files + "mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -W '" + joined(choices, " ") +
               "' -- \"$word\"); ";
    }
    return files;
}

/// Of the program itself (`command` empty) or of one command.
std::string valueCases(const std::string& command, const std::vector<Option>& options) {
    std::string text;
    for (const Option& option : options) {
        if (isArgument(option) || !needsValue(option)) {
            continue;
        }
        std::vector<std::string> patterns;
        std::ranges::transform(option.names, std::back_inserter(patterns), [&](const std::string& name) {
            std::string pattern = command;
            pattern.append(":").append(name);
            return pattern;
        });
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

bool takesFileArgument(const std::vector<Option>& options) {
    return std::ranges::any_of(options,
                               [](const Option& option) { return isArgument(option) && takesFile(option); });
}

std::string argumentCase(const std::string& command, const std::vector<Option>& options) {
    return takesFileArgument(options) ? "        '" + command + "') " + std::string(kFiles) + " ;;\n" : "";
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

} // namespace posewire::usage
