// SPDX-License-Identifier: MIT
#include "core/export/report_verdict.h"

#include "core/export/html.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::exporting {
namespace {

using enum model::Figure;

/// From here on a loss is visible in most figures.
constexpr double kMuchLoss = 0.01;

std::string counted(std::uint64_t count, const std::string& one, const std::string& many) {
    return grouped(count) + ' ' + (count == 1 ? one : many);
}

std::string percent(double ratio) {
    const double value = 100 * ratio;
    return fixed(value, value >= 10 ? 1 : value >= 0.1 ? 2 : 4) + " %";
}

Finding lossFinding(const model::StreamFigures& sum) {
    const std::uint64_t missing = sum.count(Missing);
    if (missing == 0) {
        return {ReportSeverity::Good, "Good: " + counted(sum.count(Samples), "sample", "samples") +
                                          " expected, every one of them received."};
    }
    const double ratio = sum[Missing] / sum.expected();
    const std::string where = grouped(missing) + " of " +
                              counted(sum.count(Samples) + missing, "sample", "samples") + " (" +
                              percent(ratio) + ")";
    return ratio >= kMuchLoss
               ? Finding{ReportSeverity::Error, "Not good: " + where + " did not arrive whole."}
               : Finding{ReportSeverity::Warning, "Some loss: " + where + " did not arrive whole."};
}

/// Whose losses they were, most first.
void addCauses(std::vector<Finding>& findings, const model::StreamFigures& sum) {
    struct Share {
        std::uint64_t lost;
        std::string words;
    };
    std::vector<Share> shares{{sum.count(LostHere), "in this computer, which did not fetch them in time"},
                              {sum.count(LostOnNetwork), "on the network"},
                              {sum.count(LostAtSender), "at the sender"},
                              {sum.count(LostUnknown), "without evidence whose fault it was"}};
    std::ranges::stable_sort(shares, std::greater{}, &Share::lost);
    for (const Share& share : shares) {
        if (share.lost != 0) {
            findings.push_back(
                {ReportSeverity::Warning,
                 counted(share.lost, "sample was lost ", "samples were lost ") + share.words + '.'});
        }
    }
}

void addOrder(std::vector<Finding>& findings, const model::StreamFigures& sum) {
    const auto add = [&](model::Figure figure, const std::string& one, const std::string& many) {
        if (const std::uint64_t count = sum.count(figure); count != 0) {
            findings.push_back({ReportSeverity::Warning, counted(count, one, many)});
        }
    };
    add(Duplicates, "datagram came more than once.", "datagrams came more than once.");
    add(Reordered, "datagram came after a later one.", "datagrams came after later ones.");
    add(Late, "of these was too late to be shown.", "of these were too late to be shown.");
    add(Restarts, "time a sample counter restarted.", "times a sample counter restarted.");
}

void addSenders(std::vector<Finding>& findings, const model::SessionView& session) {
    for (const model::Sender& sender : session.senders()) {
        if (sender.kernelDrops != 0) {
            findings.push_back(
                {ReportSeverity::Error, "This computer dropped " +
                                            counted(sender.kernelDrops, "datagram", "datagrams") +
                                            " at the socket that hears " + sender.info.address +
                                            ": it was too busy, or its receive buffer is too small."});
        }
        if (sender.malformed != 0) {
            findings.push_back({ReportSeverity::Warning, counted(sender.malformed, "datagram", "datagrams") +
                                                             " from " + sender.info.address +
                                                             " could not be decoded."});
        }
        if (sender.skippedBytes != 0) {
            findings.push_back({ReportSeverity::Warning, counted(sender.skippedBytes, "byte", "bytes") +
                                                             " from " + sender.info.address +
                                                             " belonged to no datagram."});
        }
        if (sender.foreign != 0) {
            findings.push_back({ReportSeverity::Warning, counted(sender.foreign, "datagram", "datagrams") +
                                                             " from " + sender.info.address +
                                                             " were not MXTP; the newest begins with " +
                                                             sender.foreignText() + '.'});
        }
    }
}

} // namespace

std::string_view severityName(ReportSeverity severity) {
    constexpr std::array<std::string_view, 3> names{"good", "warning", "error"};
    return names[static_cast<std::size_t>(severity)];
}

std::string_view severityMark(ReportSeverity severity) {
    constexpr std::array<std::string_view, 3> marks{"●", "▲", "■"};
    return marks[static_cast<std::size_t>(severity)];
}

std::vector<Finding> verdictOn(const model::SessionView& session,
                               const std::vector<model::StreamFigures>& streams,
                               const StreamReportOptions& options) {
    std::vector<Finding> findings;
    model::StreamFigures sum;
    for (const model::StreamFigures& stream : streams) {
        sum.add(stream);
    }
    if (sum.count(Datagrams) == 0) {
        findings.push_back({ReportSeverity::Error, "No MXTP datagram was received."});
    } else {
        findings.push_back(lossFinding(sum));
        addCauses(findings, sum);
        addOrder(findings, sum);
    }
    addSenders(findings, session);
    for (const std::string& line : options.exceeded) {
        findings.push_back({ReportSeverity::Error, line + '.'});
    }
    return findings;
}

} // namespace posewire::exporting
