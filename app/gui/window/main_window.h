// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/help_topics.h"
#include "app/gui/base/settings.h"
#include "app/gui/driver/session_driver.h"
#include "app/gui/inputs/inputs_dialog.h"
#include "app/gui/panels/panels.h"
#include "app/gui/viewport/viewport_widget.h"
#include "app/gui/window/alerts.h"
#include "app/gui/window/menus.h"

#include <QMainWindow>

#include <memory>
#include <vector>

class QDockWidget;
class QToolButton;
class QUrl;

namespace posewire::gui {

class DockTitle;
class HealthBar;
class HelpPages;
class TransportBar;
class VerdictBar;

/// The window: a loop over the table of docks and one over the table of actions.
class MainWindow final : public QMainWindow {
    Q_OBJECT

public:
    /// `settings` are what was kept of the last run. The driver and the file must outlive the window.
    MainWindow(SessionDriver& driver, const SettingsFile& file, const Settings& settings);
    ~MainWindow() override;

    [[nodiscard]] SessionDriver& driver() const { return m_driver; }
    [[nodiscard]] ViewportWidget& viewport() const { return *m_viewport; }

    /// Does what an entry of the menus says; where a panel does it, its dock is brought to the front first.
    void carryOut(const MenuEntry& entry);
    /// Fills a menu with what an entry lists there.
    void list(const MenuEntry& entry, QMenu& menu);
    [[nodiscard]] bool isOn(const MenuEntry& entry) const;

    // What the actions do.
    void openFile();
    void openPath(const QString& path);
    /// Asks for the recording that what is shown is to be compared with.
    void chooseComparison();
    void compareWith(const QString& path);
    void listRecentFiles(QMenu& menu);
    void toggleRecording();
    void editRecording();
    void clearRecentFiles() { m_settings.recentFiles.clear(); }
    void editThresholds();
    void openInputs(InputsDialog::Page page);
    void useTheme(ThemeChoice choice);
    [[nodiscard]] ThemeChoice themeChoice() const { return m_settings.theme; }
    /// Name of a layout that ships, or a file.
    void useLayout(const QString& nameOrFile);
    void resetLayout() { useLayout(m_settings.layout); }
    /// Brings every floating dock back into the window, and the window back onto a screen.
    void dockAll();
    /// The keyboard goes to the next part of the window (1), or the one before (-1).
    void moveFocus(int direction);
    /// Lists all commands of the menus, to be found by their words.
    void findCommand();
    void editHistory();
    void showReplay();
    void exportMotion();
    void exportPictures();
    void editOwnCharacter();
    /// What was received by a run that did not end well, to be opened or saved.
    void showRecovered();
    /// The same where there is any.
    void offerRecovered();
    /// Brings a dock to the front, by its object name.
    void showDock(const QString& dock);
    /// What the live verdict rests on, with the keyboard: Enter leads to its packets.
    void showEvidence(std::optional<std::uint64_t> incident);
    /// A dock, bar or part of them by its object name, in the front; null where there is none.
    [[nodiscard]] QWidget* showPart(const QString& name);
    /// Shows a place of the user guide, its first page for none; over a dialog that waits for an answer where
    /// there is one.
    void showHelp(const QString& place);
    /// That of the dock, bar or viewport that has the keyboard.
    void showHelpHere();
    /// At the first start: says where the guide leads through the window.
    void offerFirstSteps();
    void toggleFullScreen() { setWindowState(windowState() ^ Qt::WindowFullScreen); }

    /// A line at the bottom for a while, for what went wrong or was done.
    void say(const QString& text);
    /// The same with a way to what the guide says about it.
    void say(const QString& text, HelpTopic topic);

    /// As it would be kept now.
    [[nodiscard]] Settings settings() const;

public slots:
    /// Of links into the guide: see openHelp().
    void followHelpLink(const QUrl& link);

protected:
    /// Tab and Shift+Tab pass by docks that lie behind others.
    bool focusNextPrevChild(bool isNext) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void closeEvent(QCloseEvent* event) override;

private:
    /// Also once a file has been opened, which is told of meanwhile.
    void sayAlsoAfterOpening(const QString& text);
    void noteRecent(const QString& path);
    [[nodiscard]] QString placeOfRecordings() const;
    /// What a dock shows of one session.
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

    [[nodiscard]] const Dock* findDock(const QString& name) const;
    [[nodiscard]] QStringList docksInSight() const;
    void coverBy(const QString& name);
    void uncover();
    [[nodiscard]] QAction* dockAction(QDockWidget* dock);
    void toggleDock(const QString& name);
    /// Who carries an entry out: the panel, or the window itself.
    [[nodiscard]] const QWidget& ownerOf(const MenuEntry& entry) const;
    void makeDocks();
    [[nodiscard]] Page makePage(const PanelInfo& info, QDockWidget* dock);
    /// Every part of the window shows the session that the driver shows.
    void showSession();
    void forgetFile();
    void showVerdict();
    void makeBars();
    void connectDriver();
    void restore();
    void showLayoutName(const QString& name);
    void refreshPanels();
    void showReceiving();
    void showOpening();
    void keepRelays();
    void keepHistory();
    void alert();
    void connectHelp();

    SessionDriver& m_driver;
    const SettingsFile& m_file;
    Settings m_settings;
    ViewportWidget* m_viewport;
    TransportBar* m_transport = nullptr;
    VerdictBar* m_verdict = nullptr;
    HealthBar* m_liveHealth = nullptr;
    HealthBar* m_fileHealth = nullptr; ///< as Dock::file
    HealthBar* m_health = nullptr;     ///< the one that is shown
    InputsDialog* m_inputs = nullptr;  ///< once it was asked for
    QToolButton* m_layoutButton = nullptr;
    QToolButton* m_stopOpening = nullptr; ///< shown while a file is being opened
    Menus m_menus;
    AlertSounds m_sounds;
    VerdictNotifier m_notifier{this};
    std::vector<Dock> m_docks;
    std::unique_ptr<HelpPages> m_helpPages; ///< once the guide was asked for
    QString m_covered; ///< dock that the newest request for another one hid; empty for none
    bool m_isRestored = false;
    bool m_saysOpening = false; ///< the bar at the bottom does
    QString m_sayAgain;         ///< of which the bar at the bottom says that a file is being opened instead
};

/// Where a window of that place is wholly seen on the screens there are, moved if it must be; empty if it
/// cannot be grabbed where it is.
[[nodiscard]] QRect onScreen(const QRect& window);

} // namespace posewire::gui
