// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QAction>
#include <QMap>
#include <QMenu>
#include <QMenuBar>
#include <QString>

namespace posewire::gui {

class MainWindow;

/// Every entry of actionTable() by its id.
using ActionMap = QMap<QString, QAction*>;

/// Builds the menus of a window from the table.
[[nodiscard]] ActionMap makeMenus(MainWindow& window, QMenuBar& bar);

/// The menu at a path as in ActionInfo, new if need be.
[[nodiscard]] QMenu* menuAt(QMenuBar& bar, const QString& path);

} // namespace posewire::gui
