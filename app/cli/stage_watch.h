// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/monitor.h"
#include "app/stage/stage_reader.h"

#include <memory>
#include <set>
#include <string>

namespace posewire::cli {

/// The probes of a stage while `monitor` reads them.
class StageWatch {
public:
    StageWatch(MonitorRun& run, Console& console) : m_run(run), m_console(console) {}

    /// Begins to read if the options ask for it.
    void start(const stage::StageOptions& options, net::Receiver& receiver, const log::Clock& clock);
    /// Reports what is wrong whenever that changes.
    void look(log::Stamp now);
    /// Ends reading. Returns Unusable if no probe was heard of because of an error.
    ExitStatus end();

private:
    MonitorRun& m_run;
    Console& m_console;
    std::unique_ptr<stage::StageReader> m_reader;
    std::string m_problem;        ///< reported last
    std::set<std::string> m_told; ///< reports that come once
};

} // namespace posewire::cli
