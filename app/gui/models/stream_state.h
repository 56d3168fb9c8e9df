// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"
#include "core/model/session/losses.h"
#include "core/model/session/session_view.h"
#include "core/model/session/verdict.h"

namespace posewire::gui {

/// Without data for this long a stream is silent, and for the second it is stale (seconds).
inline constexpr double kSilentAge = 0.25;
inline constexpr double kStaleAge = 1.0;
/// A slow stream is given the time of two and a half samples (seconds); `rateHz` 0 where it is not known.
[[nodiscard]] constexpr double patienceAt(double rateHz) {
    return rateHz > 0 ? 2.5 / rateHz : 0.0;
}

/// "stale 3.2 s"; nothing while it is not.
[[nodiscard]] QString staleText(double ageSeconds, double rateHz = 0);

/// Whether a stream is well: age first, then malformed datagrams, then lost samples. Types that are sent now
/// and then (12, 13) never get stale. Of `losses` the range is that in which what was lost counts.
[[nodiscard]] PropertyValue streamState(model::SessionView& view, const model::Losses& losses,
                                        const model::Stream& stream);
[[nodiscard]] Health healthOf(model::TakeVerdict::State state);
/// A verdict in a few words; the tooltip has it in full.
[[nodiscard]] PropertyValue verdictState(const model::TakeVerdict& verdict);
/// The session's own verdict on a character (SessionView::verdicts).
[[nodiscard]] PropertyValue characterState(model::SessionView& view, const model::Character& character);

/// True while data keep coming: no older than kStaleAge.
[[nodiscard]] bool isLive(model::SessionView& view, const model::Character& character);

} // namespace posewire::gui
