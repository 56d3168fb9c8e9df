// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/session/session_view.h"

#include <QFontMetrics>
#include <QString>

#include <vector>

namespace posewire::gui {

struct TimeTick {
    log::Stamp stamp;
    QString text; ///< as exact as the ticks are close
};

/// Round times of day, which is the local one, as close as their texts have room; the first may be before the
/// window.
[[nodiscard]] std::vector<TimeTick> timeTicks(const model::SessionView& view, const model::TimeRange& window,
                                              int pixels, const QFontMetrics& metrics);

/// "12.5 ms", "3.2 s": the length of a window.
[[nodiscard]] QString inSight(log::Duration length);

} // namespace posewire::gui
