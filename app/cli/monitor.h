// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/command.h"
#include "app/cli/inputs.h"
#include "app/cli/table_writer.h"
#include "app/stage/stage_options.h"
#include "app/system/interruption.h"
#include "app/system/standard_streams.h"
#include "core/export/reports.h"
#include "core/log/recording.h"
#include "core/log/time.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/session/held_up.h"
#include "core/model/session/origin.h"

#include <array>
#include <chrono>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace posewire::cli {

/// A figure that may be limited: `--max-NAME`.
struct Limit {
    std::string_view name;
    model::Figure figure;
    std::string_view help;
};
inline constexpr std::array<Limit, 3> kLimits{
    {{"loss", model::Figure::LossShare, "samples lost or incomplete"},
     {"jitter", model::Figure::Jitter, "jitter as in RFC 3550"},
     {"gap", model::Figure::SpacingMost, "time between successive samples"}}};

/// " %" or " ms", as it follows a number.
[[nodiscard]] std::string unitOf(const Limit& limit);

/// The most that a stream may have of each of kLimits; nothing: anything.
using Limits = std::array<std::optional<double>, kLimits.size()>;

struct MonitorOptions : InputOptions {
    std::string file;           ///< empty: the network
    std::string up;             ///< "y", "z"; others: as detected
    double durationSeconds = 0; ///< 0: until interrupted
    double intervalSeconds = 1;
    std::string record;        ///< empty: not; "-" for standard output
    std::string report;        ///< empty: none; "-" for standard output
    std::string outlet;        ///< of outlets::outletKinds(); empty: none
    std::string to;            ///< its place; empty: where it goes if none is chosen; "-" for standard output
    std::string character;     ///< of outlets that take one
    stage::StageOptions stage; ///< probes to be read, or what part of the file
    std::string metrics;       ///< where figures are served: empty: nowhere; else see outlets::Metrics
    bool replaces = false;
    bool asJson = false;
    bool asJsonLines = false;
    bool isVerbose = false; ///< tells where it listens and who sends
    bool isQuiet = false;   ///< neither tables nor JSON, only the report
    Limits limits;
};

/// Both return when there is nothing more to come, or Ctrl+C was pressed.
ExitStatus monitorNetwork(const MonitorOptions& options, Console& console);
ExitStatus monitorFile(const MonitorOptions& options, Console& console);

/// Asked before long work. The error is one line for the user.
[[nodiscard]] tl::expected<void, std::string> checkOutputs(const MonitorOptions& options);

/// The file of a recording. It exists from then on.
[[nodiscard]] tl::expected<std::unique_ptr<log::ByteSink>, log::FileError>
createRecording(const MonitorOptions& options);
/// A recording to it of what is received.
[[nodiscard]] tl::expected<std::unique_ptr<log::Recording>, log::FileError>
startRecording(const MonitorOptions& options, const log::PacketLog& log);

/// What monitoring the network and monitoring a file have in common: a log, a session that follows it, what
/// is shown meanwhile and what is said at the end. During its lifetime the first Ctrl+C is only remembered,
/// see system::Interruption. One object at a time.
class MonitorRun {
public:
    MonitorRun(const MonitorOptions& options, Console& console);

    [[nodiscard]] log::PacketLog& log() { return m_origin.log(); }
    [[nodiscard]] model::Session& session() { return m_session; }

    /// Takes in everything that is in the log. `isReceiverHeldUp`: what has just come may not be.
    void follow(log::Stamp now, bool isReceiverHeldUp = false);

    /// The same when nothing more is received: no silence until then is doubted. Returns the end, which is
    /// not before anything that came.
    log::Stamp followToEnd(log::Stamp end);

    /// Shows the table if it is time to, or writes a line if one is due at a time of the log.
    void show(const exporting::MonitorFacts& facts, log::Stamp now);

    /// Nobody wants more: Ctrl+C, or the reader of the table has gone and nothing is recorded.
    [[nodiscard]] bool isOver() const;

    [[nodiscard]] log::Reception receptionOf(const exporting::MonitorFacts& facts) const;

    /// Says how much was recorded, and where; if not all of it was, how much that is.
    void tellRecorded(const log::RecordingFigures& recorded, const std::string& path,
                      const std::optional<log::FileError>& failure);

    /// Says that the file was not read to its end, also in the report.
    void tellInterrupted();

    /// Writes what was asked for at the end, standard output last. `status` is what else went wrong; `facts`
    /// may name what was exceeded already. What has been missing until `end` is a gap too.
    [[nodiscard]] ExitStatus conclude(exporting::MonitorFacts facts, ExitStatus status,
                                      std::optional<log::Stamp> end);

private:
    void takeIn(log::Stamp now);
    void tellSenders();
    ExitStatus writeReport(const exporting::MonitorFacts& facts);
    void showLine(log::Stamp now);
    [[nodiscard]] bool isReaderGone() const { return m_table && !m_table->isWanted(); }
    ExitStatus finishTable(const exporting::MonitorFacts& facts);

    const MonitorOptions& m_options;
    Console& m_console;
    system::Interruption m_interruption;
    model::Origin m_origin;
    model::Session& m_session = m_origin.session();
    model::HeldUp m_heldUp;
    const bool m_isTerminal = system::isTerminal(system::kStandardOutput);
    std::optional<TableWriter> m_table; ///< where tables or lines were asked for
    exporting::VerdictLines m_lines;
    std::uint64_t m_linesLeftOut = 0;
    bool m_isConcluding = false;
    bool m_isReaderTold = false;
    bool m_isInterrupted = false;          ///< amidst a file
    std::set<log::SenderId> m_toldSenders; ///< those that the session lists
    std::chrono::steady_clock::time_point m_nextShow;
};

[[nodiscard]] log::RecordingInfo recordingInfo();

} // namespace posewire::cli
