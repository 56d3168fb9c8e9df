// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/monitor.h"

#include "core/export/html.h"
#include "core/export/reports.h"
#include "core/export/session_reading.h"
#include "core/wire/type_table.h"

#include <QString>
#include <QSysInfo>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <csignal>
#include <iterator>

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

std::string placeOf(const model::SessionView& session, const log::StreamKey& key) {
    const model::Sender* sender = session.find(key.sender);
    return (sender != nullptr ? sender->address().shown() : std::string("unknown source")) + ", " +
           session.displayName({key.sender, key.character}).shown() + ", type " + wire::typeTitle(key.type);
}

/// One line for each limit that a stream exceeds; one if nothing was received although there are limits.
std::vector<std::string> exceeded(const model::SessionView& session, const Limits& limits,
                                  std::optional<log::Stamp> end) {
    const bool isAny = std::ranges::any_of(limits, [](const auto& most) { return most.has_value(); });
    std::vector<std::string> lines;
    if (isAny && session.streams().empty()) {
        lines.emplace_back(
            "no datagram was received, so no limit is kept; is the sender on, and does it send here?");
    }
    for (const model::Stream& stream : session.streams()) {
        if (!wire::isSampled(stream.key.type)) {
            continue; // sent again now and then: its gaps mean nothing
        }
        const model::StreamFigures figures = exporting::figuresOf(session, stream);
        for (std::size_t i = 0; i < kLimits.size(); ++i) {
            const double lastsMs = end && kLimits[i].figure == model::Figure::SpacingMost
                                       ? log::millisecondsOf(*end - stream.accounting.lastStamp())
                                       : 0;
            const bool lasts = lastsMs > figures[kLimits[i].figure];
            const double value = lasts ? lastsMs : figures[kLimits[i].figure];
            if (limits[i] && value > *limits[i]) {
                lines.push_back(placeOf(session, stream.key) + ": " + std::string(kLimits[i].name) + ' ' +
                                exporting::fixed(value, 3) + unitOf(kLimits[i]) +
                                (lasts ? ", which lasted to the end," : "") + " is above the limit of " +
                                exporting::fixed(*limits[i], 3) + unitOf(kLimits[i]));
            }
        }
    }
    return lines;
}

volatile std::sig_atomic_t hasInterruptionCome = 0;

extern "C" void rememberInterruption(int signal) {
    hasInterruptionCome = 1;
    std::signal(signal, SIG_DFL);
}

} // namespace

std::string unitOf(const Limit& limit) {
    return std::string(" ") + model::rowOf(limit.figure).style.unit;
}

MonitorRun::MonitorRun(const MonitorOptions& options, Console& console)
    : m_options(options), m_console(console), m_nextShow(std::chrono::steady_clock::now()) {
    hasInterruptionCome = 0;
    std::signal(SIGINT, rememberInterruption);
    std::signal(SIGTERM, rememberInterruption);
}

MonitorRun::~MonitorRun() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool MonitorRun::isOver() const {
    return hasInterruptionCome != 0 || !m_console.out.isWanted();
}

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

ExitStatus MonitorRun::conclude(exporting::MonitorFacts facts, ExitStatus status,
                                std::optional<log::Stamp> end) {
    std::ranges::copy(exceeded(m_session, m_options.limits, end), std::back_inserter(facts.exceeded));
    if (m_options.asJson) {
        m_console.out.write(exporting::monitorReport(m_session, facts) + '\n');
    } else {
        m_nextShow = {};
        m_isConcluding = true;
        show(facts.durationS);
    }
    for (const std::string& line : facts.exceeded) {
        m_console.complain(line);
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
        options.settings.emplace_back(name, limitText(m_options.limits[i], unitOf(kLimits[i])));
    }
    if (facts.receiveBufferBytes != 0) {
        options.settings.emplace_back("Receive buffer", std::to_string(facts.receiveBufferBytes) + " bytes");
    }
    for (const std::string& allowed : m_options.allowed) {
        options.settings.emplace_back("Listening only to", allowed);
    }
    if (facts.refusedDatagrams != 0) {
        options.settings.emplace_back("From others, not looked at",
                                      std::to_string(facts.refusedDatagrams) + " datagrams");
    }
    options.settings.emplace_back(m_options.file.empty() ? "Source" : "File",
                                  m_options.file.empty() ? "network" : m_options.file);
    const auto written = Output::writeFile(m_options.report, exporting::streamReport(m_session, options));
    return written ? ExitStatus::Fine : m_console.unusable(written.error());
}

log::RecordingInfo recordingInfo() {
    return {QSysInfo::currentCpuArchitecture().toStdString(),
            (QSysInfo::prettyProductName() + ", " + QSysInfo::kernelType() + ' ' + QSysInfo::kernelVersion())
                .toStdString(),
            std::string(kApplication)};
}

} // namespace posewire::cli
