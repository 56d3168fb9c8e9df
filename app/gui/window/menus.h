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

/// In the tables of the window: here come the entries that panels have in this menu and its submenus, or
/// those of the viewport.
inline constexpr const char* kPanelEntries = "panels";
inline constexpr const char* kViewportEntries = "viewport";

/// All entries in the order of the menus.
[[nodiscard]] std::vector<MenuEntry> menuEntries();

/// The menus of a window, with an action for each of menuEntries(): brings the dock of a panel to the front
/// before it carries out an entry of it.
class Menus {
public:
    Menus(MainWindow& window, QMenuBar& bar);

    /// Null if no entry has this id.
    [[nodiscard]] QAction* action(const QString& id) const { return m_actions.value(id); }
    /// Checks the entries as what they stand for is now; a menu that opens does so by itself.
    void showStates();

private:
    QAction* makeAction(const MenuEntry& entry);
    void list(const MenuEntry& entry, QMenu& menu);
    /// The panel that carries it out, or the window itself.
    [[nodiscard]] QWidget& ownerOf(const MenuEntry& entry) const;

    MainWindow& m_window;
    std::vector<MenuEntry> m_entries;
    QMap<QString, QAction*> m_actions;
};

[[nodiscard]] std::span<const ActionInfo> fileEntries();

/// Writes a report on the streams, of a range of time or of all there is. Returns what went wrong, empty for
/// nothing.
[[nodiscard]] QString writeStreamReport(model::SessionView& session,
                                        const std::optional<model::TimeRange>& range, const QString& path);

[[nodiscard]] std::span<const ActionInfo> viewportEntries();

/// Brings a dock to the front, whether it is open or not; triggers any other action.
void carryOut(MainWindow& window, QAction& action);

/// The menu at a path as in ActionInfo, new if need be.
[[nodiscard]] QMenu* menuAt(QMenuBar& bar, const QString& path);

} // namespace posewire::gui
