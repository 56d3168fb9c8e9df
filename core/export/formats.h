// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/reports.h"
#include "core/export/sheets.h"
#include "core/wire/text.h"

#include <array>
#include <span>
#include <string>
#include <string_view>

/// What can be saved to a file, and in which formats: the one list that menus and file dialogs walk.
namespace posewire::exporting {

template <class Subject>
struct Format {
    const char* title;  ///< "CSV", for menus
    const char* kind;   ///< "Comma-separated values", for file dialogs
    const char* suffix; ///< without the dot, in small letters
    std::string (*write)(const Subject& subject);
};

struct ReportSheet {
    const model::SessionView& session;
    StreamReportOptions options;
};

/// All formats of a subject, the usual one first: of EventSheet, NullPoseSheet and ReportSheet.
template <class Subject>
inline constexpr std::array<Format<Subject>, 0> kFormatsOf{};
template <>
inline constexpr std::array<Format<EventSheet>, 2> kFormatsOf<EventSheet>{
    {{"CSV", "Comma-separated values", "csv", eventsCsv}, {"JSON", "JSON", "json", eventsJson}}};
template <>
inline constexpr std::array<Format<NullPoseSheet>, 2> kFormatsOf<NullPoseSheet>{
    {{"CSV", "Comma-separated values", "csv", nullPoseCsv}, {"JSON", "JSON", "json", nullPoseJson}}};
template <>
inline constexpr std::array<Format<ReportSheet>, 1> kFormatsOf<ReportSheet>{
    {{"HTML", "Web pages", "html",
      [](const ReportSheet& sheet) { return streamReport(sheet.session, sheet.options); }}}};

template <class Subject>
[[nodiscard]] std::span<const Format<Subject>> formats() {
    return kFormatsOf<Subject>;
}

/// In whatever case.
[[nodiscard]] inline bool hasSuffix(std::string_view name, std::string_view suffix) {
    const std::size_t dot = name.rfind('.');
    return dot != std::string_view::npos && wire::lowered(name.substr(dot + 1)) == suffix;
}

/// The format that a file's name asks for; the usual one where it ends with no suffix of the list.
template <class Subject>
[[nodiscard]] const Format<Subject>& formatFor(std::string_view name) {
    for (const Format<Subject>& format : formats<Subject>()) {
        if (hasSuffix(name, format.suffix)) {
            return format;
        }
    }
    return formats<Subject>().front();
}

} // namespace posewire::exporting
