// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/panels/panels.h"

#include <QJsonObject>
#include <QObject>
#include <QRect>

#include <optional>
#include <vector>

class QAction;
class QDockWidget;
class QMainWindow;
class QMenu;

namespace posewire::gui {

class DockTitle;
class SessionDriver;

/// The docks of the window, one for each row of the table of panels. Each has a page for what is received,
/// and another for the file that is shown. Knows which dock lies in front, and moves the keyboard between
/// them.
class Docks final : public QObject {
    Q_OBJECT

public:
    /// Adds the docks to the window, hidden, and an entry for each at the top of `menu`. `states` are as
    /// states() returns them. Driver and window must outlive it.
    Docks(SessionDriver& driver, QMainWindow& window, QMenu& menu, const QJsonObject& states);

    /// Panel::state() by the name of the dock; `before` keeps those of docks that do not exist.
    [[nodiscard]] QJsonObject states(QJsonObject before) const;
    /// The panel of the page that is shown.
    [[nodiscard]] Panel& panelOf(const PanelInfo& info) const;

    /// Every dock shows the session that the driver shows.
    void showSession();
    /// The session of the file is about to go.
    void forgetFile();
    void refresh();

    /// Brings a dock to the front, by its object name.
    void show(const QString& name);
    /// Brings a dock to the front and gives it the keyboard.
    void enter(const QString& name);
    /// A dock, bar or part of them by its object name, in the front; null if there is none.
    [[nodiscard]] QWidget* showPart(const QString& name);
    /// Shows what the live verdict, or that of the recording, rests on, with the keyboard: Enter leads to its
    /// packets.
    void showEvidence(std::optional<std::uint64_t> incident, bool isOfFile);
    /// Shows a dock, and keeps which one its tab covers.
    void coverBy(const QString& name);
    /// Brings back what coverBy() has covered, and the keyboard with it.
    void uncover();
    /// Brings every floating dock back into the window, and the window back onto a screen.
    void dockAll();
    /// Brings those floating docks back that lie on no screen.
    void dockUnseen();
    /// Moves the keyboard to the next part of the window (1), or the one before (-1): `first`, the docks, and
    /// `last` unless it is null.
    void moveFocus(int direction, QWidget& first, QWidget* last);

private:
    struct Page {
        QWidget* scroll = nullptr;
        Panel* panel = nullptr;
    };
    struct Dock {
        const PanelInfo* info;
        QDockWidget* dock;
        DockTitle* title;
        Page live;
        Page file;    ///< once a file was shown, until it is closed
        Panel* panel; ///< of the page that is shown

        [[nodiscard]] bool isInSight() const;
    };

    void add(const PanelInfo& info, const QJsonObject& state);
    [[nodiscard]] Page makePage(const PanelInfo& info, QDockWidget* dock);
    /// Opens and closes a dock; brings one that lies behind another to the front, for it was not seen.
    [[nodiscard]] QAction* actionFor(const QString& name);
    [[nodiscard]] const Dock* find(const QString& name) const;

    SessionDriver& m_driver;
    QMainWindow& m_window;
    std::vector<Dock> m_docks;
    const Dock* m_covered = nullptr; ///< the newest request for another one hid it
};

/// Moves the place of a window so that the screens show all of it; empty if it cannot be grabbed where it is.
[[nodiscard]] QRect onScreen(const QRect& window);

} // namespace posewire::gui
