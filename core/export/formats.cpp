// SPDX-License-Identifier: MIT
#include "core/export/formats.h"

#include "core/wire/text.h"

namespace posewire::exporting {
namespace {

constexpr const char* kCsv = "Comma-separated values";

constexpr Format<EventSheet> kEvents[] = {
    {"CSV", kCsv, "csv", eventsCsv},
    {"JSON", "JSON", "json", eventsJson},
};

constexpr Format<NullPoseSheet> kNullPose[] = {
    {"CSV", kCsv, "csv", nullPoseCsv},
    {"JSON", "JSON", "json", nullPoseJson},
};

constexpr Format<ReportSheet> kReport[] = {
    {"HTML", "Web pages", "html",
     [](const ReportSheet& sheet) { return streamReport(sheet.session, sheet.options); }},
};

} // namespace

template <>
std::span<const Format<EventSheet>> formats() {
    return kEvents;
}

template <>
std::span<const Format<NullPoseSheet>> formats() {
    return kNullPose;
}

template <>
std::span<const Format<ReportSheet>> formats() {
    return kReport;
}

bool hasSuffix(std::string_view name, std::string_view suffix) {
    const std::size_t dot = name.rfind('.');
    return dot != std::string_view::npos && wire::lowered(name.substr(dot + 1)) == suffix;
}

} // namespace posewire::exporting
