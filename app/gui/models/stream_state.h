// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"
#include "core/model/session/session_view.h"

namespace posewire::gui {

/// Without data for this long a stream is silent, and for the second it is stale (seconds).
inline constexpr double kSilentAge = model::Condition::kSilentS;
inline constexpr double kStaleAge = model::Condition::kStaleS;

/// Whether a stream is well: age first, then malformed datagrams, then lost samples. Types that are sent now
/// and then (12, 13) never get stale.
[[nodiscard]] PropertyValue streamState(model::SessionView& view, const model::Stream& stream);
/// The session's own judgement (SessionView::conditionOf) in a few words; what was lost in all where it is
/// good.
[[nodiscard]] PropertyValue characterState(model::SessionView& view, const model::Character& character);
[[nodiscard]] PropertyValue senderState(model::SessionView& view, const model::Sender& sender);

/// True while data keep coming: no older than kStaleAge.
[[nodiscard]] bool isLive(model::SessionView& view, const model::Character& character);

} // namespace posewire::gui
