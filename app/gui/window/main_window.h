// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/driver/session_driver.h"
#include "app/gui/inputs/inputs_dialog.h"
#include "app/gui/panel.h"
#include "app/gui/viewport/viewport_widget.h"
#include "app/gui/window/menus.h"
#include "app/gui/window/settings.h"

#include <QMainWindow>
#include <QVariant>

#include <vector>

class QDockWidget;
class QToolButton;

namespace posewire::gui {

class DockTitle;
class HealthBar;
class TransportBar;

/// The window: a loop over the table of docks and one over the table of actions.
class MainWindow final : public QMainWindow {
    Q_OBJECT

public:
    /// `settings` are what was kept of the last run. The driver and the file must outlive the window.
    MainWindow(SessionDriver& driver, const SettingsFile& file, const Settings& settings);

    [[nodiscard]] SessionDriver& driver() { return m_driver; }
    [[nodiscard]] ViewportWidget& viewport() { return *m_viewport; }

    // What the actions do.
    void openFile();
    void saveScreenshot();
    void saveReport();
    void editThresholds();
    void openInputs(InputsDialog::Page page);
    void useTheme(ThemeChoice choice);
    /// Name of a layout that ships, or a file.
    void useLayout(const QString& nameOrFile);
    void resetLayout() { useLayout(m_settings.layout); }
    /// Brings every floating dock back into the window, and the window back onto a screen.
    void dockAll();
    void nextDock();
    /// Shows a dock before the others and has its panel do what a slot of that name does. False where there
    /// is no such dock or slot.
    bool inDock(const char* dock, const char* slot);
    /// A property of a dock's panel; invalid where there is no such dock or property.
    [[nodiscard]] QVariant ofDock(const char* dock, const char* property) const;
    void showDock(const QString& dock);
    void toggleFullScreen();
    void copyDiagnostics();
    void showShortcuts();
    void showReference();
    void showAbout();

    /// A line at the bottom for a while, for what went wrong or was done.
    void say(const QString& text);

    /// As it would be kept now.
    [[nodiscard]] Settings settings() const;

protected:
    void showEvent(QShowEvent* event) override;
    void closeEvent(QCloseEvent* event) override;

private:
    struct Dock {
        QDockWidget* dock;
        DockTitle* title;
        Panel* panel;

        [[nodiscard]] bool isInSight() const;
    };

    [[nodiscard]] const Dock* find(const char* dock) const;
    void makeDocks();
    void makeBars();
    void listDocks();
    void connectDriver();
    void restore();
    void refreshPanels();
    void showReceiving();
    void alert();

    SessionDriver& m_driver;
    const SettingsFile& m_file;
    Settings m_settings;
    ViewportWidget* m_viewport;
    TransportBar* m_transport = nullptr;
    HealthBar* m_health = nullptr;
    InputsDialog* m_inputs = nullptr; ///< once it was asked for
    QToolButton* m_layoutButton = nullptr;
    ActionMap m_actions;
    AlertSounds m_sounds;
    std::vector<Dock> m_docks;
    bool m_isRestored = false;
};

/// Where a window of that place can be seen and grabbed on the screens there are; empty if nowhere.
[[nodiscard]] QRect onScreen(const QRect& window);

} // namespace posewire::gui
