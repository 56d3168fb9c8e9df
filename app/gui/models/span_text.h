// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/session/session_view.h"

#include <QString>

#include <optional>

namespace posewire::gui {

/// From the first packet to now, whatever the cursor; of a recording to its last packet. Nothing before
/// anything came.
[[nodiscard]] std::optional<model::TimeRange> wholeSpan(const model::SessionView& view);

/// What time figures are of, in the words that every dock has for it: "last 10 s", "since reset, 3.2 s",
/// "selection 10:42:17.5 + 2.1 s", "all, 12 min"; empty before anything came.
[[nodiscard]] QString spanText(const model::SessionView& view);

} // namespace posewire::gui
