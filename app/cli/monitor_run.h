// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/live_table.h"
#include "app/cli/monitor_options.h"
#include "core/export/monitor_report.h"
#include "core/log/packet_log.h"
#include "core/log/pcapng_writer.h"
#include "core/log/time.h"
#include "core/model/session/session.h"

#include <chrono>

namespace posewire::cli {

/// During its lifetime the first Ctrl+C (or SIGTERM) is only remembered; a second one ends the program. One
/// object at a time.
class Interruption {
public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    [[nodiscard]] bool hasCome() const;
};

/// What monitoring the network and monitoring a file have in common: a log, a session that follows it, what
/// is shown meanwhile and what is said at the end.
class MonitorRun {
public:
    MonitorRun(const MonitorOptions& options, Console& console);

    [[nodiscard]] log::PacketLog& log() { return m_log; }
    [[nodiscard]] const model::SessionView& session() const { return m_session; }

    /// Takes in everything that is in the log.
    void follow(log::Stamp now);

    /// Shows the table if it is time to.
    void show(double elapsedS);

    /// Nobody wants more: Ctrl+C, or the reader of the output has gone.
    [[nodiscard]] bool isOver() const { return m_interruption.hasCome() || !m_console.out.isWanted(); }

    /// Says it all. `status` is what else went wrong.
    [[nodiscard]] ExitStatus conclude(exporting::MonitorFacts facts, ExitStatus status);

private:
    ExitStatus writeReport(const exporting::MonitorFacts& facts);

    const MonitorOptions& m_options;
    Console& m_console;
    Interruption m_interruption;
    log::PacketLog m_log;
    model::Session m_session{m_log};
    const bool m_isTerminal = LiveDisplay::isOnTerminal();
    LiveDisplay m_display{m_isTerminal};
    bool m_isConcluding = false;
    std::chrono::steady_clock::time_point m_nextShow;
};

/// What a recording says about where it was made.
[[nodiscard]] log::RecordingInfo recordingInfo();

} // namespace posewire::cli
