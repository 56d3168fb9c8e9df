// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/help_topics.h"
#include "app/gui/base/settings.h"
#include "app/gui/driver/session_driver.h"
#include "app/gui/inputs/inputs_dialog.h"
#include "app/gui/viewport/viewport_widget.h"
#include "app/gui/window/alerts.h"
#include "app/gui/window/guide.h"
#include "app/gui/window/menus.h"

#include <QMainWindow>

namespace posewire::gui {

class Docks;
class HealthBar;
class Opening;
class TransportBar;
class VerdictBar;

/// The window: viewport, docks and bars around one driver, and the menus that reach them all.
class MainWindow final : public QMainWindow {
    Q_OBJECT

public:
    /// `settings` are what was kept of the last run. The driver and the file must outlive the window.
    MainWindow(SessionDriver& driver, SettingsFile& file, const Settings& settings);

    [[nodiscard]] SessionDriver& driver() const { return m_driver; }
    [[nodiscard]] ViewportWidget& viewport() const { return *m_viewport; }
    [[nodiscard]] const Menus& menus() const { return m_menus; }
    [[nodiscard]] Docks& docks() const { return *m_docks; }
    [[nodiscard]] VerdictBar& verdict() const { return *m_verdict; }
    [[nodiscard]] Opening& opening() const { return *m_opening; }
    [[nodiscard]] Guide& guide() const { return *m_guide; }

    [[nodiscard]] Settings& kept() { return m_settings; }
    [[nodiscard]] const Settings& kept() const { return m_settings; }
    /// The same with what is only known when the window is left.
    [[nodiscard]] Settings settings() const;
    /// Those that have changed: whatever ends this program, the next one begins with them.
    void writeSettings();
    void keepHistory();

    void openInputs(InputsDialog::Page page);
    void useTheme(ThemeChoice choice);
    /// Name of a layout that ships, or a file.
    void useLayout(const QString& nameOrFile);
    /// The keyboard goes to the next part of the window (1), or the one before (-1).
    void moveFocus(int direction);

    /// A line at the bottom for a while, for what went wrong or was done.
    void say(const QString& text);
    /// The same with a way to what the guide says about it.
    void say(const QString& text, HelpTopic topic);
    /// Empty once the message has passed.
    [[nodiscard]] QString message() const;

protected:
    /// Tab and Shift+Tab pass by docks that lie behind others.
    bool focusNextPrevChild(bool isNext) override;
    void showEvent(QShowEvent* event) override;
    void closeEvent(QCloseEvent* event) override;

private:
    void makeBars();
    void connectDriver();
    void restore();
    void showLayoutName(const QString& name);
    /// Every part of the window shows the session that the driver shows.
    void showSession();
    void showReceiving();
    void showVerdict();

    SessionDriver& m_driver;
    SettingsFile& m_file;
    Settings m_settings;
    ViewportWidget* m_viewport;
    Menus m_menus;
    AlertSounds m_sounds;
    VerdictNotifier m_notifier{this};
    Guide* m_guide = new Guide(*this);
    Docks* m_docks = nullptr;
    Opening* m_opening = nullptr;
    TransportBar* m_transport = nullptr;
    VerdictBar* m_verdict = nullptr;
    HealthBar* m_health = nullptr;
    InputsDialog* m_inputs = nullptr; ///< once it was asked for
    QToolButton* m_layoutButton = nullptr;
    QString m_settingsProblem; ///< why they could not be written
    bool m_isRestored = false;
};

} // namespace posewire::gui
