// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/datagram_pacer.h"
#include "app/cli/monitor.h"
#include "app/outlets/outlet.h"
#include "core/log/file_names.h"
#include "core/log/recording_file.h"

#include <array>
#include <memory>

namespace posewire::cli {

namespace {

/// Brings the records of a file into the log, as fast as they are followed, with their own stamps; where
/// there are none, time codes space them.
class Replay {
public:
    Replay(const MonitorOptions& options, MonitorRun& run, std::optional<log::Recorder>& recorder)
        : m_run(run),
          m_recorder(recorder),
          m_clock(run.log().timeline()),
          m_name(log::nameOf(log::pathOf(options.file).filename())),
          m_followsClosely(options.asJsonLines),
          m_interval(log::durationOf(options.intervalSeconds)),
          m_longest(options.durationSeconds > 0 ? log::durationOf(options.durationSeconds)
                                                : log::Duration::max()) {}

    void operator()(const log::FileRecord& record) {
        if (m_isDone) {
            return;
        }
        m_heard = std::chrono::steady_clock::now();
        const log::Stamp stamp =
            record.time ? m_clock.stampOf(*record.time, record.setBy) : log::Stamp(*m_pacer.due(record));
        m_first = m_first.value_or(stamp);
        m_isCutShort = m_run.isOver();
        m_isDone = stamp - *m_first > m_longest || m_isCutShort || !m_recorded;
        if (m_isDone) {
            return;
        }
        tellSilenceUntil(stamp);
        m_last = std::max(m_last.value_or(stamp), stamp);
        auto& log = m_run.log();
        const log::SenderId sender =
            log.senders().intern(record.sender.value_or(log::SenderInfo{m_name, log::Transport::File, 0}));
        log.writer().append(record.bytes, log::arrivalOf(record, sender, stamp));
        constexpr std::size_t batch = 4096;
        const bool isLineDue = m_followsClosely && *m_last - m_flushed >= kLineStep;
        if (++m_waiting == batch || isLineDue) {
            flush();
        }
    }

    void flush() {
        m_waiting = 0;
        m_flushed = m_last.value_or(log::Stamp());
        m_run.log().writer().publish();
        m_run.follow(m_last.value_or(log::Stamp()));
        if (m_recorder && m_recorded) {
            m_recorded = m_recorder->follow();
        }
        m_run.show({.durationS = durationS()}, m_last.value_or(log::Stamp()));
    }

    void takeNotes(std::span<const std::string_view> notes) {
        if (const auto reception = log::receptionIn(notes); reception && !m_isDone) {
            m_reception = reception;
        }
    }

    /// All of it is there. Limits count until it was ended.
    void end() {
        flush();
        if (m_last && m_reception) {
            *m_last += m_reception->afterLast;
        }
    }

    /// The latest stamp, in the end when nothing more was received.
    [[nodiscard]] std::optional<log::Stamp> last() const { return m_last; }
    [[nodiscard]] double durationS() const {
        const log::Duration time = m_reception ? m_reception->time
                                   : m_last    ? *m_last - *m_first
                                               : log::Duration::zero();
        return log::secondsOf(time);
    }
    [[nodiscard]] std::int64_t receiveBufferBytes() const {
        return m_reception ? static_cast<std::int64_t>(m_reception->receiveBufferBytes) : 0;
    }
    /// Nothing more is looked at.
    [[nodiscard]] bool isDone() const { return m_isDone; }
    /// A pipe has had nothing for as long as all of it was to last.
    [[nodiscard]] bool isSilent() const {
        return m_longest != log::Duration::max() && std::chrono::steady_clock::now() - m_heard >= m_longest;
    }
    /// There was more, but nobody wanted it.
    [[nodiscard]] bool isCutShort() const { return m_isCutShort; }
    [[nodiscard]] const log::Recorder::Result& recorded() const { return m_recorded; }

private:
    static constexpr log::Duration kLineStep = std::chrono::milliseconds(10);

    /// Lines come in a silence too, when it turns the verdict and each interval: closely while it is new.
    void tellSilenceUntil(log::Stamp stamp) {
        constexpr log::Duration kSilentStep = std::chrono::milliseconds(50);
        constexpr log::Duration kNew = std::chrono::seconds(2);
        constexpr int kMostSteps = 10'000;
        if (!m_followsClosely || !m_last || stamp - *m_last <= kSilentStep) {
            return;
        }
        flush();
        const log::Stamp from = *m_last;
        log::Stamp now = from + kSilentStep;
        for (int steps = 0; now < stamp && steps < kMostSteps && !m_run.isOver(); ++steps) {
            m_run.follow(now);
            m_run.show({.durationS = durationS()}, now);
            now += now - from < kNew ? kSilentStep : std::max(m_interval, kSilentStep);
        }
    }

    MonitorRun& m_run;
    std::optional<log::Recorder>& m_recorder;
    log::RecordedClock m_clock;
    const std::string m_name;
    const bool m_followsClosely; ///< so that lines come when the verdict changes
    const log::Duration m_interval;
    const log::Duration m_longest;
    DatagramPacer m_pacer{1.0 / 240, 1.0};
    std::size_t m_waiting = 0;
    log::Stamp m_flushed{};
    std::optional<log::Stamp> m_first;
    std::optional<log::Stamp> m_last;
    std::optional<log::Reception> m_reception;
    bool m_isDone = false;
    bool m_isCutShort = false;
    std::chrono::steady_clock::time_point m_heard = std::chrono::steady_clock::now(); ///< the newest record
    log::Recorder::Result m_recorded;
};

} // namespace

ExitStatus monitorFile(const MonitorOptions& options, Console& console) {
    MonitorRun run(options, console);
    const Replay* reading = nullptr; // a file may have no end
    const auto isOver = [&] {
        return run.isOver() || (reading != nullptr && (reading->isDone() || reading->isSilent()));
    };
    const auto file =
        options.stage.isAsked() ? stage::openPast(options.stage, isOver) : openInput(options.file, isOver);
    if (!file) {
        return console.unusable(file.error().text);
    }
    if (const auto checked = checkOutputs(options); !checked) {
        return console.unusable(checked.error());
    }
    std::unique_ptr<log::ByteSink> sink;
    std::optional<log::Recorder> recorder;
    if (!options.record.empty()) {
        auto created = createRecording(options);
        if (!created) {
            return console.unusable(created.error().text);
        }
        sink = std::move(*created);
        recorder.emplace(run.log(), *sink);
        if (const auto begun = recorder->begin(recordingInfo()); !begun) {
            return console.unusable(begun.error().text);
        }
    }
    Replay replay(options, run, recorder);
    reading = &replay;
    log::FileContents contents;
    const auto takeNotes = [&replay](std::span<const std::string_view> notes) { replay.takeNotes(notes); };
    WatchedInput input(**file, contents, console.complain);
    const auto read = log::readFile(input, std::ref(replay), takeNotes, &contents);
    replay.end();
    log::Recorder::Result recorded = replay.recorded();
    if (recorder && recorded) {
        recorded = recorder->finish();
    }
    ExitStatus status = readingStatus(read, contents, (*file)->name(), console);
    const bool isCancelled = !read && read.error().kind == log::FileError::Kind::Cancelled;
    if (system::Interruption::hasCome() && (replay.isCutShort() || (isCancelled && !replay.isDone()))) {
        run.tellInterrupted();
    }
    if (!recorded) {
        status = console.unusable(recorded.error().text);
    }
    if (recorder) {
        run.tellRecorded(recorder->figures(), options.record,
                         recorded ? std::nullopt : std::optional(recorded.error()));
    }
    exporting::MonitorFacts facts;
    facts.durationS = replay.durationS();
    facts.receiveBufferBytes = replay.receiveBufferBytes();
    return run.conclude(facts, status, replay.last());
}

namespace {

void addPlacesOrFile(Arguments arguments, MonitorOptions& options) {
    const auto places = addPlaces(arguments, options);
    DeclaredOption file =
        arguments.add("FILE", options.file,
                      "a recording instead of the network, as fast as it goes, with its own "
                      "stamps: pcap, pcapng, MVNX, or datagrams back to back; - for standard input");
    for (const DeclaredOption place : places) {
        file.excludes(place);
    }
}

void addLimits(Arguments arguments, Limits& limits) {
    for (std::size_t i = 0; i < kLimits.size(); ++i) {
        const bool isShare = unitOf(kLimits[i]) == " %";
        const DeclaredOption limit =
            arguments.add("--max-" + std::string(kLimits[i].name) + (isShare ? " PERCENT" : " MS"), limits[i],
                          std::string(kLimits[i].help));
        (isShare ? DeclaredOption(limit).within(0.0, 100.0) : DeclaredOption(limit).milliseconds())
            .group("Limits (of each stream; where one is exceeded the exit status is 1)");
    }
}

/// Declares what all commands have that hand on what is received.
Command withOutlet(const std::string& name, Arguments arguments,
                   const std::shared_ptr<MonitorOptions>& options) {
    options->isQuiet = true;
    addPlaces(arguments, *options);
    stage::addStageSince(arguments, options->stage);
    addDuration(arguments, options->durationSeconds);
    addUp(arguments, options->up);
    arguments.verbose(options->isVerbose, "where it listens and each new sender");
    return {name, [options](Console& console) { return monitorNetwork(*options, console); }};
}

} // namespace

Command addMonitorCommand(CommandLine& program) {
    auto options = std::make_shared<MonitorOptions>();
    Arguments arguments = program.addCommand(
        "monitor", "Watch streams: rate, loss, duplicates, order, jitter, gaps; record them; keep limits");
    addPlacesOrFile(arguments, *options);
    const DeclaredOption nats =
        stage::addStageSince(arguments, options->stage).excludes(arguments.option("FILE"));
    arguments.add("--until TIME", options->stage.until, "and until then, or so many seconds later")
        .group("Servers of a stage")
        .needs(nats);
    arguments
        .add("--duration SECONDS", options->durationSeconds,
             "stop after this many seconds; 0: when interrupted, or at the end of FILE")
        .seconds()
        .showDefault();
    DeclaredOption lines =
        arguments.flag("--json-lines", options->asJsonLines,
                       "an object a line instead of a live table, each interval and when the "
                       "verdict changes: verdict, characters, incidents that changed");
    lines.excludes(
        arguments.flag("--json", options->asJson, "one report at the end instead of a live table"));
    arguments.add("--interval SECONDS", options->intervalSeconds, "seconds between two tables or lines")
        .within(0.001, 86'400.0)
        .showDefault();
    arguments.add("--record FILE", options->record,
                  "write everything received there as pcapng; - for standard output, instead of the table");
    arguments.add("--report FILE", options->report,
                  "write a report there as HTML: what was received, what not, and whose fault it was");
    arguments
        .add("--metrics [ADDRESS:]PORT", options->metrics,
             "serve the figures there for Prometheus, at http://ADDRESS:PORT/metrics; PORT alone is for this "
             "computer only")
        .excludes(arguments.option("FILE"));
    addOutputs(arguments, options->replaces);
    addUp(arguments, options->up);
    arguments.verbose(options->isVerbose,
                      "where it listens and each new sender; the JSON then has what is kept in memory, too");
    addLimits(arguments, options->limits);
    return {"monitor", [options](Console& console) {
                options->isQuiet = options->record == "-";
                options->file = options->stage.isPast() ? options->stage.pastName() : options->file;
                return options->file.empty() ? monitorNetwork(*options, console)
                                             : monitorFile(*options, console);
            }};
}

Command addFollowCommand(CommandLine& program) {
    auto options = std::make_shared<MonitorOptions>();
    options->outlet = "follow";
    Arguments arguments = program.addCommand(
        "follow", "Poses of all characters as they are received, for other programs: JSON, one on each line");
    arguments.add("--to PLACE", options->to,
                  "to all who connect there instead of standard output: PORT of this computer alone, "
                  "ADDRESS:PORT, or unix:PATH");
    return withOutlet("follow", arguments, options);
}

Command addOutletCommand(CommandLine& program) {
    auto options = std::make_shared<MonitorOptions>();
    std::string kinds;
    std::string places;
    for (const outlets::OutletKind& kind : outlets::outletKinds()) {
        kinds += (kinds.empty() ? "" : "; ") + std::string(kind.name) + ": " + kind.help;
        if (!kind.place.empty() && kind.place != "-") {
            places += "; " + std::string(kind.place) + " for " + std::string(kind.name);
        }
    }
    Arguments arguments =
        program.addCommand("outlet", "Hand on what is received, in a form that other programs read");
    const auto readKind = [options](const std::string& text) {
        options->outlet = text;
        return outlets::findOutletKind(text) != nullptr ? std::string() : "there is no outlet " + text;
    };
    arguments.read("KIND", readKind, kinds).required();
    arguments.add("--to PLACE", options->to, "HOST:PORT of the receiver; of follow as there" + places);
    arguments.add("--character NAME", options->character,
                  "for vmc: a name or ID; the first one if it is not given");
    return withOutlet("outlet", arguments, options);
}

Command addReportCommand(CommandLine& program) {
    auto options = std::make_shared<MonitorOptions>();
    options->isQuiet = true;
    Arguments arguments = program.addCommand(
        "report",
        "Write a report on a recording as HTML: what was received, what not, and whose fault it was");
    stage::addStage(arguments, options->stage)
        .excludes(arguments.add("FILE", options->file,
                                "pcap, pcapng, MVNX, or datagrams back to back; - for standard input"));
    arguments.add("-o,--output FILE", options->report, "the HTML file; - for standard output").required();
    addUp(arguments, options->up);
    addOutputs(arguments, options->replaces);
    auto [since, until] = stage::addRange(arguments, options->stage);
    since.formerly("--from");
    until.formerly("--to");
    return {"report", [options](Console& console) {
                options->file = options->stage.isAsked() ? options->stage.pastName() : options->file;
                if (options->file.empty()) {
                    return console.unusable("FILE is missing: the recording that the report is to be about");
                }
                return monitorFile(*options, console);
            }};
}

} // namespace posewire::cli
