// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <iomanip>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>
#include <type_traits>
#include <utility>
#include <vector>

namespace posewire::cli {
namespace {

/// Complaints that the parser words over several lines become one.
std::string oneLine(std::string text) {
    while (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

std::string chosenName(const CLI::App& program) {
    const auto chosen = program.get_subcommands();
    return program.get_name() + (chosen.empty() ? "" : " " + chosen.front()->get_name());
}

std::string mistake(const CLI::App& program, const CLI::ParseError& what) {
    const std::vector<std::string> unknown = program.remaining(true);
    const std::string name = chosenName(program);
    const std::string wording =
        unknown.empty() ? oneLine(what.what()) : unknown.front() + " is not known here";
    return name + ": " + wording + "; see " + name + " --help";
}

std::string answer(const CLI::App& program, const CLI::ParseError& what) {
    std::ostringstream out;
    program.exit(what, out, out);
    return out.str();
}

/// 1000000 and 0.25, not 1e+06.
std::string plain(double number) {
    std::ostringstream text;
    text << std::setprecision(12) << number;
    return text.str();
}

constexpr const char* kRange = "range";

/// All of the text, in decimal; nothing where it is not one.
template <class T>
std::optional<T> numberOf(const std::string& text) {
    T value{};
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    return read.ec == std::errc{} && read.ptr == end ? std::optional(value) : std::nullopt;
}

/// In words that name what was typed and what is wanted, and in the help.
CLI::Validator between(double least, double most) {
    const std::string range = plain(least) + " to " + plain(most);
    return CLI::Validator(
        [=](const std::string& text) {
            const auto value = numberOf<double>(text);
            return value && *value >= least && *value <= most // false for what is not a number
                       ? std::string()
                       : "\"" + text + "\" is not a number from " + range;
        },
        range, kRange);
}

/// The same for a whole number, which the parser would take for octal where it begins with 0.
template <class T>
CLI::Validator wholeBetween(T least, T most, const std::string& wording) {
    const std::string range = std::to_string(least) + " to " + std::to_string(most);
    return CLI::Validator(
        [=](std::string& text) {
            const auto value = numberOf<T>(text);
            const bool isGood = value && *value >= least && *value <= most;
            const std::string typed = std::exchange(text, isGood ? std::to_string(*value) : text);
            return isGood  ? std::string()
                   : value ? "\"" + typed + "\" is not a " + wording + " from " + range
                           : "\"" + typed + "\" is not a whole number from " + range;
        },
        range, kRange);
}

/// An empty text is a variable of a script that was never set.
CLI::Validator notEmpty() {
    return CLI::Validator(
        [](const std::string& text) { return text.empty() ? std::string("needs a value") : std::string(); },
        "");
}

/// What numbers it takes; empty where it is none.
std::string rangeText(CLI::Option& option) {
    try {
        return option.get_validator(kRange)->get_description();
    } catch (const CLI::OptionNotFound&) {
        return {};
    }
}

std::string nameOf(const CLI::Option& option) {
    return (option.nonpositional() ? option.get_lnames().empty() ? "-" : "--" : "") +
           option.get_single_name();
}

std::vector<std::string> namesOf(const std::set<CLI::Option*>& options) {
    std::vector<std::string> names;
    std::ranges::transform(options, std::back_inserter(names),
                           [](const CLI::Option* option) { return nameOf(*option); });
    std::ranges::sort(names); // a set of addresses is in another order each time
    return names;
}

/// The parser writes a list of one as "[x]".
std::string withoutBrackets(const std::string& text) {
    const bool isList = text.starts_with('[') && text.ends_with(']');
    return isList ? text.substr(1, text.size() - 2) : text;
}

usage::Option usageOf(CLI::Option& option) {
    usage::Option usage;
    usage.text = option.get_description();
    usage.usual = withoutBrackets(option.get_default_str());
    usage.isRequired = option.get_required();
    usage.needs = namesOf(option.get_needs());
    usage.excludes = namesOf(option.get_excludes());
    for (const std::string& name : option.get_snames()) {
        usage.names.push_back('-' + name);
    }
    for (const std::string& name : option.get_lnames()) {
        usage.names.push_back("--" + name);
    }
    usage.range = rangeText(option);
    usage.form = option.nonpositional() ? option.get_type_name() : option.get_single_name();
    if (!usage.range.empty()) {
        usage.form.resize(usage.form.size() - usage.range.size() - 1); // ":0 to 1"
    }
    usage.group = option.get_group() == "Options" ? std::string() : option.get_group();
    usage.isRepeatable =
        option.get_expected_max() > 1 || option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
    return usage;
}

std::vector<usage::Option> usageOf(CLI::App& parser) {
    std::vector<usage::Option> options;
    for (CLI::Option* option : parser.get_options([](const CLI::Option*) { return true; })) {
        options.push_back(usageOf(*option));
    }
    return options;
}

} // namespace

Option Option::form(const std::string& name) {
    return Option(*m_option->type_name(name));
}
Option Option::group(const std::string& title) {
    return Option(*m_option->group(title));
}
Option Option::required() {
    return Option(*m_option->required());
}
Option Option::repeatable() {
    return Option(*m_option->expected(1)->take_all());
}
Option Option::showDefault() {
    return Option(*m_option->capture_default_str());
}
Option Option::within(double least, double most) {
    return Option(*m_option->check(between(least, most)));
}
Option Option::within(int least, int most) {
    return Option(*m_option->transform(wholeBetween(least, most, "number")));
}
Option Option::wholeUpTo(std::uint64_t most) {
    return Option(*m_option->transform(wholeBetween(std::uint64_t{0}, most, "whole number")));
}
Option Option::seconds() {
    constexpr double year = 365.0 * 86'400.0;
    return within(0.0, year);
}
Option Option::milliseconds() {
    constexpr double day = 86'400'000.0;
    return within(0.0, day);
}
Option Option::needs(Option other) {
    return Option(*m_option->needs(other.m_option));
}
Option Option::excludes(Option other) {
    return Option(*m_option->excludes(other.m_option));
}

template <class T>
Option Arguments::add(const std::string& name, T& value, const std::string& text) {
    CLI::Option* option = m_parser->add_option(name, value, text);
    if (option->nonpositional()) {
        option->type_name(std::is_arithmetic_v<T> ? "NUMBER" : "TEXT");
    }
    return Option(std::is_arithmetic_v<T> ? *option : *option->check(notEmpty()));
}
template Option Arguments::add(const std::string&, std::string&, const std::string&);
template Option Arguments::add(const std::string&, std::vector<std::string>&, const std::string&);
template Option Arguments::add(const std::string&, double&, const std::string&);
template Option Arguments::add(const std::string&, std::optional<double>&, const std::string&);
template Option Arguments::add(const std::string&, int&, const std::string&);
template Option Arguments::add(const std::string&, std::uint32_t&, const std::string&);
template Option Arguments::add(const std::string&, std::uint64_t&, const std::string&);

Option Arguments::flag(const std::string& name, bool& isOn, const std::string& text) {
    return Option(*m_parser->add_flag(name, isOn, text));
}

Option Arguments::flag(const std::string& name, const std::string& text) {
    return Option(*m_parser->add_flag(name)->description(text));
}

Option Arguments::force(bool& isOn) {
    return flag("--force", isOn, "replace output files that exist; an input file never is");
}

Option Arguments::verbose(bool& isOn, const std::string& text) {
    return flag("--verbose", isOn, "tell on standard error " + text);
}

Option Arguments::option(const std::string& name) const {
    return Option(*m_parser->get_option(name));
}

void Arguments::beginGroup(const std::string& title) {
    m_parser->option_defaults()->group(title);
}

CommandLine::CommandLine(const std::string& name, const std::string& text, const std::string& version,
                         const std::string& footer)
    : m_parser(std::make_unique<CLI::App>(text, name)) {
    m_parser->allow_windows_style_options(false); // a path may begin with a slash there too
    m_parser->set_version_flag("--version", version, "Print the version and exit");
    m_parser->footer(footer);
}
CommandLine::~CommandLine() = default;

Arguments CommandLine::addCommand(const std::string& name, const std::string& text) {
    return Arguments(*m_parser->add_subcommand(name, text));
}

usage::Program CommandLine::usage() const {
    usage::Program program{m_parser->get_name(), m_parser->get_description(), usageOf(*m_parser), {}};
    for (CLI::App* command : m_parser->get_subcommands([](const CLI::App*) { return true; })) {
        program.commands.push_back({command->get_name(), command->get_description(), usageOf(*command)});
    }
    return program;
}

CommandLine::Parsed CommandLine::parse(int argumentCount, const char* const* arguments) {
    try {
        m_parser->parse(argumentCount, arguments);
    } catch (const CLI::ParseError& what) {
        const bool isAnswer = what.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
        return isAnswer ? Parsed{Parsed::Kind::Answer, answer(*m_parser, what)}
                        : Parsed{Parsed::Kind::Mistake, mistake(*m_parser, what)};
    }
    const auto chosen = m_parser->get_subcommands();
    if (chosen.empty()) {
        return {Parsed::Kind::Mistake,
                m_parser->get_name() + ": a command is needed; see " + m_parser->get_name() + " --help"};
    }
    return {Parsed::Kind::Command, chosen.front()->get_name()};
}

ExitStatus readingStatus(const tl::expected<void, log::FileError>& result, const Console& console) {
    using Kind = log::FileError::Kind;
    if (result || result.error().kind == Kind::Cancelled) {
        return ExitStatus::Fine;
    }
    console.complain(result.error().text);
    return result.error().leavesABeginning() ? ExitStatus::Faults : ExitStatus::Unusable;
}

ExitStatus readingStatus(const tl::expected<void, log::FileError>& result, const log::FileContents& contents,
                         const std::string& name, const Console& console) {
    const ExitStatus status = readingStatus(result, console);
    const bool isRead = result || result.error().leavesABeginning();
    if (const std::string other = log::otherContents(contents); isRead && !other.empty()) {
        console.complain(name + ": " + other);
    }
    return status;
}

} // namespace posewire::cli
