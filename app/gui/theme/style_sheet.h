// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFontMetrics>
#include <QString>

namespace posewire::gui {

struct Theme;

/// What the palette cannot say: lines, paddings, rounded corners. Colours come from the theme, sizes from the
/// metrics.
[[nodiscard]] QString styleSheet(const Theme& theme, const QFontMetrics& metrics);

} // namespace posewire::gui
