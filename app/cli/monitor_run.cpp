// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/monitor.h"

#include "app/usage/usage.h"
#include "core/export/html.h"
#include "core/export/reports.h"
#include "core/log/file_names.h"
#include "core/log/log_reader.h"
#include "core/model/incidents/thresholds.h"
#include "core/model/session/accounts.h"
#include "core/model/session/roster.h"
#include "core/wire/type_table.h"

#include <QSysInfo>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <utility>

namespace posewire::cli {
namespace {

std::string packetsText(std::uint64_t packets) {
    return std::to_string(packets) + (packets == 1 ? " packet" : " packets");
}

std::string applicationName() {
    return "Posewire " + std::string(usage::version());
}

std::optional<model::TimeRange> rangeOf(const stage::StageOptions& options, log::Stamp first,
                                        log::WallTime wall) {
    return options.isAsked() || options.isAll() ? std::nullopt : std::optional(options.times(first, wall));
}

std::string limitText(const std::optional<double>& limit, const std::string& unit) {
    return limit ? "at most " + std::to_string(*limit).substr(0, std::to_string(*limit).find('.') + 4) + unit
                 : "none";
}

std::string streamText(const model::SessionView& session, const log::StreamKey& key) {
    return session.roster().addressOf(key.sender).shown() + ", " +
           session.roster().displayName({key.sender, key.character}).shown() + ", type " +
           wire::typeTitle(key.type);
}

std::string excessOf(const model::SessionView& session, const log::StreamKey& stream, const Limit& limit,
                     double value, double most, bool lasts = false) {
    return streamText(session, stream) + ": " + std::string(limit.name) + ' ' + exporting::fixed(value, 3) +
           unitOf(limit) + (lasts ? ", which lasted to the end," : "") + " is above the limit of " +
           exporting::fixed(most, 3) + unitOf(limit);
}

/// One line for each limit that a stream exceeds; one if nothing was received although there are limits. Of
/// senders that were retired the worst stream is known.
std::vector<std::string> exceeded(const model::SessionView& session, const Limits& limits,
                                  std::optional<log::Stamp> end) {
    const bool isAny = std::ranges::any_of(limits, [](const auto& most) { return most.has_value(); });
    const model::RetiredTotals& retired = session.accounts().retired();
    std::vector<std::string> lines;
    if (isAny && session.roster().streams().empty() && retired.streams == 0) {
        lines.emplace_back(
            "no datagram was received, so no limit is kept; is the sender on, and does it send here?");
    }
    for (std::size_t i = 0; i < kLimits.size(); ++i) {
        const auto worst =
            std::ranges::find(retired.worst, kLimits[i].figure, &model::RetiredTotals::Worst::figure);
        if (limits[i] && worst != retired.worst.end() && worst->value > *limits[i]) {
            lines.push_back(excessOf(session, worst->stream, kLimits[i], worst->value, *limits[i]));
        }
    }
    for (const model::Stream& stream : session.roster().streams()) {
        if (!wire::isSampled(stream.key.type)) {
            continue; // sent again now and then: its gaps mean nothing
        }
        const model::StreamFigures figures = model::figuresOf(stream);
        for (std::size_t i = 0; i < kLimits.size(); ++i) {
            const double lastsMs = end && kLimits[i].figure == model::Figure::SpacingMost
                                       ? log::millisecondsOf(*end - stream.accounting.lastStamp())
                                       : 0;
            const bool lasts = lastsMs > figures[kLimits[i].figure];
            const double value = lasts ? lastsMs : figures[kLimits[i].figure];
            if (limits[i] && value > *limits[i]) {
                lines.push_back(excessOf(session, stream.key, kLimits[i], value, *limits[i], lasts));
            }
        }
    }
    return lines;
}

model::Thresholds thresholdsOf(const Limits& limits) {
    constexpr double kNone = 1e-9; // "at most 0"; a threshold of 0 is none
    model::Thresholds thresholds;
    for (const model::ThresholdRow& row : model::thresholdTable()) {
        for (std::size_t i = 0; i < kLimits.size(); ++i) {
            if (row.figure == kLimits[i].figure && limits[i]) {
                thresholds.*row.limit = std::max(*limits[i], kNone);
            }
        }
    }
    return thresholds;
}

log::OutputRules rulesOf(const MonitorOptions& options) {
    log::OutputRules rules{options.replaces, {}};
    if (!options.file.empty()) {
        rules.inUse.push_back(options.file);
    }
    return rules;
}

std::string recordingPath(const MonitorOptions& options) {
    return options.record == "-" ? std::string(log::kStandardOutput) : options.record;
}

} // namespace

std::string unitOf(const Limit& limit) {
    return std::string(" ") + model::rowOf(limit.figure).style.unit;
}

MonitorRun::MonitorRun(const MonitorOptions& options, Console& console)
    : m_options(options),
      m_console(console),
      m_lines(log::durationOf(options.intervalSeconds)),
      m_nextShow(std::chrono::steady_clock::now()) {
    m_session.setThresholds(thresholdsOf(options.limits));
    m_session.setUsual({.up = model::upNamed(options.up)});
    if (!options.asJson && !options.isQuiet) {
        m_table.emplace(system::kStandardOutput, m_isTerminal);
    }
}

bool MonitorRun::isOver() const {
    return system::Interruption::hasCome() || (isReaderGone() && m_options.record.empty());
}

void MonitorRun::follow(log::Stamp now, bool isReceiverHeldUp) {
    const bool isHeldUp = m_options.file.empty() && m_heldUp.at(now); // a file holds nobody up
    m_session.setHeldUp(isHeldUp || isReceiverHeldUp);
    takeIn(now);
}

log::Stamp MonitorRun::followToEnd(log::Stamp end) {
    m_session.setHeldUp(false);
    takeIn(end);
    for (const model::Sender& sender : m_session.roster().senders()) {
        end = std::max(end, sender.lastStamp);
    }
    takeIn(end);
    return end;
}

void MonitorRun::takeIn(log::Stamp now) {
    if (m_session.end() == 0) {
        const auto first = log::LogReader(m_origin.log()).packetFrom(0);
        if (const auto range = first ? rangeOf(m_options.stage, first->stamp, m_session.wallOf(first->stamp))
                                     : std::nullopt) {
            m_session.setEdges(*range);
        }
    }
    while (m_session.follow(now)) {
    }
    if (m_options.isVerbose) {
        tellSenders();
    }
}

void MonitorRun::tellSenders() {
    std::set<log::SenderId> listed;
    for (const model::Sender& sender : m_session.roster().senders()) {
        listed.insert(sender.id);
        if (!m_toldSenders.contains(sender.id)) {
            m_console.complain("heard " + sender.address().shown());
        }
    }
    m_toldSenders = std::move(listed);
}

/// Who reads too slowly gets fewer lines, and in the next one what those that are missing would have told.
void MonitorRun::showLine(log::Stamp now) {
    const bool isFile = !m_options.file.empty();
    if (!isFile && !m_isConcluding && !m_table->hasRoom()) {
        m_linesLeftOut += m_lines.skipLine(m_session, now) ? 1 : 0;
        return;
    }
    if (const auto line =
            m_isConcluding ? m_lines.lastLine(m_session, now) : m_lines.lineAt(m_session, now)) {
        m_table->add(*line, isFile);
    }
}

void MonitorRun::show(const exporting::MonitorFacts& facts, log::Stamp now) {
    const auto clock = std::chrono::steady_clock::now();
    const bool isReplayUnseen = !m_options.file.empty() && !m_isTerminal && !m_isConcluding;
    if (isReaderGone() && !m_isConcluding && !m_isReaderTold && !m_options.record.empty()) {
        m_isReaderTold = true;
        m_console.complain(
            "nobody reads standard output any more; recording goes on until Ctrl+C or --duration");
    }
    if (m_table && m_options.asJsonLines) {
        showLine(now);
        return;
    }
    if (isReplayUnseen || !m_table || clock < m_nextShow) {
        return;
    }
    m_nextShow = clock + std::chrono::microseconds(std::llround(m_options.intervalSeconds * 1e6));
    m_table->show(liveTable(m_session, facts));
}

ExitStatus MonitorRun::finishTable(const exporting::MonitorFacts& facts) {
    if (!m_table) {
        return ExitStatus::Fine;
    }
    m_nextShow = {};
    m_isConcluding = true;
    show(facts, m_session.now());
    m_table->finish(system::Interruption::hasCome);
    const std::uint64_t leftOut = m_linesLeftOut + (m_table->isWanted() ? m_table->unwritten() : 0);
    if (leftOut != 0) {
        m_console.complain(std::to_string(leftOut) + (leftOut == 1 ? " line was" : " lines were") +
                           " left out: the lines before were not read in time");
    }
    const std::string failure = m_table->failure();
    return failure.empty() ? ExitStatus::Fine : m_console.unusable(failure);
}

log::Reception MonitorRun::receptionOf(const exporting::MonitorFacts& facts) const {
    log::LogReader reader(m_origin.log());
    const auto last = reader.end() != 0 ? reader.packet(reader.end() - 1) : std::nullopt;
    return {log::durationOf(facts.durationS),
            last ? std::max(m_session.now() - last->stamp, log::Duration::zero()) : log::Duration::zero(),
            static_cast<std::uint64_t>(facts.receiveBufferBytes)};
}

void MonitorRun::tellRecorded(const log::RecordingFigures& recorded, const std::string& path,
                              const std::optional<log::FileError>& failure) {
    const std::string packets = packetsText(recorded.packets);
    const std::string file = m_options.record == "-" ? "standard output" : path;
    if (failure) {
        if (failure->kind == log::FileError::Kind::Displaced) {
            return; // nothing is there
        }
        m_console.complain("at most " + packets + " of " +
                           std::to_string(log::LogReader(m_origin.log()).end()) + " are in " + file);
        return;
    }
    m_console.complain("recorded " + packets + ", " + std::to_string(recorded.bytes) + " bytes to " + file);
    if (recorded.missed != 0) {
        m_console.complain(std::to_string(recorded.missed) +
                           " packets arrived faster than the disk could take them and are not in the "
                           "recording; choose a faster disk");
    }
}

void MonitorRun::tellInterrupted() {
    m_isInterrupted = true;
    m_console.complain(m_options.file + ": interrupted; this is about its first " +
                       packetsText(log::LogReader(m_origin.log()).end()) + " only");
}

ExitStatus MonitorRun::conclude(exporting::MonitorFacts facts, ExitStatus status,
                                std::optional<log::Stamp> end) {
    if (m_options.file.empty()) {
        m_session.settle();
    } else {
        m_session.endFile();
    }
    std::ranges::copy(exceeded(m_session, m_options.limits, end), std::back_inserter(facts.exceeded));
    // Nobody may read standard output: all else comes before.
    const ExitStatus reported = m_options.report.empty() ? ExitStatus::Fine : writeReport(facts);
    if (m_options.asJson) {
        facts.hasMemory = m_options.isVerbose;
        m_console.out.write(exporting::monitorReport(m_session, facts) + '\n');
    }
    status = worse(status, worse(reported, finishTable(facts)));
    for (const std::string& line : facts.exceeded) {
        m_console.complain(line);
    }
    return worse(status, facts.exceeded.empty() ? ExitStatus::Fine : ExitStatus::Faults);
}

ExitStatus MonitorRun::writeReport(const exporting::MonitorFacts& facts) {
    exporting::StreamReportOptions options;
    options.application = applicationName();
    options.exceeded = facts.exceeded;
    const log::Stamp first = m_session.firstStamp();
    options.range = rangeOf(m_options.stage, first, m_session.wallOf(first));
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
    if (m_isInterrupted) {
        options.settings.emplace_back(
            "Not read to its end", "interrupted after " + packetsText(log::LogReader(m_origin.log()).end()));
    }
    log::OutputRules rules = rulesOf(m_options);
    if (!m_options.record.empty() && m_options.record != "-") {
        rules.inUse.push_back(m_options.record);
    }
    const auto written =
        Output::writeFile(m_options.report, rules, exporting::streamReport(m_session, options));
    return written ? ExitStatus::Fine : m_console.unusable(written.error());
}

tl::expected<void, std::string> checkOutputs(const MonitorOptions& options) {
    const bool wantsOut = options.asJson || options.asJsonLines || options.report == "-";
    if (options.record == "-" && wantsOut) {
        return tl::unexpected(
            std::string("--record -: something else goes to standard output; name a file for one of them"));
    }
    // Links are found out by log::checkOutput().
    if (!options.record.empty() &&
        log::pathOf(options.record).lexically_normal() == log::pathOf(options.report).lexically_normal()) {
        return tl::unexpected(options.record + ": is both recording and report; name two files");
    }
    for (const std::string& path : {options.record, options.report}) {
        if (path.empty() || path == "-") {
            continue;
        }
        if (const auto checked = log::checkOutput(path, rulesOf(options)); !checked) {
            return tl::unexpected(checked.error().text);
        }
    }
    return {};
}

tl::expected<std::unique_ptr<log::ByteSink>, log::FileError> createRecording(const MonitorOptions& options) {
    return log::createFile(recordingPath(options), rulesOf(options));
}

tl::expected<std::unique_ptr<log::Recording>, log::FileError> startRecording(const MonitorOptions& options,
                                                                             const log::PacketLog& log) {
    return log::Recording::start(log, recordingPath(options), recordingInfo(), rulesOf(options));
}

log::RecordingInfo recordingInfo() {
    return {QSysInfo::currentCpuArchitecture().toStdString(),
            (QSysInfo::prettyProductName() + ", " + QSysInfo::kernelType() + ' ' + QSysInfo::kernelVersion())
                .toStdString(),
            applicationName()};
}

} // namespace posewire::cli
