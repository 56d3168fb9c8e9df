// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace posewire::usage {

/// An option or, if it has no name, an argument.
struct Option {
    std::vector<std::string> names; ///< "-o", "--output"
    std::string form;  ///< what to type after the option, or as the argument: "SECONDS"; empty for a switch
    std::string range; ///< of a number: "0 to 1"
    std::string text;
    std::string group; ///< the heading it belongs under, if any
    std::string usual; ///< its default, if it is worth naming
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

/// Tells if a value has to follow: not for "[NUMBER]".
[[nodiscard]] bool needsValue(const Option& option);

/// The alternatives of a form: those of "light|dark|FILE" are three.
[[nodiscard]] std::vector<std::string> alternativesOf(std::string_view form);

/// The texts that may be typed; none if anything may.
[[nodiscard]] std::vector<std::string> choicesOf(const Option& option);

/// Tells if its value may be the name of a file.
[[nodiscard]] bool takesFile(const Option& option);

/// `separator` between the words.
[[nodiscard]] std::string joined(const std::vector<std::string>& words, std::string_view separator);

/// Returns the one of `known` that `word` was most likely meant to be: at most a third of its letters are
/// missing, wrong or too many. Empty if there is none.
[[nodiscard]] std::string nearest(std::string_view word, const std::vector<std::string>& known);

/// The version of both programs, "0.2.0" or "0.2.0~dev.12+gfea9cb7b": see packaging/cmake/Version.cmake.
[[nodiscard]] std::string_view version();

} // namespace posewire::usage
