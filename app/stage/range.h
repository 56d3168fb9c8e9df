// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/usage/command_line.h"
#include "core/log/time.h"
#include "core/model/accounting/stream_figures.h"

#include <array>
#include <optional>
#include <string>

namespace posewire::stage {

/// The times that `--since` and `--until` name, as typed: seconds after the beginning ("12.5"), a time of day
/// ("10:30", "10:30:15.5"), or that with its date ("2026-11-26T10:30"), in this computer's time zone.
struct Range {
    std::string since; ///< empty: from the beginning
    std::string until; ///< empty: to the end

    [[nodiscard]] bool isAll() const { return since.empty() && until.empty(); }
    /// The recording begins at `first`, when the wall clock is at `wall`. Open sides are those of kAllTime.
    [[nodiscard]] model::TimeRange times(log::Stamp first, log::WallTime wall) const;
};

/// Adds `--since` and `--until`, of a recording. In seconds, `since` has to be before `until`.
std::array<usage::DeclaredOption, 2> addRange(usage::Arguments arguments, Range& range);

/// Returns the time of a text; a time of day is the newest that is not to come. Empty for seconds and any
/// other text.
[[nodiscard]] std::optional<log::WallTime> wallTimeOf(const std::string& text);

/// Returns how long after `beginning` it is; a time of day is the first one from an hour before `beginning`
/// on. Empty if the text is none of these.
[[nodiscard]] std::optional<log::Duration> momentAfter(log::WallTime beginning, const std::string& text);

} // namespace posewire::stage
