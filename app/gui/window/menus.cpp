// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/menus.h"

#include "app/gui/base/dock_layout.h"
#include "app/gui/base/saving.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/theme/words.h"
#include "app/gui/window/main_window.h"
#include "app/gui/window/report_saving.h"
#include "app/gui/window/texts.h"
#include "app/gui/window/viewport_entries.h"
#include "core/model/session/verdict.h"

#include <QAction>
#include <QCoreApplication>
#include <QMenu>
#include <QMenuBar>

#include <set>
#include <string_view>

namespace posewire::gui {

namespace {

using Window = MainWindow;
using Do = ActionsOf<MainWindow>;
using Direction = Playback::Direction;

constexpr int kDemoCharacters = 2;

Commands& commands(const Window& window) {
    return window.driver().commands();
}
Playback& playback(const Window& window) {
    return window.driver().playback();
}
Files& files(const Window& window) {
    return window.driver().files();
}
Comparing& comparing(const Window& window) {
    return files(window).comparing();
}
Takes& takes(const Window& window) {
    return window.driver().takes();
}
Demo& demo(const Window& window) {
    return window.driver().demo();
}

void toggleDemo(Window& window) {
    demo(window).setCharacters(demo(window).isRunning() ? 0 : kDemoCharacters);
}

void togglePaused(Window& window) {
    playback(window).setPaused(!playback(window).isPaused());
}

void saveScreenshot(Window& window) {
    const QPixmap picture = window.grab();
    const QString path = askWhereToSave(&window, tr("Save screenshot"), QStringLiteral("posewire.png"),
                                        tr("Pictures (*.png)"));
    if (path.isEmpty()) {
        return;
    }
    const QString problem = savePicture(picture, path);
    if (problem.isEmpty()) {
        window.say(tr("Saved %1").arg(path));
    } else {
        window.say(problem, HelpTopic::SavingFailed);
    }
}

void saveReport(Window& window) {
    if (const QString line = saveStreamReport(commands(window).session(), &window); !line.isEmpty()) {
        window.say(line);
    }
}

void copyDiagnostics(Window& window) {
    copyText(diagnosticsText(commands(window).session(), window.driver().receiving().state(),
                             window.viewport().pictures().rendererName()));
    window.say(tr("Diagnostics copied"));
}

void showGuide(Window& window) {
    window.showHelp({});
}

template <HelpTopic topic>
void showPage(Window& window) {
    window.showHelp(placeOf(topic));
}

template <std::size_t index>
void useShippedLayout(Window& window) {
    window.useLayout(layoutNames()[index]);
}

template <Direction direction>
bool isPlaying(const Window& window) {
    return playback(window).isPlaying(direction);
}

void toggleLoop(Window& window) {
    playback(window).setLooping(!playback(window).isLooping());
}

template <int steps>
void stepSamples(Window& window) {
    if (const auto key = shownCharacter(commands(window).session())) {
        playback(window).stepSamples(*key, steps);
    } else {
        playback(window).stepPackets(steps);
    }
}

template <int seconds>
void stepSeconds(Window& window) {
    playback(window).stepTime(std::chrono::seconds(seconds));
}

template <int percent>
void setSpeed(Window& window) {
    playback(window).setSpeed(percent / 100.0);
}
template <int percent>
bool hasSpeed(const Window& window) {
    return playback(window).speed() == percent / 100.0;
}

/// The evidence of the live verdict, as a click on it gives it.
void showEvidence(Window& window) {
    window.showEvidence(commands(window).live().verdicts().all().all.incident);
}

/// What figures are of: the newest seconds, or all.
template <int seconds>
void useNewest(Window& window) {
    commands(window).selectRange({.last = std::chrono::seconds(seconds)});
}
void useSinceReset(Window& window) {
    commands(window).selectRange({.isSinceReset = true});
}
template <int seconds>
bool isNewestUsed(const Window& window) {
    return commands(window).session().choices().range ==
           model::RangeChoice{.last = std::chrono::seconds(seconds)};
}
bool isSinceResetUsed(const Window& window) {
    return commands(window).session().choices().range.isSinceReset;
}

/// Where the entries of panels go in a menu and in its submenus.
constexpr const char* kPanels = "panels"; ///< an id
/// Where those of the viewport go.
constexpr const char* kViewport = "viewport";
constexpr ActionInfo panelsIn(const char* menu) {
    return {kPanels, menu, "", ""};
}

constexpr const char* kSpeed = QT_TRANSLATE_NOOP("Action", "&Time/Sp&eed");
constexpr const char* kStep = QT_TRANSLATE_NOOP("Action", "&Time/&Step");

template <int percent>
constexpr ActionInfo speed(const char* id, const char* text) {
    return {id, kSpeed, text, "", Do::call<setSpeed<percent>>, Do::is<hasSpeed<percent>>};
}

template <int steps>
constexpr ActionInfo step(const char* id, const char* text, const char* shortcut) {
    return {id, kStep, text, shortcut, Do::call<stepSamples<steps>>};
}

constexpr const char* kFigures = QT_TRANSLATE_NOOP("Action", "&Time/Show &figures for");

const ActionInfo kActions[] = {
    {"open", QT_TRANSLATE_NOOP("Action", "&File"), QT_TRANSLATE_NOOP("Action", "&Open…"), "Ctrl+O",
     Do::call<&Window::openFile>},
    listIn(QT_TRANSLATE_NOOP("Action", "&File/Open rece&nt"), Do::list<&Window::listRecentFiles>),
    {"clearRecentFiles", "&File/Open rece&nt", QT_TRANSLATE_NOOP("Action", "&Clear list"), "",
     Do::call<&Window::clearRecentFiles>},
    {"closeFile", "&File", QT_TRANSLATE_NOOP("Action", "&Close recording"), "Ctrl+W",
     Do::callIn<files, &Files::close>},
    {"stopOpening", "&File", QT_TRANSLATE_NOOP("Action", "S&top opening"), "Esc",
     Do::callIn<files, &Files::cancelOpening>},
    lineIn("&File"),
    {"compareWith", "&File", QT_TRANSLATE_NOOP("Action", "Compare &with a recording…"), "Ctrl+Shift+O",
     Do::call<&Window::chooseComparison>},
    {"endComparison", "&File", QT_TRANSLATE_NOOP("Action", "&End comparison"), "",
     Do::callIn<comparing, &Comparing::close>},
    lineIn("&File"),
    {"saveScreenshot", "&File", QT_TRANSLATE_NOOP("Action", "&Save screenshot…"), "Ctrl+Shift+S",
     Do::call<saveScreenshot>},
    {"saveReport", "&File", QT_TRANSLATE_NOOP("Action", "Save stream re&port…"), "", Do::call<saveReport>},
    {"exportMotion", "&File", QT_TRANSLATE_NOOP("Action", "Export &motion…"), "",
     Do::call<&Window::exportMotion>},
    {"exportPictures", "&File", QT_TRANSLATE_NOOP("Action", "Export pict&ures…"), "",
     Do::call<&Window::exportPictures>},
    panelsIn("&File"),
    lineIn("&File"),
    {"record", "&File", QT_TRANSLATE_NOOP("Action", "Reco&rd"), "R", Do::call<&Window::toggleRecording>,
     Do::isIn<takes, &Takes::isRecording>},
    {"recordingOptions", "&File", QT_TRANSLATE_NOOP("Action", "Recor&ding options…"), "",
     Do::call<&Window::editRecording>},
    lineIn("&File"),
    {"replay", "&File", QT_TRANSLATE_NOOP("Action", "Repla&y to the network…"), "",
     Do::call<&Window::showReplay>},
    {"recovered", "&File", QT_TRANSLATE_NOOP("Action", "Reco&vered packets…"), "",
     Do::call<&Window::showRecovered>},
    {"history", "&File", QT_TRANSLATE_NOOP("Action", "&History…"), "", Do::call<&Window::editHistory>},
    lineIn("&File"),
    {"quit", "&File", QT_TRANSLATE_NOOP("Action", "&Quit"), "Ctrl+Q", Do::call<&Window::close>},

    panelsIn(QT_TRANSLATE_NOOP("Action", "&Edit")),

    {"inputs", QT_TRANSLATE_NOOP("Action", "&Input"), QT_TRANSLATE_NOOP("Action", "&Inputs…"), "Ctrl+U",
     Do::call<&Window::openInputs, InputsDialog::Page::Inputs>},
    {"demo", "&Input", QT_TRANSLATE_NOOP("Action", "&Demo stream"), "Ctrl+D", Do::call<toggleDemo>,
     Do::isIn<demo, &Demo::isRunning>},
    panelsIn("&Input"),

    {"resetLayout", QT_TRANSLATE_NOOP("Action", "&View"), QT_TRANSLATE_NOOP("Action", "&Reset layout"), "",
     Do::call<&Window::resetLayout>},
    {"dockAll", "&View", QT_TRANSLATE_NOOP("Action", "&Dock all"), "", Do::call<&Window::dockAll>},
    {"nextDock", "&View", QT_TRANSLATE_NOOP("Action", "&Next dock"), "F6", Do::call<&Window::moveFocus, 1>},
    {"previousDock", "&View", QT_TRANSLATE_NOOP("Action", "Previous doc&k"), "Shift+F6",
     Do::call<&Window::moveFocus, -1>},
    lineIn("&View"),
    {"layoutCheck", QT_TRANSLATE_NOOP("Action", "&View/La&yout"), QT_TRANSLATE_NOOP("Action", "&Check"),
     "Ctrl+1", Do::call<useShippedLayout<0>>},
    {"layoutDebug", "&View/La&yout", QT_TRANSLATE_NOOP("Action", "&Debug"), "Ctrl+2",
     Do::call<useShippedLayout<1>>},
    {"layoutInspect", "&View/La&yout", QT_TRANSLATE_NOOP("Action", "&Inspect"), "Ctrl+3",
     Do::call<useShippedLayout<2>>},
    {"themeSystem", QT_TRANSLATE_NOOP("Action", "&View/&Theme"),
     QT_TRANSLATE_NOOP("Action", "As the &desktop"), "", Do::call<&Window::useTheme, ThemeChoice::System>,
     Do::is<&Window::themeChoice, ThemeChoice::System>},
    {"themeDark", "&View/&Theme", QT_TRANSLATE_NOOP("Action", "Dar&k"), "",
     Do::call<&Window::useTheme, ThemeChoice::Dark>, Do::is<&Window::themeChoice, ThemeChoice::Dark>},
    {"themeLight", "&View/&Theme", QT_TRANSLATE_NOOP("Action", "&Light"), "",
     Do::call<&Window::useTheme, ThemeChoice::Light>, Do::is<&Window::themeChoice, ThemeChoice::Light>},
    {kViewport, "&View", "", ""},
    panelsIn("&View"),
    lineIn("&View"),
    {"fullScreen", "&View", QT_TRANSLATE_NOOP("Action", "F&ull screen"), "F11",
     Do::call<&Window::toggleFullScreen>, Do::is<&Window::isFullScreen>},

    panelsIn(QT_TRANSLATE_NOOP("Action", "&Go")),

    {"pause", QT_TRANSLATE_NOOP("Action", "&Time"), QT_TRANSLATE_NOOP("Action", "&Pause"), "Space",
     Do::call<togglePaused>, Do::isIn<playback, &Playback::isPaused>},
    {"live", "&Time", QT_TRANSLATE_NOOP("Action", "Back to &live"), "End",
     Do::callIn<playback, &Playback::goLive>},
    {"play", "&Time", QT_TRANSLATE_NOOP("Action", "Pl&ay from here"), "Shift+Space",
     Do::callIn<playback, &Playback::play, Direction::Forwards>, Do::is<isPlaying<Direction::Forwards>>},
    {"playBack", "&Time", QT_TRANSLATE_NOOP("Action", "Play bac&kwards"), "Ctrl+Shift+Space",
     Do::callIn<playback, &Playback::play, Direction::Backwards>, Do::is<isPlaying<Direction::Backwards>>},
    speed<5>("speed005", "0.0&5 ×"),
    speed<10>("speed01", "0.&1 ×"),
    speed<25>("speed025", "0.&25 ×"),
    speed<50>("speed05", "&0.5 ×"),
    speed<100>("speed1", "1 &×"),
    speed<200>("speed2", "2 ×"),
    speed<400>("speed4", "&4 ×"),
    speed<800>("speed8", "&8 ×"),
    speed<1600>("speed16", "1&6 ×"),
    {"loop", "&Time", QT_TRANSLATE_NOOP("Action", "L&oop"), "Ctrl+Alt+L", Do::call<toggleLoop>,
     Do::isIn<playback, &Playback::isLooping>},
    step<-1>("sampleBack", QT_TRANSLATE_NOOP("Action", "Previous sa&mple"), "Left"),
    step<1>("sampleOn", QT_TRANSLATE_NOOP("Action", "&Next sample"), "Right"),
    step<-10>("tenBack", QT_TRANSLATE_NOOP("Action", "Ten samples bac&k"), "Shift+Left"),
    step<10>("tenOn", QT_TRANSLATE_NOOP("Action", "&Ten samples on"), "Shift+Right"),
    {"secondBack", kStep, QT_TRANSLATE_NOOP("Action", "One second &back"), "Ctrl+Left",
     Do::call<stepSeconds<-1>>},
    {"secondOn", kStep, QT_TRANSLATE_NOOP("Action", "One &second on"), "Ctrl+Right",
     Do::call<stepSeconds<1>>},
    {"packetBack", kStep, QT_TRANSLATE_NOOP("Action", "Previous pa&cket"), ",",
     Do::callIn<playback, &Playback::stepPackets, -1>},
    {"packetOn", kStep, QT_TRANSLATE_NOOP("Action", "Next &packet"), ".",
     Do::callIn<playback, &Playback::stepPackets, 1>},
    {"showFile", "&Time", QT_TRANSLATE_NOOP("Action", "Show the &recording"), "Shift+End",
     Do::callIn<files, &Files::show>},
    {"resetForTake", "&Time", QT_TRANSLATE_NOOP("Action", "Reset &before take"), "Ctrl+Shift+R",
     Do::callIn<commands, &Commands::resetForTake>},
    {"verdictEvidence", "&Time", QT_TRANSLATE_NOOP("Action", "E&vidence of the verdict"), "Ctrl+E",
     Do::call<showEvidence>},
    {"figures10s", kFigures, QT_TRANSLATE_NOOP("Action", "The last 10 &s"), "", Do::call<useNewest<10>>,
     Do::is<isNewestUsed<10>>},
    {"figuresMinute", kFigures, QT_TRANSLATE_NOOP("Action", "The last &minute"), "", Do::call<useNewest<60>>,
     Do::is<isNewestUsed<60>>},
    {"figuresSinceReset", kFigures, QT_TRANSLATE_NOOP("Action", "The time since the &reset"), "",
     Do::call<useSinceReset>, Do::is<isSinceResetUsed>},
    {"figuresOfAll", kFigures, QT_TRANSLATE_NOOP("Action", "&All"), "", Do::call<useNewest<0>>,
     Do::is<isNewestUsed<0>>},
    panelsIn("&Time"),

    {"relay", QT_TRANSLATE_NOOP("Action", "T&ools"), QT_TRANSLATE_NOOP("Action", "&Relay…"), "Ctrl+R",
     Do::call<&Window::openInputs, InputsDialog::Page::Relay>},
    {"thresholds", QT_TRANSLATE_NOOP("Action", "T&ools"), QT_TRANSLATE_NOOP("Action", "&Thresholds…"),
     "Ctrl+T", Do::call<&Window::editThresholds>},
    {"copyDiagnostics", QT_TRANSLATE_NOOP("Action", "T&ools"),
     QT_TRANSLATE_NOOP("Action", "&Copy diagnostics"), "", Do::call<copyDiagnostics>},

    panelsIn("T&ools"),
    lineIn("T&ools"),
    {"findCommand", "T&ools", QT_TRANSLATE_NOOP("Action", "&Find a command…"), "Ctrl+Shift+P",
     Do::call<&Window::findCommand>},

    {"guide", QT_TRANSLATE_NOOP("Action", "&Help"), QT_TRANSLATE_NOOP("Action", "&User guide"), "Ctrl+F1",
     Do::call<showGuide>},
    {"helpHere", "&Help", QT_TRANSLATE_NOOP("Action", "&Help on this part of the window"), "F1",
     Do::call<&Window::showHelpHere>},
    {"causes", "&Help", QT_TRANSLATE_NOOP("Action", "&What a cause means"), "",
     Do::call<showPage<HelpTopic::Causes>>},
    panelsIn("&Help"),
    {"shortcuts", "&Help", QT_TRANSLATE_NOOP("Action", "&Keyboard shortcuts"), "",
     Do::call<showPage<HelpTopic::Shortcuts>>},
    {"tour", "&Help", QT_TRANSLATE_NOOP("Action", "&First steps"), "",
     Do::call<showPage<HelpTopic::FirstSteps>>},
    lineIn("&Help"),
    {"connectionHelp", "&Help", QT_TRANSLATE_NOOP("Action", "&Connection help"), "Shift+F1",
     Do::call<&Window::openInputs, InputsDialog::Page::Help>},
    {"reference", "&Help", QT_TRANSLATE_NOOP("Action", "&Protocol reference"), "",
     Do::call<showPage<HelpTopic::Protocol>>},
    lineIn("&Help"),
    {"about", "&Help", QT_TRANSLATE_NOOP("Action", "&About Posewire"), "", Do::call<showAbout>},
};

template <typename Parent>
QMenu* childMenu(Parent& parent, const QString& name) {
    for (QAction* action : parent.actions()) {
        if (action->menu() != nullptr && action->menu()->objectName() == name) {
            return action->menu();
        }
    }
    QMenu* menu = parent.addMenu(QCoreApplication::translate("Action", name.toUtf8().constData()));
    menu->setObjectName(name);
    return menu;
}

} // namespace

std::vector<MenuEntry> menuEntries() {
    std::vector<MenuEntry> entries;
    for (const ActionInfo& info : kActions) {
        if (std::string_view(info.id) == kViewport) {
            for (const ActionInfo& entry : viewportEntries()) {
                entries.push_back({&entry, nullptr});
            }
            continue;
        }
        if (std::string_view(info.id) != kPanels) {
            entries.push_back({&info, nullptr});
            continue;
        }
        for (const PanelInfo& panel : panelTable()) {
            for (const ActionInfo& action : panel.actions()) {
                if (std::string_view(action.menu).starts_with(info.menu)) {
                    entries.push_back({&action, &panel});
                }
            }
        }
    }
    return entries;
}

QMenu* menuAt(QMenuBar& bar, const QString& path) {
    const QStringList names = path.split(QLatin1Char('/'));
    QMenu* menu = childMenu(bar, names[0]);
    for (const QString& name : names.mid(1)) {
        menu = childMenu(*menu, name);
    }
    return menu;
}

Menus::Menus(MainWindow& window, QMenuBar& bar) : m_window(window), m_entries(menuEntries()) {
    std::set<QMenu*> connected;
    for (const MenuEntry& entry : m_entries) {
        QMenu* menu = menuAt(bar, QString::fromUtf8(entry.action->menu));
        if (entry.action->list != nullptr) {
            QObject::connect(menu, &QMenu::aboutToShow, &window, [&window, entry, menu] {
                menu->clear();
                window.list(entry, *menu);
            });
            continue;
        }
        if (entry.action->run == nullptr) {
            menu->addSeparator();
            continue;
        }
        if (connected.insert(menu).second) {
            QObject::connect(menu, &QMenu::aboutToShow, &window, [this] { showStates(); });
        }
        menu->addAction(makeAction(entry));
    }
}

QAction* Menus::makeAction(const MenuEntry& entry) {
    const ActionInfo& info = *entry.action;
    auto* action = new QAction(QCoreApplication::translate("Action", info.text), &m_window);
    action->setObjectName(QLatin1String(info.id));
    action->setShortcut(QKeySequence(QLatin1String(info.shortcut), QKeySequence::PortableText));
    action->setCheckable(info.isOn != nullptr);
    QObject::connect(action, &QAction::triggered, &m_window, [this, entry] {
        m_window.carryOut(entry);
        showStates();
    });
    // Also reachable while the menu bar is hidden.
    m_window.addAction(action);
    m_actions.insert(action->objectName(), action);
    return action;
}

void Menus::showStates() {
    for (const MenuEntry& entry : m_entries) {
        if (entry.action->isOn != nullptr) {
            m_actions[QLatin1String(entry.action->id)]->setChecked(m_window.isOn(entry));
        }
    }
}

} // namespace posewire::gui
