// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/stage_watch.h"

#include "core/words/say.h"

#include <utility>

namespace posewire::cli {

void StageWatch::start(const stage::StageOptions& options, net::Receiver& receiver, const log::Clock& clock) {
    if (options.isAsked()) {
        m_reader = std::make_unique<stage::StageReader>(
            receiver, m_run.log(), clock,
            stage::StageChoice{options.servers, options.site, stage::wallTimeOf(options.since)});
    }
}

void StageWatch::look(log::Stamp now) {
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
    }
    for (const std::string& probe : m_reader->takeSilent()) {
        const words::Fact fact{words::Kind::ProbeSilent, {{"probe", probe}}};
        m_console.complain(say(fact, words::Form::Headline));
        m_run.session().report(model::IncidentKind::ProbeSilent, now, fact);
    }
}

ExitStatus StageWatch::end() {
    const bool isInVain = m_reader != nullptr && m_reader->probes().empty() && !m_reader->problem().empty();
    m_reader.reset();
    return isInVain ? ExitStatus::Unusable : ExitStatus::Fine;
}

} // namespace posewire::cli
