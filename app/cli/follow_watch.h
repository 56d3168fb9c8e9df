// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/monitor.h"
#include "app/outlets/pose_outlet.h"

#include <memory>
#include <optional>

namespace posewire::cli {

/// The poses of `follow` while the network is monitored: to standard output, or to all who connect.
class FollowWatch {
public:
    FollowWatch(MonitorRun& run, Console& console) : m_run(run), m_console(console) {}

    /// Starts the outlet if the options ask for one; false, with a complaint, if it fails.
    [[nodiscard]] bool start(const MonitorOptions& options, const log::Clock& clock);
    /// To be called each time after the session has followed the log.
    void look();
    /// True once the reader of standard output has gone.
    [[nodiscard]] bool isOver() const { return m_lines && !m_lines->isWanted(); }
    /// Says how much was sent, and what was not.
    void end();

private:
    MonitorRun& m_run;
    Console& m_console;
    std::optional<TableWriter> m_lines; ///< to standard output
    std::unique_ptr<outlets::PoseOutlet> m_outlet;
};

} // namespace posewire::cli
