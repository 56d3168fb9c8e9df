// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/monitor_run.h"

#include "core/export/stream_report.h"

#include <QString>
#include <QSysInfo>

#include <cctype>
#include <cmath>

namespace posewire::cli {
namespace {

constexpr std::string_view kApplication = "Posewire " POSEWIRE_VERSION;

std::optional<model::TimeRange> rangeOf(const MonitorOptions& options, log::Stamp first) {
    const auto stampAt = [&](double seconds) { return first + log::Duration(std::llround(seconds * 1e9)); };
    model::TimeRange range = model::kAllTime;
    range.from = options.fromSeconds ? stampAt(*options.fromSeconds) : range.from;
    range.to = options.toSeconds ? stampAt(*options.toSeconds) : range.to;
    return range == model::kAllTime ? std::nullopt : std::optional(range);
}

std::string limitText(const std::optional<double>& limit, const std::string& unit) {
    return limit ? "at most " + std::to_string(*limit).substr(0, std::to_string(*limit).find('.') + 4) + unit
                 : "none";
}

} // namespace

MonitorRun::MonitorRun(const MonitorOptions& options, Console& console)
    : m_options(options), m_console(console), m_nextShow(std::chrono::steady_clock::now()) {}

void MonitorRun::follow(log::Stamp now) {
    while (m_session.follow(now)) {
    }
}

void MonitorRun::show(double elapsedS) {
    const auto now = std::chrono::steady_clock::now();
    const bool isReplayUnseen = !m_options.file.empty() && !m_isTerminal && !m_isConcluding;
    if (isReplayUnseen || m_options.asJson || m_options.isQuiet || now < m_nextShow) {
        return;
    }
    m_nextShow = now + std::chrono::microseconds(std::llround(m_options.intervalSeconds * 1e6));
    const LiveDisplay::Size size = LiveDisplay::terminalSize();
    m_console.out.write(m_display.show(liveTable(m_session, elapsedS), size.rows, size.columns));
    m_console.out.flush();
}

ExitStatus MonitorRun::conclude(exporting::MonitorFacts facts, ExitStatus status) {
    facts.exceeded = exceeded(m_session, m_options.limits);
    if (m_options.asJson) {
        m_console.out.write(exporting::monitorReport(m_session, facts) + '\n');
    } else {
        m_nextShow = {};
        m_isConcluding = true;
        show(facts.durationS);
    }
    for (const std::string& line : facts.exceeded) {
        m_console.complain(printable(line));
    }
    status = worse(status, facts.exceeded.empty() ? ExitStatus::Fine : ExitStatus::Faults);
    return m_options.report.empty() ? status : worse(status, writeReport(facts));
}

ExitStatus MonitorRun::writeReport(const exporting::MonitorFacts& facts) {
    exporting::StreamReportOptions options;
    options.application = kApplication;
    options.exceeded = facts.exceeded;
    options.range = rangeOf(m_options, m_session.firstStamp());
    for (std::size_t i = 0; i < kLimits.size(); ++i) {
        std::string name(kLimits[i].name);
        name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
        options.settings.emplace_back(name, limitText(m_options.limits.most[i], unitOf(kLimits[i])));
    }
    if (facts.receiveBufferBytes != 0) {
        options.settings.emplace_back("Receive buffer", std::to_string(facts.receiveBufferBytes) + " bytes");
    }
    options.settings.emplace_back(m_options.file.empty() ? "Source" : "File",
                                  m_options.file.empty() ? "network" : m_options.file);
    auto out = Output::open(m_options.report);
    if (!out) {
        m_console.complain(out.error());
        return ExitStatus::Unusable;
    }
    out->write(exporting::streamReport(m_session, options));
    if (const auto finished = out->finish(); !finished) {
        m_console.complain(finished.error());
        return ExitStatus::Unusable;
    }
    return ExitStatus::Fine;
}

log::RecordingInfo recordingInfo() {
    return {QSysInfo::currentCpuArchitecture().toStdString(),
            (QSysInfo::prettyProductName() + ", " + QSysInfo::kernelType() + ' ' + QSysInfo::kernelVersion())
                .toStdString(),
            std::string(kApplication)};
}

} // namespace posewire::cli
