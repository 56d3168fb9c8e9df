// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/monitor.h"
#include "app/outlets/outlet.h"

#include <memory>
#include <optional>
#include <vector>

namespace posewire::cli {

/// The outlet of `outlet` or `follow` while the network is monitored.
class OutletWatch {
public:
    OutletWatch(MonitorRun& run, Console& console) : m_run(run), m_console(console) {}

    /// Starts the outlet if the options ask for one; false, with a complaint, if it fails. Nothing is sent
    /// back into `inputs`.
    [[nodiscard]] bool start(const MonitorOptions& options, const log::Clock& clock,
                             std::vector<net::InputStatus> inputs);
    /// To be called each time after the session has followed the log.
    void look();
    /// True once the reader of standard output has gone.
    [[nodiscard]] bool isOver() const { return m_lines && !m_lines->isWanted(); }
    /// Says how much was sent, and what was not.
    void end();

private:
    [[nodiscard]] net::NetResult<std::unique_ptr<outlets::Outlet>>
    started(const outlets::OutletChoice& choice, const outlets::OutletPlace& place);

    MonitorRun& m_run;
    Console& m_console;
    const outlets::OutletKind* m_kind = nullptr;
    std::string m_problem;              ///< told last
    std::optional<TableWriter> m_lines; ///< to standard output
    std::unique_ptr<outlets::Outlet> m_outlet;
};

} // namespace posewire::cli
