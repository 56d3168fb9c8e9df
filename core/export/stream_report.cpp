// SPDX-License-Identifier: MIT
#include "core/export/reports.h"

#include "core/export/html.h"
#include "core/export/report_sections.h"
#include "core/model/session/accounts.h"
#include "core/model/session/losses.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "core/model/text.h"
#include "core/words/say.h"

#include "embedded_texts.h"

#include <algorithm>
#include <chrono>
#include <map>

namespace posewire::exporting {
namespace {

using enum model::Figure;
using IncidentSeverity = model::IncidentSeverity;

struct Finding {
    model::IncidentSeverity severity = model::IncidentSeverity::Info;
    std::string text; ///< one sentence, not escaped
};

std::string counted(std::uint64_t count, const std::string& one, const std::string& many) {
    return grouped(count) + ' ' + (count == 1 ? one : many);
}

std::string percent(double ratio) {
    const double value = 100 * ratio;
    return fixed(value, value >= 10 ? 1 : value >= 0.1 ? 2 : 4) + " %";
}

/// The verdict of the window and of the JSON, on the range that the report is about.
Finding verdictFinding(const model::SessionView& session, const std::optional<model::TimeRange>& range) {
    using State = model::TakeVerdict::State;
    const model::TakeVerdict verdict = verdictOf(session, model::spanOf(session, range));
    const auto severity = verdict.state == State::Good      ? IncidentSeverity::Info
                          : verdict.state == State::Warning ? IncidentSeverity::Warning
                                                            : IncidentSeverity::Error;
    return {severity, say(verdict.said, words::Form::Headline) + '.'};
}

Finding lossFinding(const model::StreamFigures& sum) {
    const std::uint64_t missing = sum.count(Missing);
    if (missing == 0) {
        return {IncidentSeverity::Info,
                counted(sum.count(Samples), "sample", "samples") + " expected, every one of them received."};
    }
    return {IncidentSeverity::Warning,
            grouped(missing) + " of " + counted(sum.count(Samples) + missing, "sample", "samples") + " (" +
                percent(sum[Missing] / sum.expected()) + ") were lost or incomplete."};
}

/// One sentence about a count, unless it is 0.
void addCounted(std::vector<Finding>& findings, std::uint64_t count, const std::string& one,
                const std::string& many, const std::string& rest = "") {
    if (count != 0) {
        findings.push_back({IncidentSeverity::Warning, counted(count, one, many) + rest});
    }
}

/// Whose losses they were, most first.
void addCauses(std::vector<Finding>& findings, const model::StreamFigures& sum) {
    struct Share {
        std::uint64_t lost;
        std::string words;
    };
    std::vector<Share> shares{{sum.count(LostHere), "in this computer, which did not fetch them in time."},
                              {sum.count(LostOnNetwork), "on the network."},
                              {sum.count(LostAtSender), "at the sender."},
                              {sum.count(LostOnWay), "between a probe and here."},
                              {sum.count(LostUnknown), "with no sign of where."}};
    std::ranges::stable_sort(shares, std::greater{}, &Share::lost);
    for (const Share& share : shares) {
        addCounted(findings, share.lost, "sample was lost ", "samples were lost ", share.words);
    }
}

void addOrder(std::vector<Finding>& findings, const model::StreamFigures& sum) {
    addCounted(findings, sum.count(Duplicates), "datagram came more than once.",
               "datagrams came more than once.");
    addCounted(findings, sum.count(Reordered), "datagram came after a later one.",
               "datagrams came after later ones.");
    addCounted(findings, sum.count(Late), "of these was too late to be shown.",
               "of these were too late to be shown.");
}

/// All streams of a character restart together: that is once.
void addRestarts(std::vector<Finding>& findings, const std::vector<model::StreamFigures>& streams) {
    std::map<model::CharacterKey, std::uint64_t> ofEach;
    for (const model::StreamFigures& stream : streams) {
        std::uint64_t& restarts = ofEach[{stream.key().sender, stream.key().character}];
        restarts = std::max(restarts, stream.count(Restarts));
    }
    std::uint64_t all = 0;
    for (const auto& [character, restarts] : ofEach) {
        all += restarts;
    }
    addCounted(findings, all, "time the sample counter of a character restarted.",
               "times the sample counter of a character restarted.");
}

/// Findings that are known of the whole session alone.
void addSession(std::vector<Finding>& findings, const model::SessionView& session) {
    if (session.accounts().overtaken() != 0) {
        findings.push_back(
            {IncidentSeverity::Error, "This computer did not look at " +
                                          counted(session.accounts().overtaken(), "packet", "packets") +
                                          " in time: what was lost with them is counted as lost here."});
    }
    if (session.accounts().dropsUnseen() != 0) {
        findings.push_back({IncidentSeverity::Error,
                            "This computer dropped " +
                                counted(session.accounts().dropsUnseen(), "datagram", "datagrams") +
                                " between those that it did not look at: it was too busy, or its receive "
                                "buffer is too small."});
    }
    addCounted(findings, session.accounts().unfollowed(), "datagram", "datagrams",
               " of too many streams at once could not be accounted for.");
    const model::RetiredTotals& retired = session.accounts().retired();
    if (retired.senders != 0) {
        findings.push_back({retired.lost == 0 ? IncidentSeverity::Info : IncidentSeverity::Warning,
                            counted(retired.senders, "sender", "senders") +
                                " fell silent and made room for others; together: " +
                                counted(retired.wellFormed(), "datagram", "datagrams") + ", " +
                                counted(retired.samples, "sample", "samples") + ", " + grouped(retired.lost) +
                                " lost."});
    }
}

using SenderTotals = std::map<log::SenderId, model::SenderTotals>;

void addSenders(std::vector<Finding>& findings, const model::SessionView& session,
                const SenderTotals& totals) {
    for (const model::Sender& sender : session.roster().senders()) {
        const model::SenderTotals& own = totals.at(sender.id);
        if (own.kernelDrops != 0) {
            findings.push_back({IncidentSeverity::Error,
                                "This computer dropped " + counted(own.kernelDrops, "datagram", "datagrams") +
                                    " at the socket that receives from " + sender.address().shown() +
                                    ": it was too busy, or its receive buffer is too small."});
        }
        const std::string from = " from " + sender.address().shown();
        addCounted(findings, own.malformed, "datagram", "datagrams", from + " could not be decoded.");
        addCounted(findings, own.skippedBytes, "byte", "bytes", from + " belonged to no datagram.");
        if (own.foreign != 0) {
            findings.push_back(
                {IncidentSeverity::Warning, say(sender.foreignFact(), words::Form::Sentence) + ' ' +
                                                say(sender.foreignFact(), words::Form::Advice)});
        }
    }
}

/// The first is the verdict, the others give reasons.
std::vector<Finding> findingsOn(const model::SessionView& session,
                                const std::vector<model::StreamFigures>& streams, const SenderTotals& senders,
                                const StreamReportOptions& options) {
    std::vector<Finding> findings;
    model::StreamFigures sum;
    model::StreamFigures ofSamples;
    for (const model::StreamFigures& stream : streams) {
        sum.add(stream);
        if (stream.isSampled()) {
            ofSamples.add(stream);
        }
    }
    if (sum.count(Datagrams) == 0) {
        findings.push_back({IncidentSeverity::Error, "No MXTP datagram was received."});
    } else {
        findings.push_back(verdictFinding(session, options.range));
        findings.push_back(lossFinding(ofSamples));
        addCauses(findings, ofSamples);
        std::uint64_t incomplete = 0;
        for (const model::StreamFigures& stream : streams) {
            incomplete += stream.isSampled() ? 0 : stream.count(Incomplete);
        }
        addCounted(findings, incomplete, "message came only in part.", "messages came only in part.");
        addOrder(findings, sum);
        addRestarts(findings, streams);
    }
    if (!options.range) {
        addSession(findings, session);
    }
    addSenders(findings, session, senders);
    for (const std::string& line : options.exceeded) {
        findings.push_back({IncidentSeverity::Error, line.ends_with('.') ? line : line + '.'});
    }
    return findings;
}

/// "2026-11-21 16:01:32.123 UTC".
std::string utcText(log::WallTime time) {
    using namespace std::chrono;
    const auto shown = floor<milliseconds>(time); // also before 1970
    const auto day = floor<days>(shown);
    const year_month_day date{day};
    const hh_mm_ss clock{shown - day};
    return model::padded(static_cast<int>(date.year()), 4) + '-' +
           model::padded(static_cast<unsigned>(date.month()), 2) + '-' +
           model::padded(static_cast<unsigned>(date.day()), 2) + ' ' +
           model::padded(clock.hours().count(), 2) + ':' + model::padded(clock.minutes().count(), 2) + ':' +
           model::padded(clock.seconds().count(), 2) + '.' + model::padded(clock.subseconds().count(), 3) +
           " UTC";
}

/// A raw file has no stamps: time codes have taken their place.
bool hasStamps(const model::SessionView& session) {
    return std::ranges::none_of(session.roster().senders(), [](const model::Sender& sender) {
        return sender.info.transport == log::Transport::File;
    });
}

std::vector<model::StreamFigures> allFigures(const model::SessionView& session,
                                             const std::optional<model::TimeRange>& range) {
    std::vector<model::StreamFigures> all;
    const model::Losses losses(session, range);
    for (const model::Stream& stream : session.roster().streams()) {
        const model::StreamFigures figures = losses.figuresOf(stream);
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
    return fact("From", utcText(session.wallOf(steps.from))) + fact("To", utcText(session.wallOf(steps.to))) +
           duration;
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

std::string senderSection(const model::SessionView& session, const std::vector<model::StreamFigures>& figures,
                          const SenderTotals& totals, const ReportSteps& steps) {
    std::string html;
    for (const model::Sender& sender : session.roster().senders()) {
        const model::SenderTotals& own = totals.at(sender.id);
        const auto unconfirmed = static_cast<std::uint64_t>(
            std::ranges::count(sender.characters, false, &model::Character::isConfirmed));
        html += "<h2>" + sender.address().html() + " <span class=\"dim\">" +
                escaped(log::nameOf(sender.info.transport)) +
                (sender.info.localPort != 0 ? " to port " + std::to_string(sender.info.localPort) : "") +
                "</span></h2>\n<dl class=\"facts\">\n" +
                fact("Datagrams", grouped(own.datagrams) + ", " + grouped(own.bytes) + " bytes") +
                fact("Malformed", grouped(own.malformed)) + fact("Not MXTP", grouped(own.foreign)) +
                (own.skippedBytes != 0 ? fact("Bytes of no datagram", grouped(own.skippedBytes)) : "") +
                fact("Dropped by this computer",
                     own.hasUncountedDrops ? std::string("not known here") : grouped(own.kernelDrops)) +
                (unconfirmed != 0 ? fact("Unconfirmed characters", grouped(unconfirmed)) : "") + "</dl>\n";
        for (const model::Character* character : sender.characters) {
            if (!character->isConfirmed) {
                continue;
            }
            html += "<h3>" + session.roster().displayName(character->key).html() +
                    " <span class=\"dim\">character " + std::to_string(character->key.character) +
                    "</span></h3>\n" + metadataList(session, character->key) +
                    streamTable(session, character->key, figures, steps);
        }
    }
    return html;
}

} // namespace

std::string streamReport(const model::SessionView& session, const StreamReportOptions& options) {
    const std::vector<model::StreamFigures> figures = allFigures(session, options.range);
    const SenderTotals senders = session.accounts().eachSender(options.range);
    const ReportSteps steps = stepsOf(session, options.range);
    const std::string_view style = reportCss();
    std::string settings;
    for (const auto& [name, value] : options.settings) {
        settings += fact(name, escaped(value));
    }
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
           "<title>Stream report</title>\n<style>" +
           std::string(style.substr(style.find("\n:root"))) +
           "</style>\n</head>\n<body>\n<h1>Stream report</h1>\n" +
           verdictList(findingsOn(session, figures, senders, options)) +
           "<h2>What this is about</h2>\n<dl class=\"facts\">\n" + timeFacts(session, steps) +
           fact("Written by", escaped(options.application)) + "</dl>\n" + plotSection(session, steps) +
           senderSection(session, figures, senders, steps) + gapSection(session, steps) +
           eventSection(session, steps) +
           (settings.empty() ? "" : "<h2>Settings</h2>\n<dl class=\"facts\">\n" + settings + "</dl>\n") +
           "</body>\n</html>\n";
}

} // namespace posewire::exporting
