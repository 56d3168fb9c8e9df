// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"
#include "app/cli/inputs.h"
#include "app/cli/send.h"
#include "app/system/interruption.h"
#include "core/performer/motion.h"
#include "core/wire/codec.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

namespace posewire::cli {
namespace {

/// The sockets of all senders, each with its own random faults.
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

ExitStatus conclude(const SendOptions& options, std::vector<SendLine>& lines, Console& console) {
    std::uint64_t sent = 0;
    std::uint64_t refused = 0;
    ExitStatus status = ExitStatus::Fine;
    for (SendLine& line : lines) {
        if (const auto finished = line.finish(); !finished) {
            status = console.unusable(finished.error().text);
        }
        for (const SendLine::Sender& sender : line.senders()) {
            sent += sender.sender.sent();
            refused += sender.sender.refused();
            if (sender.sender.sent() == 0 && sender.sender.refused() != 0) {
                console.complain(sender.target + ": nothing was sent there");
                status = worse(status, ExitStatus::Faults);
            }
        }
    }
    if (refused != 0) {
        console.complain(
            std::to_string(refused) +
            " datagrams were refused by the network; check the address and that the receiver is running");
    }
    if (!options.truth.empty()) {
        if (const auto written = writeTruth(options, lines); !written) {
            return console.unusable(written.error());
        }
    }
    console.out.write("sent " + std::to_string(sent) + (sent == 1 ? " datagram\n" : " datagrams\n"));
    return status;
}

/// Further characters of the same numbers, each with a performance of its own.
std::vector<performer::Performer> performersOf(const performer::PerformerSettings& settings,
                                               std::size_t count) {
    std::vector<performer::Performer> performers;
    for (std::size_t number = 0; number < count; ++number) {
        performer::PerformerSettings own = settings;
        own.seed += number;
        performers.emplace_back(std::move(own));
    }
    return performers;
}

void offer(const std::vector<wire::Datagram>& frame, log::Duration due, performer::Faults& faults) {
    for (const wire::Datagram& datagram : frame) {
        // The performer makes nothing that does not fit.
        if (auto bytes = wire::encode(datagram)) {
            faults.offer(std::move(*bytes), due);
        }
    }
}

/// Without a truth to write the signal ends the program.
bool isInterrupted(const SendOptions& options) {
    return !options.truth.empty() && system::Interruption::hasCome();
}

/// Until it is through or `durationSeconds` have passed.
ExitStatus sendPerformance(const SendOptions& options, const performer::PerformerSettings& settings,
                           std::vector<SendLine>& lines, Console& console) {
    std::vector<performer::Performer> performers = performersOf(settings, lines.size());
    std::vector<wire::Datagram> frame;
    const log::SystemClock clock;
    net::SendSchedule schedule(clock);
    SendRound round(lines, schedule);
    const auto due = [&](std::uint64_t index) {
        return log::Duration(static_cast<std::int64_t>(static_cast<double>(index) * 1e9 / settings.rateHz));
    };
    const double frames = options.durationSeconds > 0.0
                              ? std::round(options.durationSeconds * settings.rateHz)
                              : std::numeric_limits<double>::infinity();
    net::NetResult<void> sent;
    for (std::uint64_t index = 0; sent && static_cast<double>(index) < frames && !isInterrupted(options);
         ++index) {
        for (std::size_t line = 0; line < lines.size(); ++line) {
            performers[line].frameInto(index, frame);
            offer(frame, due(index), lines[line].faults());
        }
        sent = round.send(due(index + 1));
        for (SendLine& line : lines) {
            line.tellRefusals(console);
        }
    }
    if (sent && !isInterrupted(options)) {
        sent = round.send(std::nullopt);
    }
    if (!sent) {
        return console.unusable(sent.error().text);
    }
    return ExitStatus::Fine;
}

void tellLines(const std::vector<SendLine>& lines, const std::vector<net::SendTarget>& targets,
               Console& console) {
    for (const SendLine& line : lines) {
        for (std::size_t i = 0; i < targets.size(); ++i) {
            const SendLine::Sender& sender = line.senders()[i];
            console.complain("sending from " + sender.address + " to " + net::textOf(targets[i].endpoint) +
                             (sender.isTcp ? " (TCP)" : " (UDP)"));
        }
    }
}

ExitStatus send(const SendOptions& options, Console& console) {
    const auto targets = targetsOf(options);
    if (!targets) {
        return console.unusable(targets.error());
    }
    const auto settings = performerOf(options);
    if (!settings) {
        return console.unusable(settings.error());
    }
    if (!options.truth.empty() && options.truth != "-") {
        if (const auto checked = log::checkOutput(options.truth, {options.replaces}); !checked) {
            return console.unusable(checked.error().text);
        }
    }
    const SocketApplication application;
    auto lines = linesOf(options, *targets);
    if (!lines) {
        return console.unusable(lines.error());
    }
    if (options.isVerbose) {
        tellLines(*lines, *targets, console);
    }
    std::optional<system::Interruption> interruption;
    if (!options.truth.empty()) {
        interruption.emplace();
    }
    const auto start = std::chrono::steady_clock::now();
    const ExitStatus status = options.file.empty() ? sendPerformance(options, *settings, *lines, console)
                                                   : sendFile(options, *lines, console);
    SendOptions done = options;
    if (isInterrupted(options)) {
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
        done.durationSeconds = std::min(options.durationSeconds, std::round(time.count() * 1e3) / 1e3);
    }
    if (status != ExitStatus::Unusable) {
        return worse(status, conclude(done, *lines, console));
    }
    if (!options.truth.empty()) { // what was sent until then was sent
        if (const auto written = writeTruth(done, *lines); !written) {
            console.complain(written.error());
        }
    }
    return status;
}

std::string listOf(std::span<const std::string_view> names) {
    std::string list;
    for (const std::string_view name : names) {
        list.append(list.empty() ? "" : "|").append(name);
    }
    return list;
}

void addTargets(Arguments arguments, SendOptions& options) {
    arguments.beginGroup("Target and duration");
    arguments.add("--to HOST:PORT", options.to, "target; may be given several times").showDefault();
    const DeclaredOption udp = arguments.flag("--udp", "one datagram per packet (default)");
    arguments.flag("--tcp", options.overTcp, "connect, as MVN does, and send datagrams back to back")
        .excludes(udp);
    arguments
        .add("--duration SECONDS", options.durationSeconds,
             "stop after this many seconds; 0: when interrupted")
        .seconds()
        .showDefault();
}

void addPerformer(Arguments arguments, SendOptions& options) {
    arguments.beginGroup("The performance");
    performer::PerformerSettings& settings = options.performer;
    arguments.add("--characters", settings.characters, "number of performers")
        .within(1, performer::kMaxCharacters)
        .showDefault();
    arguments.add("--rate", settings.rateHz, "samples per second").within(1.0, 1000.0).showDefault();
    arguments.add("--types", options.types, "message types, such as 02,12,13, or all of the revision")
        .showDefault();
    arguments.add("--revision E|J|K|N", options.revision, "of the specification that they follow")
        .showDefault();
    arguments.choice("--forms real|paper", options.forms,
                     "types 12 and 25 of revisions J and K as MVN sends them, or as these print them; real "
                     "by default");
    arguments.choice("--up y|z", options.up, "axis that is up in types 02, 21 and 22; z by default");
    arguments.add("--seed", settings.seed, "the same seed gives the same bytes and faults")
        .wholeUpTo(UINT64_MAX)
        .showDefault();
    arguments.add("--motion " + listOf(performer::motionNames()), settings.motion, "how they move")
        .showDefault();
    arguments.add("--props", settings.props, "props of each character").wholeUpTo(4).showDefault();
    arguments.flag("--fingers", settings.fingers, "send the fingers of both hands too (revision N)");
    arguments
        .add("--first-sample", settings.firstSample,
             "sample counter to begin with; near 4294967295 it wraps around")
        .wholeUpTo(UINT32_MAX)
        .showDefault();
    arguments.add("--senders", options.senders, "number of sockets that send characters with the same IDs")
        .within(1, 16)
        .showDefault();
}

DeclaredOption addChance(Arguments arguments, const std::string& name, double& value, const char* text) {
    return arguments.add(name + " P", value, text).within(0.0, 1.0);
}

void addFaults(Arguments arguments, SendOptions& options) {
    arguments.beginGroup("Faults, in any combination (P: chance per datagram)");
    performer::FaultSettings& faults = options.faults;
    const DeclaredOption drop = addChance(arguments, "--drop", faults.drop, "lose datagrams");
    arguments.add("--burst N", faults.burst, "lose this many in a row, with the same overall share")
        .within(1, 1'000'000)
        .needs(drop);
    arguments
        .add("--gilbert-elliott p,r[,k,h]", options.gilbertElliott,
             "lose by state: chances to go bad and back, then to pass in good (1) and bad (0)")
        .excludes(drop);
    addChance(arguments, "--duplicate", faults.duplicate, "send datagrams twice, at once or later");
    addChance(arguments, "--reorder", faults.reorder, "hold datagrams back, some by more than 100 samples");
    arguments.add("--delay MS", faults.delayMs, "delay all datagrams by this much").within(0.0, 10'000.0);
    arguments.add("--jitter MS", faults.jitterMs, "delay each datagram by up to this much")
        .within(0.0, 10'000.0);
    addChance(arguments, "--corrupt", faults.corrupt, "flip bits in datagrams");
    addChance(arguments, "--truncate", faults.truncate, "cut datagrams short");
    arguments.flag("--split", faults.splits, "send samples of several items in two to four datagrams");
    arguments.add("--restart-at S[:SAMPLE]", options.restart, "restart the sample counter after S seconds");
    arguments.add("--pause-at S:S", options.pause, "pause at S for S seconds; the counter keeps counting");
    arguments.add("--reduce-at S:K", options.reduction, "from S on send every Kth sample");
    const DeclaredOption fault =
        arguments.add("--fault " + listOf(performer::contentBreaks()), options.fault.kind,
                      "fill in headers or poses wrongly, in this way");
    arguments.add("--fault-at SECONDS", options.fault.fromSeconds, "do so from then on")
        .seconds()
        .needs(fault);
}

DeclaredOption addFile(Arguments arguments, SendOptions& options) {
    arguments.beginGroup("A recording");
    const DeclaredOption file = arguments.add(
        "--file FILE", options.file, "send this recording instead of a performance; - for standard input");
    arguments.add("--speed", options.speed, "how fast a recording plays")
        .within(0.001, 1000.0)
        .needs(file)
        .showDefault();
    arguments.flag("--loop", options.loops, "begin a recording again at its end").needs(file);
    auto [since, until] = stage::addRange(arguments, options.range);
    since.needs(file).formerly("--from");
    until.needs(file);
    return file;
}

void addTruth(Arguments arguments, SendOptions& options, DeclaredOption file) {
    arguments.beginGroup("The truth");
    arguments
        .add("--truth FILE", options.truth,
             "write what was really sent to this file, as JSON with monitor's names")
        .excludes(file)
        .needs(arguments.option("--duration"));
    addOutputs(arguments, options.replaces);
}

} // namespace

Command addSendCommand(CommandLine& program) {
    auto options = std::make_shared<SendOptions>();
    Arguments arguments =
        program.addCommand("send", "Send a synthetic performance or a recording to the network");
    addTargets(arguments, *options);
    addPerformer(arguments, *options);
    addFaults(arguments, *options);
    addTruth(arguments, *options, addFile(arguments, *options));
    arguments.verbose(options->isVerbose, "the addresses that it sends from and to");
    return {"send", [options](Console& console) { return send(*options, console); }};
}

} // namespace posewire::cli
