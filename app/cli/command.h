// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/input_output.h"
#include "app/usage/usage.h"
#include "core/log/file_contents.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace CLI {
class App;
class Option;
} // namespace CLI

/// The command line as commands declare it, and what a command is. CLI11 does the work behind this header, in
/// command.cpp alone: its own takes seconds to compile.
namespace posewire::cli {

/// One option of a command; a handle, to be passed by value.
class Option {
public:
    explicit Option(CLI::Option& option) : m_option(&option) {}

    Option form(const std::string& name);   ///< what to type after it: "SECONDS"
    Option group(const std::string& title); ///< the heading that help lists it under
    Option required();
    Option repeatable();  ///< may be given several times, with one value each
    Option showDefault(); ///< help names the value that it has now
    /// A number of this range, which the message names where it is not.
    Option within(double least, double most);
    /// A whole one, in decimal.
    Option within(int least, int most);
    /// A whole number from 0 to `most`.
    Option wholeUpTo(std::uint64_t most);
    Option seconds();      ///< from 0 to a year
    Option milliseconds(); ///< from 0 to a day
    Option needs(Option other);
    Option excludes(Option other);

private:
    CLI::Option* m_option;
};

/// One command's arguments.
class Arguments {
public:
    explicit Arguments(CLI::App& parser) : m_parser(&parser) {}

    /// An option, or an argument of its own where the name has no dash. `value` gets what was typed and must
    /// outlive the parsing; for the types that command.cpp instantiates.
    template <class T>
    Option add(const std::string& name, T& value, const std::string& text);
    /// On when it is given.
    Option flag(const std::string& name, bool& isOn, const std::string& text);
    /// Accepted and otherwise without effect: it names the default.
    Option flag(const std::string& name, const std::string& text);
    /// `--force`: an output file that exists is replaced.
    Option force(bool& isOn);
    /// `--verbose`: standard error tells more than what is wrong.
    Option verbose(bool& isOn, const std::string& text);
    /// One that was added before.
    [[nodiscard]] Option option(const std::string& name) const;
    /// Options that are added from now on come under this heading of the help.
    void beginGroup(const std::string& title);

private:
    CLI::App* m_parser;
};

/// The whole command line: one command has to be chosen.
class CommandLine {
public:
    /// `version` is what --version prints, `footer` the end of the help.
    CommandLine(const std::string& name, const std::string& text, const std::string& version,
                const std::string& footer);
    ~CommandLine();

    Arguments addCommand(const std::string& name, const std::string& text);

    /// What was declared, for manual pages and completions.
    [[nodiscard]] usage::Program usage() const;

    /// What came of parsing.
    struct Parsed {
        enum class Kind : std::uint8_t {
            Command, ///< `text` is the command that was chosen
            Answer,  ///< help or version, in `text`
            Mistake, ///< one line about what is wrong, in `text`
        };
        Kind kind;
        std::string text;
    };
    [[nodiscard]] Parsed parse(int argumentCount, const char* const* arguments);

private:
    std::unique_ptr<CLI::App> m_parser;
};

/// What the exit status says; the same for every command.
enum class ExitStatus : int {
    Fine = 0,
    Faults = 1,   ///< the input had faults, or a threshold was exceeded
    Unusable = 2, ///< wrong usage, or the input or output could not be opened
};

/// The worse of the two.
[[nodiscard]] constexpr ExitStatus worse(ExitStatus a, ExitStatus b) {
    return a < b ? b : a;
}

/// Where a command writes: results to one place, complaints to another.
struct Console {
    Output& out;
    std::function<void(const std::string&)> complain; ///< one line: what, where, what to do

    /// Complains about what ends the command.
    [[nodiscard]] ExitStatus unusable(const std::string& complaint) const {
        complain(complaint);
        return ExitStatus::Unusable;
    }
};

/// What came of reading an input. Where something is wrong that is said; that nobody wants more is not.
[[nodiscard]] ExitStatus readingStatus(const tl::expected<void, log::FileError>& result,
                                       const Console& console);
/// The same where the input may have nothing of ours: then what it has instead is said.
[[nodiscard]] ExitStatus readingStatus(const tl::expected<void, log::FileError>& result,
                                       const log::FileContents& contents, const std::string& name,
                                       const Console& console);

/// One command of the program: its name, and what it does once the command line is parsed.
struct Command {
    std::string name;
    std::function<ExitStatus(Console&)> run;
};

Command addDecodeCommand(CommandLine& program);
Command addEncodeCommand(CommandLine& program);
Command addExportCommand(CommandLine& program);
Command addMonitorCommand(CommandLine& program);
Command addReferenceCommand(CommandLine& program);
Command addReportCommand(CommandLine& program);
Command addSendCommand(CommandLine& program);

} // namespace posewire::cli
