// SPDX-License-Identifier: MIT
#include "core/export/stream_report.h"

#include "core/export/html.h"
#include "core/export/report_events.h"
#include "core/export/report_gaps.h"
#include "core/export/report_series.h"
#include "core/export/report_style.h"
#include "core/export/report_tables.h"
#include "core/export/report_verdict.h"

#include <algorithm>

namespace posewire::exporting {
namespace {

/// A raw file has no stamps: time codes have taken their place.
bool hasStamps(const model::SessionView& session) {
    return std::ranges::none_of(session.senders(), [](const model::Sender& sender) {
        return sender.info.transport == log::Transport::File;
    });
}

std::vector<model::StreamFigures> allFigures(const model::SessionView& session,
                                             const std::optional<model::TimeRange>& range) {
    std::vector<model::StreamFigures> all;
    for (const model::Stream& stream : session.streams()) {
        const model::StreamFigures figures = figuresOf(session, stream, range);
        if (figures[model::Figure::Datagrams] > 0 || !range) {
            all.push_back(figures);
        }
    }
    return all;
}

std::string fact(std::string_view name, const std::string& html) {
    return "<dt>" + escaped(name) + "</dt><dd>" + html + "</dd>\n";
}

std::string timeFacts(const model::SessionView& session, const ReportSteps& steps) {
    if (steps.count == 0) {
        return fact("Time", "nothing was received");
    }
    const std::string duration = fact("Duration", fixed(steps.durationS(), 3) + " s");
    if (!hasStamps(session)) {
        return fact("Time", "not known: the file has no stamps; time codes of the sender took their place") +
               duration;
    }
    return fact("From", utcText(steps.from)) + fact("To", utcText(steps.to)) + duration;
}

std::string verdictList(const std::vector<Finding>& findings) {
    std::string html =
        "<ul class=\"verdict " + std::string(severityName(findings.front().severity)) + "\">\n";
    for (const Finding& finding : findings) {
        html += "<li class=\"" + std::string(severityName(finding.severity)) +
                "\"><span class=\"mark\" aria-label=\"" + std::string(severityName(finding.severity)) +
                "\">" + std::string(severityMark(finding.severity)) + "</span><span>" +
                escaped(finding.text) + "</span></li>\n";
    }
    return html + "</ul>\n";
}

std::string plotSection(const model::SessionView& session, const ReportSteps& steps) {
    if (steps.count < 2) {
        return {};
    }
    std::string html = "<h2>Over time</h2>\n<div class=\"plots\">\n";
    for (const SvgPlot& plot : plotsOf(session, steps)) {
        html += svgPlot(plot);
    }
    return html + svgPlot(causePlot(session, steps)) + "</div>\n";
}

std::string senderSection(const model::SessionView& session, const std::vector<model::StreamFigures>& figures,
                          const ReportSteps& steps) {
    std::string html;
    for (const model::Sender& sender : session.senders()) {
        html += "<h2>" + escaped(sender.info.address) + " <span class=\"dim\">" +
                escaped(transportName(sender.info.transport)) +
                (sender.info.localPort != 0 ? " to port " + std::to_string(sender.info.localPort) : "") +
                "</span></h2>\n<dl class=\"facts\">\n" +
                fact("Datagrams", grouped(sender.datagrams) + ", " + grouped(sender.bytes) + " bytes") +
                fact("Malformed", grouped(sender.malformed)) + fact("Not MXTP", grouped(sender.foreign)) +
                (sender.skippedBytes != 0 ? fact("Bytes of no datagram", grouped(sender.skippedBytes)) : "") +
                fact("Dropped by this computer", grouped(sender.kernelDrops)) + "</dl>\n";
        for (const model::Character& character : session.characters()) {
            if (character.key.sender == sender.id) {
                html += "<h3>" + escaped(session.displayName(character.key)) +
                        " <span class=\"dim\">character " + std::to_string(character.key.character) +
                        "</span></h3>\n" + metadataList(session, character.key) +
                        streamTable(session, character.key, figures, steps);
            }
        }
    }
    return html;
}

std::string settingsSection(const StreamReportOptions& options) {
    std::string html;
    for (const auto& [name, value] : options.settings) {
        html += fact(name, escaped(value));
    }
    return html.empty() ? html : "<h2>Settings</h2>\n<dl class=\"facts\">\n" + html + "</dl>\n";
}

} // namespace

std::string streamReport(const model::SessionView& session, const StreamReportOptions& options) {
    const std::vector<model::StreamFigures> figures = allFigures(session, options.range);
    const ReportSteps steps = stepsOf(session, options.range);
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
           "<title>Stream report</title>\n<style>" +
           std::string(reportStyle()) + "</style>\n</head>\n<body>\n<h1>Stream report</h1>\n" +
           verdictList(verdictOn(session, figures, options)) +
           "<h2>What this is about</h2>\n<dl class=\"facts\">\n" + timeFacts(session, steps) +
           fact("Written by", escaped(options.application)) + "</dl>\n" + plotSection(session, steps) +
           senderSection(session, figures, steps) + gapSection(session, steps) +
           eventSection(session, steps) + settingsSection(options) + "</body>\n</html>\n";
}

} // namespace posewire::exporting
