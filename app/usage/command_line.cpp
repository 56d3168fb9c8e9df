// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/usage/command_line.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>
#include <type_traits>
#include <utility>

namespace posewire::usage {
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

EarlyExit mistakeOf(const CLI::App& program, const std::string& wording) {
    const std::string name = chosenName(program);
    return {2, name + ": " + wording.substr(0, wording.find_last_not_of('.') + 1) + "; see " + name +
                   " --help\n"};
}

/// 1000000 and 0.25, not 1e+06.
std::string numberText(double number) {
    std::ostringstream text;
    text << std::setprecision(12) << number;
    return text.str();
}

constexpr const char* kRange = "range";
constexpr const char* kFormer = ""; ///< the group of former spellings: help leaves out those without a title

/// All of the text, in decimal; nothing if it is not a number.
template <class T>
std::optional<T> numberOf(const std::string& text) {
    T value{};
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    return read.ec == std::errc{} && read.ptr == end ? std::optional(value) : std::nullopt;
}

/// In words that name what was typed and what is wanted, and in the help.
CLI::Validator between(double least, double most) {
    const std::string range = numberText(least) + " to " + numberText(most);
    return CLI::Validator(
        [=](const std::string& text) {
            const auto value = numberOf<double>(text);
            return value && *value >= least && *value <= most // false for what is not a number
                       ? std::string()
                       : "\"" + text + "\" is not a number from " + range;
        },
        range, kRange);
}

/// The same for a whole number, which the parser would take for octal if it begins with 0.
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

/// "--rate" and "HZ" of "--rate HZ".
std::pair<std::string, std::string> partsOf(const std::string& name) {
    const std::size_t space = std::min(name.find(' '), name.size());
    return {name.substr(0, space), name.substr(std::min(space + 1, name.size()))};
}

/// An empty text is a variable of a script that was never set.
CLI::Validator notEmpty() {
    return CLI::Validator(
        [](const std::string& text) { return text.empty() ? std::string("needs a value") : std::string(); },
        "");
}

/// Empty if it takes no numbers.
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

Option usageOf(CLI::Option& option) {
    Option usage;
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

std::vector<Option> usageOf(CLI::App& parser) {
    std::vector<Option> options;
    for (CLI::Option* option :
         parser.get_options([](const CLI::Option* one) { return one->get_group() != kFormer; })) {
        options.push_back(usageOf(*option));
    }
    return options;
}

/// The command or option that was most likely meant; empty if none is spelled nearly so.
std::string meantBy(const std::string& typed, CLI::App& program) {
    std::vector<std::string> known;
    std::vector<CLI::App*> parsers = program.get_subcommands();
    parsers.push_back(&program);
    for (CLI::App* parser : parsers) {
        for (const Option& option : usageOf(*parser)) {
            known.push_back(option.names.empty() ? std::string() : option.names.back());
        }
    }
    for (const CLI::App* command : program.get_subcommands({})) {
        known.push_back(command->get_name());
    }
    return nearest(typed.substr(0, typed.find('=')), known);
}

/// Help and version are exceptions of the parser too.
EarlyExit earlyExit(CLI::App& program, const CLI::ParseError& what) {
    if (what.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
        std::ostringstream out;
        program.exit(what, out, out);
        return {0, out.str()};
    }
    const std::vector<std::string> unknown = program.remaining(true);
    if (unknown.empty()) {
        return mistakeOf(program, oneLine(what.what()));
    }
    const std::string meant = meantBy(unknown.front(), program);
    return mistakeOf(program, unknown.front() + " is not known here" +
                                  (meant.empty() ? "" : " (did you mean " + meant + "?)"));
}

} // namespace

DeclaredOption DeclaredOption::group(const std::string& title) {
    return {*m_parser, *m_option->group(title)};
}
DeclaredOption DeclaredOption::required() {
    return {*m_parser, *m_option->required()};
}
DeclaredOption DeclaredOption::repeatable() {
    return {*m_parser, *m_option->expected(1)->take_all()};
}
DeclaredOption DeclaredOption::showDefault() {
    return {*m_parser, *m_option->capture_default_str()};
}
DeclaredOption DeclaredOption::within(double least, double most) {
    return {*m_parser, *m_option->check(between(least, most))};
}
DeclaredOption DeclaredOption::within(int least, int most) {
    return {*m_parser, *m_option->transform(wholeBetween(least, most, "number"))};
}
DeclaredOption DeclaredOption::wholeUpTo(std::uint64_t most) {
    return {*m_parser, *m_option->transform(wholeBetween(std::uint64_t{0}, most, "whole number"))};
}
DeclaredOption DeclaredOption::seconds() {
    constexpr double year = 365.0 * 86'400.0;
    return within(0.0, year);
}
DeclaredOption DeclaredOption::milliseconds() {
    constexpr double day = 86'400'000.0;
    return within(0.0, day);
}
DeclaredOption DeclaredOption::needs(DeclaredOption other) {
    return {*m_parser, *m_option->needs(other.m_option)};
}
DeclaredOption DeclaredOption::excludes(DeclaredOption other) {
    return {*m_parser, *m_option->excludes(other.m_option)};
}
DeclaredOption DeclaredOption::formerly(const std::string& spelling) {
    const auto handOn = [spelling, parser = m_parser, now = m_option](const CLI::results_t& typed) {
        const std::string relation = spelling + " is an old spelling of " + nameOf(*now);
        if (now->count() != 0) {
            throw CLI::ValidationError(relation + ": give one of them");
        }
        now->add_result(typed);
        now->run_callback();
        const CLI::App* program = parser->get_parent() != nullptr ? parser->get_parent() : parser;
        std::cerr << chosenName(*program) << ": " << relation << ", accepted until version 1.0\n";
        return true;
    };
    m_parser->add_option(spelling, handOn)->group(kFormer)->expected(1)->take_all();
    return *this;
}

template <class T>
DeclaredOption Arguments::add(const std::string& name, T& value, const std::string& text) {
    const auto [names, form] = partsOf(name);
    CLI::Option* option = m_parser->add_option(names, value, text);
    if (option->nonpositional()) {
        option->type_name(!form.empty() ? form : std::is_arithmetic_v<T> ? "NUMBER" : "TEXT");
    }
    if constexpr (std::is_same_v<T, std::vector<std::string>>) {
        if (option->nonpositional()) {
            option->expected(1)->take_all();
        }
    }
    return {*m_parser, std::is_arithmetic_v<T> ? *option : *option->check(notEmpty())};
}
template DeclaredOption Arguments::add(const std::string&, std::string&, const std::string&);
template DeclaredOption Arguments::add(const std::string&, std::vector<std::string>&, const std::string&);
template DeclaredOption Arguments::add(const std::string&, double&, const std::string&);
template DeclaredOption Arguments::add(const std::string&, std::optional<double>&, const std::string&);
template DeclaredOption Arguments::add(const std::string&, int&, const std::string&);
template DeclaredOption Arguments::add(const std::string&, std::uint32_t&, const std::string&);
template DeclaredOption Arguments::add(const std::string&, std::uint64_t&, const std::string&);

DeclaredOption Arguments::read(const std::string& name, Reading reading, const std::string& text) {
    const auto [names, form] = partsOf(name);
    const auto readAll = [reading = std::move(reading)](const CLI::results_t& typed) {
        for (const std::string& one : typed) {
            if (const std::string problem = reading(one); !problem.empty()) {
                throw CLI::ValidationError(problem);
            }
        }
        return true;
    };
    CLI::Option* option = m_parser->add_option(names, readAll, text)->check(notEmpty());
    return {*m_parser, form.empty() ? *option : *option->type_name(form)};
}

DeclaredOption Arguments::choice(const std::string& name, std::string& value, const std::string& text) {
    const auto [names, form] = partsOf(name);
    return read(
        name,
        [&value, names = names, form = form](const std::string& typed) {
            value = typed;
            const bool isOne = std::ranges::count(alternativesOf(form), typed) != 0;
            return isOne ? std::string() : names + ": '" + typed + "' is none of " + form;
        },
        text);
}

DeclaredOption Arguments::flag(const std::string& name, bool& isOn, const std::string& text) {
    return {*m_parser, *m_parser->add_flag(name, isOn, text)};
}

DeclaredOption Arguments::flag(const std::string& name, const std::string& text) {
    return {*m_parser, *m_parser->add_flag(name)->description(text)};
}

DeclaredOption Arguments::force(bool& isOn) {
    return flag("--force", isOn, "replace output files that exist; an input file never is");
}

DeclaredOption Arguments::verbose(bool& isOn, const std::string& text) {
    return flag("--verbose", isOn, "log to standard error " + text);
}

DeclaredOption Arguments::option(const std::string& name) const {
    return {*m_parser, *m_parser->get_option(name)};
}

void Arguments::beginGroup(const std::string& title) {
    m_parser->option_defaults()->group(title);
}

CommandLine::CommandLine(const std::string& name, const std::string& text,
                         std::function<std::string()> version, const std::string& footer)
    : m_parser(std::make_unique<CLI::App>(text, name)) {
    m_parser->allow_windows_style_options(false); // a path may begin with a slash there too
    m_parser->set_version_flag("-v,--version", std::move(version), "Print the version and exit");
    m_parser->footer(footer);
}
CommandLine::~CommandLine() = default;

Arguments CommandLine::arguments() {
    m_parser->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    return Arguments(*m_parser);
}

Arguments CommandLine::addCommand(const std::string& name, const std::string& text) {
    return Arguments(*m_parser->add_subcommand(name, text)->fallthrough()); // to --version
}

Program CommandLine::usage() const {
    Program program{m_parser->get_name(), m_parser->get_description(), usageOf(*m_parser), {}};
    for (CLI::App* command : m_parser->get_subcommands([](const CLI::App*) { return true; })) {
        program.commands.push_back({command->get_name(), command->get_description(), usageOf(*command)});
    }
    return program;
}

tl::expected<std::string, EarlyExit> CommandLine::parse(const std::vector<std::string>& arguments) {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend()); // as CLI11 takes them
    if (!reversed.empty()) {
        reversed.pop_back();
    }
    try {
        m_parser->parse(std::move(reversed));
    } catch (const CLI::ParseError& what) {
        return tl::unexpected(earlyExit(*m_parser, what));
    }
    const auto chosen = m_parser->get_subcommands();
    if (chosen.empty() && !usage().commands.empty()) {
        return tl::unexpected(mistake("a command is needed"));
    }
    return chosen.empty() ? std::string() : chosen.front()->get_name();
}

EarlyExit CommandLine::mistake(const std::string& wording) const {
    return mistakeOf(*m_parser, wording);
}

int end(const EarlyExit& exit) {
    (exit.status == 0 ? std::cout : std::cerr) << exit.text << std::flush;
    return exit.status;
}

} // namespace posewire::usage
