// SPDX-License-Identifier: MIT
#include "core/export/report_events.h"

#include "core/export/html.h"
#include "core/export/report_verdict.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::exporting {
namespace {

using model::Event;

constexpr std::size_t kMostListed = 300;

ReportSeverity severityOf(const Event& event) {
    switch (event.severity()) {
    case model::EventSeverity::Info:
        return ReportSeverity::Good;
    case model::EventSeverity::Warning:
        return ReportSeverity::Warning;
    case model::EventSeverity::Error:
        break;
    }
    return ReportSeverity::Error;
}

/// Sender, character and type, as far as the event is about them.
std::string whose(const model::SessionView& session, const Event& event) {
    const model::Sender* sender = session.find(event.sender);
    std::string text = sender != nullptr ? sender->info.address : "";
    if (event.character) {
        text += ", " + session.displayName({event.sender, *event.character});
    }
    if (event.type) {
        text += ", " + wire::typeTitle(*event.type);
    }
    return text;
}

std::string secondsAfter(log::Stamp stamp, const ReportSteps& steps) {
    return fixed(log::secondsOf(stamp - steps.from), 3);
}

} // namespace

std::string eventSection(const model::SessionView& session, const ReportSteps& steps) {
    std::vector<const Event*> events;
    for (const Event& event : session.events().all()) {
        if (event.lastStamp >= steps.from && event.firstStamp <= steps.to) {
            events.push_back(&event);
        }
    }
    if (events.empty()) {
        return {};
    }
    const std::size_t all = events.size();
    const auto left = static_cast<std::ptrdiff_t>(all - std::min(all, kMostListed));
    HtmlTable table({{"From s", true, "seconds since the report's beginning"},
                     {"To s", true, "seconds since the report's beginning"},
                     {"What", false, ""},
                     {"Whose", false, ""},
                     {"Times", true, "how often it happened in this episode"},
                     {"In words", false, ""}});
    std::for_each(events.begin() + left, events.end(), [&](const Event* event) {
        const ReportSeverity severity = severityOf(*event);
        const std::string mark = severity == ReportSeverity::Good
                                     ? ""
                                     : "<span class=\"" + std::string(severityName(severity)) +
                                           "\" aria-label=\"" + std::string(severityName(severity)) + "\">" +
                                           std::string(severityMark(severity)) + "</span> ";
        table.add({secondsAfter(event->firstStamp, steps), secondsAfter(event->lastStamp, steps),
                   mark + escaped(model::nameOf(event->kind)), escaped(whose(session, *event)),
                   grouped(event->count), escaped(event->text())});
    });
    const std::string count = left > 0
                                  ? "The newest " + grouped(kMostListed) + " of " + grouped(all) + " events."
                                  : grouped(all) + (all == 1 ? " event." : " events.");
    return "<h2>Events</h2>\n<p class=\"dim\">" + count + "</p>\n" + table.html();
}

} // namespace posewire::exporting
