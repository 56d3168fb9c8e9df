// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/inputs.h"
#include "app/stage/batch_order.h"
#include "app/stage/probe.h"
#include "app/stage/stage_options.h"
#include "app/system/interruption.h"
#include "app/system/process_figures.h"
#include "app/usage/usage.h"
#include "core/log/file_names.h"

#include <QStandardPaths>
#include <QSysInfo>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <thread>

namespace posewire::cli {
namespace {

struct ProbeOptions : InputOptions {
    stage::StageOptions stage;
    std::string name;
    std::string spool;             ///< folder; empty: the usual one
    double spoolMegabytes = 1'000; ///< the most
    double durationSeconds = 0;    ///< 0: until interrupted
    bool isVerbose = false;
};

struct StreamOptions {
    stage::StageOptions stage;
    std::optional<double> keepHours;
    std::optional<double> gigabytes;
    int replicas = 1;
};

std::string usualSpool(const ProbeOptions& options) {
    const QString data = QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation);
    return data.toStdString() + "/posewire/probe/" + options.stage.site + '-' + options.name;
}

/// The health of the receiver, as a JSON object.
std::string healthOf(net::Receiver& receiver) {
    const net::ReceiveTotals totals = receiver.totals();
    nlohmann::ordered_json health{{"version", usage::version()},
                                  {"host", QSysInfo::machineHostName().toStdString()},
                                  {"datagrams", totals.datagrams},
                                  {"bytes", totals.bytes},
                                  {"kernelDropped", totals.kernelDropped},
                                  {"receiveBufferBytes", totals.receiveBufferBytes},
                                  {"refusedDatagrams", totals.refusedDatagrams},
                                  {"noPort", totals.kernel.noPort},
                                  {"reassemblyFailures", totals.kernel.reassemblyFailures}};
    if (const auto seconds = system::processCpuSeconds()) {
        health["cpuSeconds"] = *seconds;
    }
    if (const auto bytes = system::processMemoryBytes()) {
        health["memoryBytes"] = *bytes;
    }
    return health.dump();
}

/// Reports what is wrong whenever that changes.
class ProbeWatch {
public:
    ProbeWatch(const net::Receiver& receiver, const stage::Probe& probe, Console& console)
        : m_receiver(receiver), m_probe(probe), m_console(console) {}

    void look() {
        const stage::ProbeFigures figures = m_probe.figures();
        tell(figures.problem, m_problem, "stored again");
        if (!figures.refusal.empty()) {
            tell(figures.refusal, m_refusal, {});
        }
        for (const net::InputStatus& input : m_receiver.inputs()) {
            tell(input.problem, m_inputs[input.id], placeOf(input) + ": all is well now");
        }
        if (figures.hasTwin && !std::exchange(m_hasTwin, true)) {
            m_console.complain("another probe of this name publishes too; give one of them another name");
        }
        if (figures.gone > m_gone) {
            m_console.complain(
                std::to_string(figures.gone - std::exchange(m_gone, figures.gone)) +
                " packets had to go before a server took them: the spool is full; give it more "
                "with --spool-limit");
        }
    }

private:
    void tell(const std::string& problem, std::string& before, const std::string& well) {
        if (std::exchange(before, problem) != problem) {
            m_console.complain(problem.empty() ? well : problem);
        }
    }

    const net::Receiver& m_receiver;
    const stage::Probe& m_probe;
    Console& m_console;
    std::string m_problem;
    std::string m_refusal;
    std::map<net::InputId, std::string> m_inputs;
    bool m_hasTwin = false;
    std::uint64_t m_gone = 0;
};

ExitStatus runProbe(const ProbeOptions& options, Console& console) {
    using namespace std::chrono;
    if (const auto problem = options.stage.problem()) {
        return console.unusable(*problem);
    }
    if (!stage::isName(options.name)) {
        return console.unusable("--name: may have letters, digits, - and _, 64 at most");
    }
    const auto places = placesOf(options);
    if (!places) {
        return console.unusable(places.error());
    }
    const SocketApplication application;

    const system::Interruption interruption;
    const log::SystemClock clock;
    log::PacketLog log({.memoryCap = std::size_t{96} << 20});
    net::Receiver receiver(log, clock);
    stage::Probe probe(log, clock,
                       {options.stage.servers, options.stage.site, options.name,
                        options.spool.empty() ? usualSpool(options) : options.spool,
                        static_cast<std::uint64_t>(options.spoolMegabytes * 1e6)},
                       [&receiver] { return healthOf(receiver); });
    if (!openInputs(*places, options, options.isVerbose, receiver, console)) {
        return ExitStatus::Unusable;
    }
    ProbeWatch watch(receiver, probe, console);
    const auto start = steady_clock::now();
    const auto isOver = [&] {
        const duration<double> elapsed = steady_clock::now() - start;
        return system::Interruption::hasCome() ||
               (options.durationSeconds > 0 && elapsed.count() >= options.durationSeconds);
    };
    while (!isOver()) {
        std::this_thread::sleep_for(milliseconds(50));
        watch.look();
    }
    for (const net::InputStatus& input : receiver.inputs()) {
        receiver.remove(input.id); // what has arrived there still comes into the log
    }
    return ExitStatus::Fine;
}

std::string limitText(const stage::StreamState& state) {
    const auto hours = std::chrono::duration<double, std::ratio<3600>>(state.limits.age).count();
    std::string text = state.limits.age == log::Duration::zero()
                           ? "without a limit of time"
                           : "for " + std::to_string(std::llround(hours * 10) / 10) + " h";
    text += state.limits.bytes < 0 ? ", without a limit of size"
                                   : ", at most " + std::to_string(state.limits.bytes / 1'000'000) + " MB";
    return text + ", on " + std::to_string(state.limits.replicas) +
           (state.limits.replicas == 1 ? " server" : " servers");
}

ExitStatus runStage(const StreamOptions& options, Console& console) {
    if (const auto problem = options.stage.problem()) {
        return console.unusable(*problem);
    }
    const auto server = stage::Server::connect(options.stage.servers, "posewire-cli stage");
    if (!server) {
        return console.unusable(server.error().text);
    }
    const stage::StreamLimits limits{log::durationOf(options.keepHours.value_or(0) * 3600),
                                     options.gigabytes ? std::llround(*options.gigabytes * 1e9) : -1,
                                     options.replicas};
    const auto state = options.keepHours ? (*server)->setStream(options.stage.site, limits)
                                         : (*server)->stream(options.stage.site);
    if (!state) {
        return console.unusable(state.error().text);
    }
    console.out.write(options.stage.site + ": kept " + limitText(*state) + "; " +
                      std::to_string(state->messages) + " batches, " +
                      std::to_string(state->bytes / 1'000'000) + " MB now" +
                      (state->leader.empty() ? "" : "; led by " + state->leader) + '\n');
    return ExitStatus::Fine;
}

} // namespace

Command addProbeCommand(CommandLine& program) {
    auto options = std::make_shared<ProbeOptions>();
    Arguments arguments = program.addCommand(
        "probe", "Receive here, and publish it to servers of NATS for windows elsewhere; needs no display");
    addPlaces(arguments, *options);
    stage::addStage(arguments, options->stage).required();
    arguments.add("--name NAME", options->name, "of this probe, which no other of the site may have")
        .required();
    arguments.add("--spool FOLDER", options->spool,
                  "where it keeps what no server takes; else in the data folder of this user");
    arguments.add("--spool-limit MB", options->spoolMegabytes, "the most it keeps there")
        .within(16.0, 1e9)
        .showDefault();
    addDuration(arguments, options->durationSeconds);
    arguments.verbose(options->isVerbose, "where it listens");
    return {"probe", [options](Console& console) { return runProbe(*options, console); }};
}

Command addStageCommand(CommandLine& program) {
    auto options = std::make_shared<StreamOptions>();
    Arguments arguments = program.addCommand(
        "stage", "Show how long servers of NATS keep what the probes of a site publish; set it");
    stage::addStage(arguments, options->stage).required();
    DeclaredOption keep =
        arguments
            .add("--keep HOURS", options->keepHours, "keep it for so long; makes the stream if there is none")
            .within(0.0, 100'000.0);
    arguments.add("--most GB", options->gigabytes, "the oldest goes where there is more").needs(keep);
    arguments.add("--replicas N", options->replicas, "servers that each have all of it")
        .within(1, 5)
        .needs(keep)
        .showDefault();
    return {"stage", [options](Console& console) { return runStage(*options, console); }};
}

} // namespace posewire::cli
