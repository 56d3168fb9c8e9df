// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QIcon>
#include <QString>

namespace posewire::gui {

/// An icon of resources/icons by its file name without ending, in the theme's text colour (or `colour`),
/// sharp at any pixel ratio. Made again when the theme changes: ask again then. Null where there is no such
/// icon.
[[nodiscard]] QIcon themedIcon(const QString& name, const QColor& colour = {});

/// The program's own icon, in its own colours.
[[nodiscard]] QIcon applicationIcon();

} // namespace posewire::gui
