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

    /// Begins to read, if the options ask for it.
    void start(const stage::StageOptions& options, net::Receiver& receiver, const log::Clock& clock);
    /// Says what is wrong when that changes.
    void look(log::Stamp now);
    /// Nothing more comes of it. Unusable if nothing came for what was wrong until now.
    ExitStatus end();

private:
    MonitorRun& m_run;
    Console& m_console;
    std::unique_ptr<stage::StageReader> m_reader;
    std::string m_problem;        ///< told last
    std::set<std::string> m_told; ///< what is told once
};

} // namespace posewire::cli
