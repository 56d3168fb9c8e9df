// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/stage_watch.h"

#include <utility>

namespace posewire::cli {

void StageWatch::start(const StageOptions& options, net::Receiver& receiver, const log::Clock& clock) {
    if (options.isAsked()) {
        m_reader = std::make_unique<stage::StageReader>(
            receiver, m_run.log(), clock,
            stage::StageChoice{options.servers, options.site, wallTimeOf(options.since)});
    }
}

void StageWatch::look() {
    if (m_reader == nullptr) {
        return;
    }
    const std::string problem = m_reader->problem();
    if (std::exchange(m_problem, problem) != problem) {
        m_console.complain(problem.empty() ? "the servers answer again" : problem);
    }
    for (const stage::ProbeState& probe : m_reader->probes()) {
        if (!probe.problem.empty() && m_told.insert(probe.name + probe.problem).second) {
            m_console.complain("probe " + probe.name + ": " + probe.problem);
        }
        if (probe.isAlive ? m_silent.erase(probe.name) > 0 : m_silent.insert(probe.name).second) {
            m_console.complain("probe " + probe.name +
                               (probe.isAlive ? " is there again" : " is not heard of any more"));
        }
    }
}

} // namespace posewire::cli
