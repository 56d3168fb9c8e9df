// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/reports.h"
#include "core/export/sheets.h"

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
[[nodiscard]] std::span<const Format<Subject>> formats();
template <>
std::span<const Format<EventSheet>> formats();
template <>
std::span<const Format<NullPoseSheet>> formats();
template <>
std::span<const Format<ReportSheet>> formats();

/// In whatever case.
[[nodiscard]] bool hasSuffix(std::string_view name, std::string_view suffix);

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
