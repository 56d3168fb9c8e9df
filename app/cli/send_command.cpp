// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"
#include "app/cli/send_options.h"
#include "app/cli/send_truth.h"
#include "core/performer/motion.h"

#include <CLI/CLI.hpp>
#include <QCoreApplication>

namespace posewire::cli {
namespace {

ExitStatus unusable(Console& console, const std::string& complaint) {
    console.complain(complaint);
    return ExitStatus::Unusable;
}

/// The sockets of all senders, each with chances of its own.
tl::expected<std::vector<SendLine>, Complaint> linesOf(const SendOptions& options,
                                                       const std::vector<net::SendTarget>& targets) {
    auto faults = faultsOf(options);
    if (!faults) {
        return tl::unexpected(faults.error());
    }
    std::vector<SendLine> lines;
    for (int number = 0; number < options.senders; ++number) {
        auto line = SendLine::open(targets, *faults, !options.truth.empty());
        if (!line) {
            return tl::unexpected(line.error().text);
        }
        lines.push_back(std::move(*line));
        ++faults->seed;
    }
    return lines;
}

/// Tells what was sent; the truth also where the sending was cut short.
ExitStatus conclude(const SendOptions& options, std::vector<SendLine>& lines, Console& console) {
    std::uint64_t sent = 0;
    std::uint64_t refused = 0;
    for (SendLine& line : lines) {
        if (const auto finished = line.finish(); !finished) {
            return unusable(console, finished.error().text);
        }
        for (const SendLine::Sender& sender : line.senders()) {
            sent += sender.sender.sent();
            refused += sender.sender.refused();
        }
    }
    if (refused != 0) {
        console.complain(
            std::to_string(refused) +
            " datagrams were not taken by the network; is the address right and somebody listening?");
    }
    if (!options.truth.empty()) {
        if (const auto written = writeTruth(options.truth, lines, options.durationSeconds); !written) {
            return unusable(console, written.error());
        }
    }
    console.out.write("sent " + std::to_string(sent) + (sent == 1 ? " datagram\n" : " datagrams\n"));
    return ExitStatus::Fine;
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
    auto lines = linesOf(options, *targets);
    if (!lines) {
        return unusable(console, lines.error());
    }
    const ExitStatus status = options.file.empty() ? sendPerformance(options, *settings, *lines, console)
                                                   : sendFile(options, *lines, console);
    return status == ExitStatus::Unusable ? status : worse(status, conclude(options, *lines, console));
}

std::string motionList() {
    std::string list;
    for (const std::string_view name : performer::motionNames()) {
        list.append(list.empty() ? "" : ", ").append(name);
    }
    return list;
}

void addPlaces(CLI::App& parser, SendOptions& options) {
    parser.option_defaults()->group("Where to and for how long");
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
    parser.option_defaults()->group("The performance");
    performer::PerformerSettings& settings = options.performer;
    parser.add_option("--characters", settings.characters, "how many perform")->capture_default_str();
    parser.add_option("--rate", settings.rateHz, "frames a second")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    parser.add_option("--types", options.types, "message types, such as 02,12,13, or all of the revision")
        ->capture_default_str();
    parser.add_option("--revision", options.revision, "of the specification: E, J, K or N")
        ->capture_default_str();
    parser.add_option("--seed", settings.seed, "the same seed gives the same bytes and faults")
        ->capture_default_str();
    parser.add_option("--motion", settings.motion, "one of " + motionList())->capture_default_str();
    parser.add_option("--props", settings.props, "props of each character, 0 to 4")->capture_default_str();
    parser.add_flag("--fingers", settings.fingers, "with both hands (revision N)");
    parser
        .add_option("--first-sample", settings.firstSample,
                    "sample counter to begin with; near 4294967295 it wraps around")
        ->capture_default_str();
    parser.add_option("--senders", options.senders, "so many sockets send characters of the same numbers")
        ->check(CLI::Range(1, 16))
        ->capture_default_str();
}

CLI::Option* addChance(CLI::App& parser, const std::string& name, double& value, const char* text) {
    return parser.add_option(name, value, text)->check(CLI::Range(0.0, 1.0))->type_name("P");
}

void addFaults(CLI::App& parser, SendOptions& options) {
    parser.option_defaults()->group("Faults, in any combination (P: chance per datagram)");
    performer::FaultSettings& faults = options.faults;
    CLI::Option* drop = addChance(parser, "--drop", faults.drop, "lose datagrams");
    parser.add_option("--burst", faults.burst, "lose so many in a row, with the same share in all")
        ->check(CLI::Range(1, 1'000'000))
        ->needs(drop)
        ->type_name("N");
    parser
        .add_option("--gilbert-elliott", options.gilbertElliott,
                    "lose by state: chances to go bad and back, then to pass in good (1) and bad (0)")
        ->excludes(drop)
        ->type_name("p,r[,k,h]");
    addChance(parser, "--duplicate", faults.duplicate, "send datagrams twice, at once or later");
    addChance(parser, "--reorder", faults.reorder, "hold datagrams back, up to more than 100 samples");
    parser.add_option("--delay", faults.delayMs, "hold all back by so much")
        ->check(CLI::NonNegativeNumber)
        ->type_name("MS");
    parser.add_option("--jitter", faults.jitterMs, "hold each back by up to so much")
        ->check(CLI::NonNegativeNumber)
        ->type_name("MS");
    addChance(parser, "--corrupt", faults.corrupt, "flip bits in datagrams");
    addChance(parser, "--truncate", faults.truncate, "cut datagrams short");
    parser.add_flag("--split", faults.splits, "send samples of several items in two to four datagrams");
    parser.add_option("--restart-at", options.restart, "begin the sample counter anew after S seconds")
        ->type_name("S[:SAMPLE]");
    parser
        .add_option("--pause-at", options.pause,
                    "send nothing from S on for so many seconds; the counter goes on")
        ->type_name("S:S");
    parser.add_option("--reduce-at", options.reduction, "from S on send every Kth sample")->type_name("S:K");
}

CLI::Option* addFile(CLI::App& parser, SendOptions& options) {
    parser.option_defaults()->group("A recording");
    CLI::Option* file = parser.add_option(
        "--file", options.file, "send this recording instead of a performance; - for standard input");
    parser.add_option("--speed", options.speed, "how fast a recording plays")
        ->check(CLI::PositiveNumber)
        ->needs(file)
        ->capture_default_str();
    parser.add_flag("--loop", options.loops, "begin a recording again at its end")->needs(file);
    return file;
}

void addTruth(CLI::App& parser, SendOptions& options, CLI::Option* file) {
    parser.option_defaults()->group("The truth");
    parser
        .add_option("--truth", options.truth,
                    "write what was really sent to this file, as JSON with the names that monitor uses")
        ->excludes(file)
        ->needs(parser.get_option("--duration"))
        ->type_name("FILE");
}

} // namespace

Command addSendCommand(CLI::App& program) {
    auto options = std::make_shared<SendOptions>();
    CLI::App* parser =
        program.add_subcommand("send", "Send a synthetic performance or a recording to the network");
    addPlaces(*parser, *options);
    addPerformer(*parser, *options);
    addFaults(*parser, *options);
    addTruth(*parser, *options, addFile(*parser, *options));
    return {parser, [options](Console& console) { return send(*options, console); }};
}

} // namespace posewire::cli
