// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/panels/panels.h"

#include <QMap>
#include <QString>

#include <vector>

class QAction;
class QMenu;
class QMenuBar;

namespace posewire::gui {

class MainWindow;

/// An entry of the window's menus and who carries it out.
struct MenuEntry {
    const ActionInfo* action;
    const PanelInfo* panel; ///< null for the window itself
};

/// All entries in the order of the menus. The window's own are in menus.cpp, which also says where in each
/// menu those of the panels go.
[[nodiscard]] std::vector<MenuEntry> menuEntries();

/// The menus of a window, with an action for each of menuEntries().
class Menus {
public:
    Menus(MainWindow& window, QMenuBar& bar);

    /// Null where no entry has this id.
    [[nodiscard]] QAction* action(const QString& id) const { return m_actions.value(id); }
    /// Checks the entries as what they stand for is now; a menu that opens does so by itself.
    void showStates();

private:
    QAction* makeAction(const MenuEntry& entry);

    MainWindow& m_window;
    std::vector<MenuEntry> m_entries;
    QMap<QString, QAction*> m_actions;
};

/// The menu at a path as in ActionInfo, new if need be.
[[nodiscard]] QMenu* menuAt(QMenuBar& bar, const QString& path);

} // namespace posewire::gui
