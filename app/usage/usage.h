// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// What a program takes on its command line, as plain data: from this come its manual page and its
/// completions.
namespace posewire::usage {

/// An option or, where it has no name, an argument.
struct Option {
    std::vector<std::string> names; ///< "-o", "--output"
    std::string form;  ///< what to type after the option, or as the argument: "SECONDS"; empty for a switch
    std::string range; ///< of a number: "0 to 1"
    std::string text;
    std::string group; ///< the heading it belongs under, if any
    std::string usual; ///< its default, where it has one worth naming
    bool isRequired = false;
    bool isRepeatable = false;
    std::vector<std::string> needs;    ///< names of other options
    std::vector<std::string> excludes; ///< likewise
};

struct Command {
    std::string name;
    std::string text;
    std::vector<Option> options;
};

struct Program {
    std::string name;
    std::string text;
    std::vector<Option> options;
    std::vector<Command> commands;
};

[[nodiscard]] bool isArgument(const Option& option);

/// Whether something has to follow it. "[NUMBER]" need not.
[[nodiscard]] bool needsValue(const Option& option);

/// The alternatives of a form: those of "light|dark|FILE" are three.
[[nodiscard]] std::vector<std::string> alternativesOf(const Option& option);

/// Whether an alternative stands for what is to be typed, as FILE does; others are typed as they are.
[[nodiscard]] bool isPlaceholder(std::string_view alternative);

/// What may be typed, letter by letter; none where anything may.
[[nodiscard]] std::vector<std::string> choicesOf(const Option& option);

/// Whether it may be the name of a file.
[[nodiscard]] bool takesFile(const Option& option);

/// `separator` between the words.
[[nodiscard]] std::string joined(const std::vector<std::string>& words, std::string_view separator);

} // namespace posewire::usage
