// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/usage/completion.h"

#include <algorithm>

namespace posewire::usage {
namespace {

/// In single quotes, as they stand in a script.
std::string zshQuoted(std::string_view text) {
    std::string out = "'";
    for (const char c : text) {
        out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return out + '\'';
}

/// With a backslash before what divides the parts of a specification.
std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == ':' || c == '[' || c == ']' || c == '\\') {
            out += '\\';
        }
        out += c;
    }
    return out;
}

/// `:FILE:_files`, `:E|J:(E J)`, `:SECONDS: `: what is asked for, and what completes it.
std::string zshValueOf(const Option& option) {
    const std::vector<std::string> choices = choicesOf(option);
    const std::string title = ':' + escaped(option.form) + ':';
    const std::string list = '(' + joined(choices, " ") + ')';
    if (!choices.empty() && takesFile(option)) {
        // A colon would begin the next value.
        return title + "{_alternative " + zshQuoted("choices\\:choice\\:" + list) + ' ' +
               zshQuoted("files\\:file\\:_files") + '}';
    }
    return title + (!choices.empty() ? list : takesFile(option) ? "_files" : " ");
}

/// One line for each of its names.
std::string specifications(const Option& option, const std::string& indent) {
    std::string text;
    std::vector<std::string> others = option.excludes;
    others.insert(others.end(), option.names.begin(), option.names.end());
    std::erase_if(others, [](const std::string& name) { return !name.starts_with('-'); });
    for (const std::string& name : option.names) {
        std::string line = option.isRepeatable ? "*" : '(' + joined(others, " ") + ')';
        line += name;
        line += option.form.empty() ? "" : name.starts_with("--") ? "=" : "+";
        line += '[' + escaped(shortText(option.text)) + ']';
        if (!option.form.empty()) {
            line += (needsValue(option) ? "" : ":") + zshValueOf(option);
        }
        text += indent + zshQuoted(line) + " \\\n";
    }
    if (isArgument(option)) {
        text +=
            indent + zshQuoted(option.isRepeatable ? "*" + zshValueOf(option) : zshValueOf(option)) + " \\\n";
    }
    return text;
}

std::string arguments(const std::string& start, const std::vector<Option>& options,
                      const std::string& indent) {
    std::string text = indent + start + " \\\n";
    for (const Option& option : options) {
        text += specifications(option, indent + "    ");
    }
    return text;
}

std::string commandCases(const std::vector<Command>& commands) {
    std::string list;
    std::string cases;
    for (const Command& command : commands) {
        list += "            " + zshQuoted(command.name + ':' + shortText(command.text)) + '\n';
        cases += "        " + command.name + ")\n" +
                 arguments("_arguments -S", command.options, "            ") +
                 "                && ret=0\n            ;;\n";
    }
    return "    case $state in\n"
           "    command)\n"
           "        local -a commands=(\n" +
           list +
           "        )\n"
           "        _describe command commands && ret=0\n"
           "        ;;\n"
           "    arguments)\n"
           "        case $line[1] in\n" +
           cases +
           "        esac\n"
           "        ;;\n"
           "    esac\n";
}

} // namespace

std::string zshCompletion(const Program& program) {
    std::string function = '_' + program.name;
    std::replace(function.begin(), function.end(), '-', '_');
    std::string text = "#compdef " + program.name + "\n# made from the options of " + program.name + "\n\n" +
                       function +
                       "() {\n"
                       "    local curcontext=$curcontext state line ret=1\n"
                       "    typeset -A opt_args\n";
    text += arguments("_arguments -C", program.options, "    ");
    if (!program.commands.empty()) {
        text += "        '1:command:->command' \\\n"
                "        '*::argument:->arguments' \\\n";
    }
    text += "        && ret=0\n";
    if (!program.commands.empty()) {
        text += commandCases(program.commands);
    }
    return text + "    return ret\n}\n\n" + function + " \"$@\"\n";
}

} // namespace posewire::usage
