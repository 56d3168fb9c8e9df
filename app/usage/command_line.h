// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/usage/usage.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <tl/expected.hpp>

namespace CLI {
class App;
class Option;
} // namespace CLI

/// Command lines as programs declare them: once, for parsing, help, manual pages and completions. CLI11 does
/// the work behind this header, in command_line.cpp alone: its own takes seconds to compile.
namespace posewire::usage {

/// An option or argument as it is declared; a handle, to be passed by value.
class DeclaredOption {
public:
    DeclaredOption(CLI::App& parser, CLI::Option& option) : m_parser(&parser), m_option(&option) {}

    DeclaredOption group(const std::string& title); ///< the heading that help lists it under
    DeclaredOption required();
    DeclaredOption repeatable();  ///< may be given several times, with one value each
    DeclaredOption showDefault(); ///< help names the value that it has now
    /// A number of this range, which the message names if it is not.
    DeclaredOption within(double least, double most);
    /// A whole one, in decimal.
    DeclaredOption within(int least, int most);
    /// A whole number from 0 to `most`.
    DeclaredOption wholeUpTo(std::uint64_t most);
    DeclaredOption seconds();      ///< from 0 to a year
    DeclaredOption milliseconds(); ///< from 0 to a day
    DeclaredOption needs(DeclaredOption other);
    DeclaredOption excludes(DeclaredOption other);
    /// Accepted instead, with a warning on standard error, and not in the help; giving both is a mistake.
    DeclaredOption formerly(const std::string& spelling);

private:
    CLI::App* m_parser;
    CLI::Option* m_option;
};

/// Keeps one text that was typed; returns in one line what is wrong with it, or nothing.
using Reading = std::function<std::string(const std::string& text)>;

class Arguments {
public:
    explicit Arguments(CLI::App& parser) : m_parser(&parser) {}

    /// An option with what to type after it, as "--duration SECONDS", or an argument, as "FILE". `value` gets
    /// what was typed and must outlive the parsing; an option with a list may be repeated. For the types that
    /// command_line.cpp instantiates.
    template <class T>
    DeclaredOption add(const std::string& name, T& value, const std::string& text);
    /// The same for other types.
    DeclaredOption read(const std::string& name, Reading reading, const std::string& text);
    /// One of the alternatives in `name`, as "--up auto|y|z".
    DeclaredOption choice(const std::string& name, std::string& value, const std::string& text);
    /// On when it is given.
    DeclaredOption flag(const std::string& name, bool& isOn, const std::string& text);
    /// Accepted and otherwise without effect: it names the default.
    DeclaredOption flag(const std::string& name, const std::string& text);
    /// `--force`: an output file that exists is replaced.
    DeclaredOption force(bool& isOn);
    /// `--verbose`: standard error gets more than what is wrong.
    DeclaredOption verbose(bool& isOn, const std::string& text);
    /// One that was added before.
    [[nodiscard]] DeclaredOption option(const std::string& name) const;
    /// Options that are added from now on come under this heading of the help.
    void beginGroup(const std::string& title);

private:
    CLI::App* m_parser;
};

struct EarlyExit {
    int status = 0;   ///< 0 for help and version, 2 for a mistake
    std::string text; ///< for standard output; one line about the mistake, for standard error
};

/// A whole command line: options of the program itself, or commands of which one has to be chosen.
class CommandLine {
public:
    /// `version` makes what --version prints; `footer` is the end of the help.
    CommandLine(const std::string& name, const std::string& text, std::function<std::string()> version,
                const std::string& footer = {});
    ~CommandLine();

    /// Those of the program itself, of which the last one counts if one is given twice.
    Arguments arguments();
    Arguments addCommand(const std::string& name, const std::string& text);

    [[nodiscard]] Program usage() const;

    /// The command that was chosen; empty if there are none. `arguments` begin with the program's name.
    /// Writes a warning of each former spelling to standard error.
    [[nodiscard]] tl::expected<std::string, EarlyExit> parse(const std::vector<std::string>& arguments);
    /// One that only the program can find.
    [[nodiscard]] EarlyExit mistake(const std::string& wording) const;

private:
    std::unique_ptr<CLI::App> m_parser;
};

/// Prints what there is to say and returns the status.
[[nodiscard]] int end(const EarlyExit& exit);

} // namespace posewire::usage
