// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <optional>
#include <sstream>
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

/// `bounds` with its place in the help, and words that name what was typed: CLI11 writes the largest double
/// out.
CLI::Validator checked(CLI::Validator bounds, std::function<bool(double)> isGood, const std::string& wanted) {
    bounds.operation([isGood = std::move(isGood), wanted](const std::string& text) {
        double value = 0.0;
        const bool isNumber = CLI::detail::lexical_cast(text, value);
        return isNumber && isGood(value) ? std::string() : "\"" + text + "\" is not " + wanted;
    });
    return bounds;
}

template <class T>
CLI::Validator between(T least, T most) {
    std::ostringstream wanted;
    wanted << "a number from " << least << " to " << most;
    return checked(
        CLI::Range(least, most), [=](double value) { return value >= least && value <= most; }, wanted.str());
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
Option Option::notNegative() {
    return Option(*m_option->check(checked(
        CLI::NonNegativeNumber, [](double value) { return value >= 0.0; }, "a number from 0 up")));
}
Option Option::positive() {
    return Option(*m_option->check(checked(
        CLI::PositiveNumber, [](double value) { return value > 0.0; }, "a number greater than 0")));
}
Option Option::within(int least, int most) {
    return Option(*m_option->check(between(least, most)));
}
Option Option::within(double least, double most) {
    return Option(*m_option->check(between(least, most)));
}
Option Option::needs(Option other) {
    return Option(*m_option->needs(other.m_option));
}
Option Option::excludes(Option other) {
    return Option(*m_option->excludes(other.m_option));
}

template <class T>
Option Arguments::add(const std::string& name, T& value, const std::string& text) {
    return Option(*m_parser->add_option(name, value, text));
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

Option Arguments::option(const std::string& name) const {
    return Option(*m_parser->get_option(name));
}

void Arguments::beginGroup(const std::string& title) {
    m_parser->option_defaults()->group(title);
}

CommandLine::CommandLine(const std::string& name, const std::string& text, const std::string& version,
                         const std::string& footer)
    : m_parser(std::make_unique<CLI::App>(text, name)) {
    m_parser->set_version_flag("--version", version, "Print the version and exit");
    m_parser->footer(footer);
}
CommandLine::~CommandLine() = default;

Arguments CommandLine::addCommand(const std::string& name, const std::string& text) {
    return Arguments(*m_parser->add_subcommand(name, text));
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

} // namespace posewire::cli
