// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"
#include "app/cli/send_options.h"
#include "core/performer/motion.h"

#include <CLI/CLI.hpp>
#include <QCoreApplication>

namespace posewire::cli {
namespace {

ExitStatus unusable(Console& console, const std::string& complaint) {
    console.complain(complaint);
    return ExitStatus::Unusable;
}

ExitStatus conclude(net::DatagramSender& sender, Console& console, ExitStatus status) {
    if (const auto flushed = sender.flush(); !flushed) {
        return unusable(console, flushed.error().text);
    }
    if (sender.refused() != 0) {
        console.complain(
            std::to_string(sender.refused()) +
            " datagrams were not taken by the network; is the address right and somebody listening?");
    }
    console.out.write("sent " + std::to_string(sender.sent()) + " datagrams\n");
    return status;
}

ExitStatus send(const SendOptions& options, Console& console) {
    const auto targets = targetsOf(options);
    if (!targets) {
        return unusable(console, targets.error());
    }
    const auto settings = performerOf(options);
    if (!settings) {
        return unusable(console, settings.error());
    }
    // Qt's sockets want an application to be there.
    std::string name = "posewire-cli";
    std::array<char*, 2> arguments{name.data(), nullptr};
    int argumentCount = 1;
    const QCoreApplication application(argumentCount, arguments.data());
    auto sender = net::DatagramSender::connect(*targets);
    if (!sender) {
        return unusable(console, sender.error().text);
    }
    const ExitStatus status = options.file.empty() ? sendPerformance(options, *settings, *sender, console)
                                                   : sendFile(options, *sender, console);
    return status == ExitStatus::Unusable ? status : conclude(*sender, console, status);
}

std::string motionList() {
    std::string list;
    for (const std::string_view name : performer::motionNames()) {
        list.append(list.empty() ? "" : ", ").append(name);
    }
    return list;
}

void addPlaces(CLI::App& parser, SendOptions& options) {
    parser.add_option("--to", options.to, "where to, HOST:PORT; may be given several times")
        ->expected(1)
        ->take_all()
        ->capture_default_str();
    CLI::Option* udp = parser.add_flag("--udp")->description("one datagram a packet (default)");
    parser.add_flag("--tcp", options.overTcp, "connect, as MVN does, and send datagrams back to back")
        ->excludes(udp);
    parser
        .add_option("--duration", options.durationSeconds, "stop after so many seconds; 0: when interrupted")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
}

void addPerformer(CLI::App& parser, SendOptions& options) {
    performer::PerformerSettings& settings = options.performer;
    parser.add_option("--characters", settings.characters, "how many perform")->capture_default_str();
    parser.add_option("--rate", settings.rateHz, "frames a second")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    parser.add_option("--types", options.types, "message types, such as 02,12,13, or all of the revision")
        ->capture_default_str();
    parser.add_option("--revision", options.revision, "of the specification: E, J, K or N")
        ->capture_default_str();
    parser.add_option("--seed", settings.seed, "the same seed gives the same bytes")->capture_default_str();
    parser.add_option("--motion", settings.motion, "one of " + motionList())->capture_default_str();
    parser.add_option("--props", settings.props, "props of each character, 0 to 4")->capture_default_str();
    parser.add_flag("--fingers", settings.fingers, "with both hands (revision N)");
}

void addFile(CLI::App& parser, SendOptions& options) {
    CLI::Option* file = parser.add_option(
        "--file", options.file, "send this recording instead of a performance; - for standard input");
    parser.add_option("--speed", options.speed, "how fast a recording plays")
        ->check(CLI::PositiveNumber)
        ->needs(file)
        ->capture_default_str();
    parser.add_flag("--loop", options.loops, "begin a recording again at its end")->needs(file);
}

} // namespace

Command addSendCommand(CLI::App& program) {
    auto options = std::make_shared<SendOptions>();
    CLI::App* parser =
        program.add_subcommand("send", "Send a synthetic performance or a recording to the network");
    addPlaces(*parser, *options);
    addPerformer(*parser, *options);
    addFile(*parser, *options);
    return {parser, [options](Console& console) { return send(*options, console); }};
}

} // namespace posewire::cli
