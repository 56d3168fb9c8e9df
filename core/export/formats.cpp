// SPDX-License-Identifier: MIT
#include "core/export/formats.h"

#include "core/wire/text.h"

namespace posewire::exporting {

template <>
std::span<const Format<EventSheet>> formats() {
    static constexpr Format<EventSheet> kAll[] = {{"CSV", "Comma-separated values", "csv", eventsCsv},
                                                  {"JSON", "JSON", "json", eventsJson}};
    return kAll;
}

template <>
std::span<const Format<NullPoseSheet>> formats() {
    static constexpr Format<NullPoseSheet> kAll[] = {{"CSV", "Comma-separated values", "csv", nullPoseCsv},
                                                     {"JSON", "JSON", "json", nullPoseJson}};
    return kAll;
}

template <>
std::span<const Format<ReportSheet>> formats() {
    static constexpr Format<ReportSheet> kAll[] = {
        {"HTML", "Web pages", "html",
         [](const ReportSheet& sheet) { return streamReport(sheet.session, sheet.options); }}};
    return kAll;
}

bool hasSuffix(std::string_view name, std::string_view suffix) {
    const std::size_t dot = name.rfind('.');
    return dot != std::string_view::npos && wire::lowered(name.substr(dot + 1)) == suffix;
}

} // namespace posewire::exporting
