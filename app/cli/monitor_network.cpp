// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/outlet_watch.h"
#include "app/cli/stage_watch.h"
#include "app/net/connection_help.h"
#include "app/outlets/metrics.h"
#include "app/system/process_figures.h"
#include "app/system/sleep.h"
#include "app/usage/usage.h"
#include "core/model/session/roster.h"
#include "core/words/say.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <future>
#include <map>

namespace posewire::cli {
namespace {

/// Reports the failure of a recording at once, and only once, and each file of it that is gone.
class RecordingWatch {
public:
    RecordingWatch(MonitorRun& run, Console& console) : m_run(run), m_console(console) {}

    [[nodiscard]] bool start(const MonitorOptions& options) {
        auto started = startRecording(options, m_run.log());
        if (!started) {
            m_console.complain(started.error().text);
            return false;
        }
        m_recording = std::move(*started);
        system::preventSleep(m_recording != nullptr);
        return true;
    }

    void look(log::Stamp now) {
        if (m_recording && !hasFailed()) {
            tellDisplaced(now);
            note(m_recording->failure(), now);
        }
    }
    [[nodiscard]] bool hasFailed() const { return m_failure.has_value(); }
    ExitStatus stop(const log::Reception& reception, log::Stamp now) {
        if (!m_recording) {
            return ExitStatus::Fine;
        }
        if (!hasFailed()) {
            const auto failure = finish(reception);
            tellDisplaced(now);
            note(failure, now);
        }
        const log::RecordingFigures recorded = m_recording->figures();
        m_run.tellRecorded(recorded, recorded.path, m_failure);
        return hasFailed() || m_displaced > 0 ? ExitStatus::Unusable
               : recorded.missed > 0          ? ExitStatus::Faults
                                              : ExitStatus::Fine;
    }

private:
    /// A slow disk may take its time for what it has still to get. Why the file is not whole, if it is not.
    std::optional<log::FileError> finish(const log::Reception& reception) {
        constexpr std::chrono::seconds kPatience(1);
        auto stopped = std::async(std::launch::async,
                                  [&] { return m_recording->stop({log::receptionText(reception)}); });
        if (stopped.wait_for(kPatience) != std::future_status::ready) {
            m_console.complain("the recording is still being written; Ctrl+C again gives up the rest of it");
        }
        const auto result = stopped.get();
        return result ? std::nullopt : std::optional(result.error());
    }
    void note(const std::optional<log::FileError>& failure, log::Stamp now) {
        m_failure = failure;
        if (failure) {
            m_console.complain(failure->text);
            m_run.session().report(model::IncidentKind::RecordingEnded, now,
                                   {words::Kind::RecordingEnded, {{"problem", failure->text}}});
        }
    }
    void tellDisplaced(log::Stamp now) {
        const std::vector<log::Displaced> all = m_recording->figures().displaced;
        for (; m_displaced < all.size(); ++m_displaced) {
            const words::Fact fact = model::factOf(all[m_displaced]);
            m_console.complain(say(fact, words::Form::Headline));
            m_run.session().report(model::IncidentKind::RecordingEnded, now, fact);
        }
    }

    std::unique_ptr<log::Recording> m_recording;
    MonitorRun& m_run;
    Console& m_console;
    std::size_t m_displaced = 0; ///< that were told
    std::optional<log::FileError> m_failure;
};

/// Says what is wrong with an input, once, and when it is well again; and which connections were turned away,
/// when that begins and at the end.
class InputWatch {
public:
    InputWatch(const net::Receiver& receiver, Console& console) : m_receiver(receiver), m_console(console) {}

    void look(const model::SessionView& session, const log::KernelCounters& kernel, log::Stamp now) {
        tellHelp(session, kernel, now);
        for (const net::InputStatus& input : m_receiver.inputs()) {
            Told& told = m_told[input.id];
            if (told.note.empty()) {
                tellNote(input, told);
            }
            if (told.problem != input.problem) {
                told.problem = input.problem;
                m_console.complain(told.problem.empty() ? placeOf(input) + ": all is well now"
                                                        : told.problem);
            }
        }
    }
    void end() {
        for (const net::InputStatus& input : m_receiver.inputs()) {
            tellNote(input, m_told[input.id]);
        }
    }

    /// A line for each sender that we were to connect to and that has sent nothing.
    [[nodiscard]] std::vector<std::string> silent() const {
        std::vector<std::string> lines;
        for (const net::InputStatus& input : m_receiver.inputs()) {
            if (input.kind == net::InputKind::TcpConnection && input.datagrams == 0) {
                lines.push_back(net::textOf(input.endpoint) + ": nothing was received");
            }
        }
        return lines;
    }

private:
    struct Told {
        std::string problem;
        std::string note;
    };

    /// Suggests reasons if no MXTP has come for some seconds.
    void tellHelp(const model::SessionView& session, const log::KernelCounters& kernel, log::Stamp now) {
        constexpr log::Duration kPatience = std::chrono::seconds(3);
        constexpr log::Duration kStep = std::chrono::milliseconds(500);
        if (now < m_nextHelp || !session.roster().streams().empty()) {
            return;
        }
        m_nextHelp = now + kStep;
        m_begin = m_begin.value_or(now);
        for (const words::Fact& finding : m_watch.look(session, m_receiver.inputs(), {}, kernel, now)) {
            const std::string advice = say(finding, words::Form::Advice);
            if (now - *m_begin >= kPatience && !advice.empty() && m_advised.insert(advice).second) {
                m_console.complain(say(finding, words::Form::Sentence) + ' ' + advice);
            }
        }
    }
    void tellNote(const net::InputStatus& input, Told& told) {
        if (told.note != input.note) {
            told.note = input.note;
            m_console.complain(placeOf(input) + ": " + told.note);
        }
    }

    const net::Receiver& m_receiver;
    Console& m_console;
    std::map<net::InputId, Told> m_told;
    net::ConnectionWatch m_watch;
    log::Stamp m_nextHelp{};
    std::optional<log::Stamp> m_begin;
    std::set<std::string> m_advised;
};

struct Watches {
    RecordingWatch recording;
    InputWatch inputs;
    OutletWatch outlet;
    StageWatch stage;
    std::unique_ptr<outlets::Metrics> metrics; ///< null if they are not asked for
};

/// False, with a complaint, if metrics are asked for and cannot be served.
bool serveMetrics(const MonitorOptions& options, Watches& watches, Console& console) {
    if (options.metrics.empty()) {
        return true;
    }
    auto served = outlets::Metrics::serve(options.metrics, std::string(usage::version()));
    console.complain(served ? "metrics are at " + (*served)->address() : "--metrics: " + served.error().text);
    watches.metrics = served ? std::move(*served) : nullptr;
    return watches.metrics != nullptr;
}

exporting::MonitorFacts factsOf(const net::Receiver& receiver, double elapsedS) {
    const net::ReceiveTotals totals = receiver.totals();
    exporting::MonitorFacts facts;
    facts.durationS = elapsedS;
    facts.receiveBufferBytes = totals.receiveBufferBytes;
    facts.refusedDatagrams = totals.refusedDatagrams;
    return facts;
}

/// Until the time is over or nobody wants more. Returns how long it was.
double watch(const MonitorOptions& options, net::Receiver& receiver, MonitorRun& run, Watches& watches,
             std::chrono::steady_clock::time_point start) {
    using namespace std::chrono;
    // Lines report a verdict or a pose without delay.
    const duration<double> pause{options.asJsonLines || !options.outlet.empty() ? 0.01 : 0.05};
    const log::SystemClock clock;
    while (true) {
        const duration<double> elapsed = steady_clock::now() - start;
        const duration<double> left{options.durationSeconds - elapsed.count()};
        const bool hasEnd = options.durationSeconds > 0;
        const log::Stamp now = run.log().timeline().now(clock);
        const log::KernelCounters kernel = receiver.totals().kernel;
        run.session().setKernel(kernel);
        run.follow(now, receiver.isHeldUp());
        watches.outlet.look();
        if (watches.metrics != nullptr && watches.metrics->isDue(now)) {
            watches.metrics->update(run.session(),
                                    {receiver.takeBufferFill(), receiver.totals().refusedDatagrams,
                                     system::processCpuSeconds(), system::processMemoryBytes()});
        }
        run.show(factsOf(receiver, elapsed.count()), now);
        watches.recording.look(now);
        if (!options.stage.isAsked()) {
            watches.inputs.look(run.session(), kernel, now);
        }
        watches.stage.look(now);
        const bool isInVain = options.record == "-" && watches.recording.hasFailed();
        if (run.isOver() || watches.outlet.isOver() || isInVain || (hasEnd && left.count() <= 0)) {
            return elapsed.count();
        }
        std::this_thread::sleep_for(hasEnd ? std::min(pause, left) : pause);
    }
}

} // namespace

ExitStatus monitorNetwork(const MonitorOptions& options, Console& console) {
    if (const auto problem = options.stage.isAsked() ? options.stage.problem() : std::nullopt) {
        return console.unusable(*problem);
    }
    auto places = placesOf(options);
    if (places && options.stage.isAsked() && options.udp.empty() && options.multicast.empty()) {
        places->udp.clear(); // probes alone
    }
    if (!places) {
        return console.unusable(places.error());
    }
    if (const auto checked = checkOutputs(options); !checked) {
        return console.unusable(checked.error());
    }
    const SocketApplication application;

    const log::SystemClock clock;
    MonitorRun run(options, console);
    auto receiver = std::make_unique<net::Receiver>(run.log(), clock);
    if (!openInputs(*places, options, options.isVerbose, *receiver, console)) {
        return ExitStatus::Unusable;
    }
    const auto start = std::chrono::steady_clock::now();
    Watches watches{{run, console}, {*receiver, console}, {run, console}, {run, console}, nullptr};
    // A recording is begun once there is something to record.
    if (!serveMetrics(options, watches, console) ||
        (!options.record.empty() && !watches.recording.start(options)) ||
        !watches.outlet.start(options, clock, receiver->inputs())) {
        return ExitStatus::Unusable;
    }
    watches.stage.start(options.stage, *receiver, clock);
    const double elapsedS = watch(options, *receiver, run, watches, start);
    watches.outlet.end();
    const log::Stamp over = run.log().timeline().now(clock);
    exporting::MonitorFacts facts = factsOf(*receiver, elapsedS);
    facts.exceeded = watches.inputs.silent();
    watches.inputs.end();
    const ExitStatus read = watches.stage.end(); // it brings what it has to the receiver
    receiver.reset();                            // what is in the sockets still comes into the log
    const log::Stamp end = run.followToEnd(over);
    const ExitStatus recorded = watches.recording.stop(run.receptionOf(facts), end);
    return run.conclude(facts, worse(read, recorded), end);
}

} // namespace posewire::cli
