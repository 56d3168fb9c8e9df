// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/menus.h"

#include "app/gui/base/dock_layout.h"
#include "app/gui/base/saving.h"
#include "app/gui/models/packet_choice.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"
#include "app/gui/window/about.h"
#include "app/gui/window/command_palette.h"
#include "app/gui/window/diagnostics.h"
#include "app/gui/window/docks.h"
#include "app/gui/window/guide.h"
#include "app/gui/window/main_window.h"
#include "app/gui/window/preferences.h"
#include "app/gui/window/verdict_bar.h"

#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QMenu>
#include <QMenuBar>
#include <QRegularExpression>

#include <array>
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
Demo& demo(const Window& window) {
    return window.driver().demo();
}

void toggleDemo(Window& window) {
    demo(window).setCharacters(demo(window).isRunning() ? 0 : kDemoCharacters);
}

void toggleLoop(Window& window) {
    playback(window).setLooping(!playback(window).isLooping());
}

void copyDiagnostics(Window& window) {
    copyText(diagnosticsText(commands(window).session(), window.driver().receiving().state(),
                             window.viewport().pictures().rendererName()));
    window.say(tr("Diagnostics copied"));
}

void showGuide(Window& window) {
    window.guide().show({});
}

void showHelpHere(Window& window) {
    window.guide().show(helpPlaceOf(QApplication::focusWidget()));
}

template <HelpTopic topic>
void showPage(Window& window) {
    window.guide().show(placeOf(topic));
}

void findCommand(Window& window) {
    CommandPalette palette(*window.menuBar(), &window);
    palette.exec();
    if (QAction* chosen = palette.chosen()) {
        carryOut(window, *chosen);
    }
}

void resetLayout(Window& window) {
    window.useLayout(window.kept().layout);
}

void toggleFullScreen(Window& window) {
    window.setWindowState(window.windowState() ^ Qt::WindowFullScreen);
}

template <ThemeChoice choice>
bool isThemed(const Window& window) {
    return window.kept().theme == choice;
}

template <std::size_t index>
void useShippedLayout(Window& window) {
    window.useLayout(layoutNames()[index]);
}

template <int steps>
void stepSamples(Window& window) {
    if (const auto key = shownCharacter(commands(window).session())) {
        playback(window).stepSamples(*key, steps);
    } else {
        playback(window).stepPackets(steps);
    }
}

template <int steps>
void trimRange(Window& window) {
    if (const auto key = shownCharacter(commands(window).session())) {
        playback(window).trimRange(*key, steps);
    }
}

/// Moves the edge of a selected range by one sample; without a range, the display by ten.
template <int way>
void stepFar(Window& window) {
    commands(window).session().choices().range.fixed ? trimRange<way>(window) : stepSamples<10 * way>(window);
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

void goBack(Window& window) {
    if (!commands(window).goBack()) {
        window.say(tr("There is nothing to go back to: no jump led here."));
    }
}

void goForward(Window& window) {
    if (!commands(window).goForward()) {
        window.say(tr("There is nothing to go forward to: no way back led here."));
    }
}

/// "12.5 s to 20 s"; returns what is wrong with it, empty for nothing.
QString setRange(Window& window, const QString& text) {
    static const QRegularExpression between(QStringLiteral("\\.\\.|…|–|\\s-\\s|\\sto\\s"));
    model::SessionView& session = commands(window).session();
    const QStringList ends = text.split(between, Qt::SkipEmptyParts);
    if (ends.size() != 2) {
        return tr("Write two times with \"to\" between them.");
    }
    std::array<log::Stamp, 2> stamps{};
    log::Duration last{};
    for (std::size_t i = 0; i < stamps.size(); ++i) {
        const QString end = ends[static_cast<qsizetype>(i)].simplified();
        const auto number = packetTarget(session, end);
        const auto time = timeTarget(session, end);
        if (!number && (i == 0 || !time)) { // it may end after the newest packet
            return number.error();
        }
        const auto packet = time ? std::nullopt : session.packet(*number);
        stamps[i] = packet ? packet->stamp : time.value_or(stamps[i]);
        last = log::Duration(packet ? 1 : 0); // a packet at the end is included
    }
    if (stamps[1] < stamps[0]) {
        return tr("The second time is before the first one.");
    }
    commands(window).selectRange({.fixed = model::TimeRange{stamps[0], stamps[1] + last}});
    return {};
}

void editRange(Window& window) {
    static_cast<void>(askForText(
        {tr("Range"), tr("&From and to: times, or numbers of packets"),
         tr("12.5 s to 20 s, 10:42:17.508 to 10:42:20"), tr("Set")},
        [&window](const QString& text) { return setRange(window, text); }, &window));
}

VerdictBar& verdict(const Window& window) {
    return window.verdict();
}

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

constexpr ActionInfo panelsIn(const char* menu) {
    return {kPanelEntries, menu, "", ""};
}

constexpr const char* kSpeed = QT_TRANSLATE_NOOP("Action", "&Time/Sp&eed");
constexpr const char* kStep = QT_TRANSLATE_NOOP("Action", "&Time/&Step");

template <int percent>
constexpr ActionInfo speed(const char* id, const char* text) {
    return {id, kSpeed, text, "", Do::call<setSpeed<percent>>, Do::is<hasSpeed<percent>>};
}

constexpr const char* kRange = QT_TRANSLATE_NOOP("Action", "&Time/Ran&ge");
constexpr const char* kFigures = QT_TRANSLATE_NOOP("Action", "&Time/Show &figures for");

const ActionInfo kActions[] = {
    panelsIn(QT_TRANSLATE_NOOP("Action", "&Edit")),

    {"inputs", QT_TRANSLATE_NOOP("Action", "&Input"), QT_TRANSLATE_NOOP("Action", "&Inputs…"), "Ctrl+U",
     Do::call<&Window::openInputs, InputsDialog::Page::Inputs>},
    {"demo", "&Input", QT_TRANSLATE_NOOP("Action", "&Demo stream"), "Ctrl+D", Do::call<toggleDemo>,
     Do::isIn<demo, &Demo::isRunning>},
    panelsIn("&Input"),

    {"resetLayout", QT_TRANSLATE_NOOP("Action", "&View"), QT_TRANSLATE_NOOP("Action", "&Reset layout"), "",
     Do::call<resetLayout>},
    {"dockAll", "&View", QT_TRANSLATE_NOOP("Action", "&Dock all"), "",
     Do::callIn<&Window::docks, &Docks::dockAll>},
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
     Do::is<isThemed<ThemeChoice::System>>},
    {"themeDark", "&View/&Theme", QT_TRANSLATE_NOOP("Action", "Dar&k"), "",
     Do::call<&Window::useTheme, ThemeChoice::Dark>, Do::is<isThemed<ThemeChoice::Dark>>},
    {"themeLight", "&View/&Theme", QT_TRANSLATE_NOOP("Action", "&Light"), "",
     Do::call<&Window::useTheme, ThemeChoice::Light>, Do::is<isThemed<ThemeChoice::Light>>},
    {kViewportEntries, "&View", "", ""},
    panelsIn("&View"),
    lineIn("&View"),
    {"fullScreen", "&View", QT_TRANSLATE_NOOP("Action", "F&ull screen"), "F11", Do::call<toggleFullScreen>,
     Do::is<&Window::isFullScreen>},

    {"back", QT_TRANSLATE_NOOP("Action", "&Go"), QT_TRANSLATE_NOOP("Action", "&Back to before the jump"),
     "Alt+Left", Do::call<goBack>},
    {"forward", "&Go", QT_TRANSLATE_NOOP("Action", "Fo&rward again"), "Alt+Right", Do::call<goForward>},
    lineIn("&Go"),
    panelsIn("&Go"),

    {"pause", QT_TRANSLATE_NOOP("Action", "&Time"), QT_TRANSLATE_NOOP("Action", "&Play or pause"), "Space",
     Do::callIn<playback, &Playback::playOrStop>},
    {"live", "&Time", QT_TRANSLATE_NOOP("Action", "Back to &live"), "L",
     Do::callIn<playback, &Playback::goLive>},
    {"first", "&Time", QT_TRANSLATE_NOOP("Action", "F&irst sample"), "Home",
     Do::callIn<playback, &Playback::goToFirst>},
    {"last", "&Time", QT_TRANSLATE_NOOP("Action", "L&ast sample"), "End",
     Do::callIn<playback, &Playback::goToLast>},
    lineIn("&Time"),
    {"playBack", "&Time", QT_TRANSLATE_NOOP("Action", "Play bac&kwards"), "Ctrl+Shift+Space",
     Do::callIn<playback, &Playback::play, Direction::Backwards>,
     Do::isFor<playback, &Playback::isPlaying, Direction::Backwards>},
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
    {"sampleBack", kStep, QT_TRANSLATE_NOOP("Action", "Previous sa&mple"), "Left", Do::call<stepSamples<-1>>},
    {"sampleOn", kStep, QT_TRANSLATE_NOOP("Action", "&Next sample"), "Right", Do::call<stepSamples<1>>},
    {"tenBack", kStep, QT_TRANSLATE_NOOP("Action", "Ten samples bac&k"), "Shift+Left", Do::call<stepFar<-1>>},
    {"tenOn", kStep, QT_TRANSLATE_NOOP("Action", "&Ten samples on"), "Shift+Right", Do::call<stepFar<1>>},
    {"secondBack", kStep, QT_TRANSLATE_NOOP("Action", "One second &back"), "Ctrl+Left",
     Do::call<stepSeconds<-1>>},
    {"secondOn", kStep, QT_TRANSLATE_NOOP("Action", "One &second on"), "Ctrl+Right",
     Do::call<stepSeconds<1>>},
    {"packetBack", kStep, QT_TRANSLATE_NOOP("Action", "Previous pa&cket"), ",",
     Do::callIn<playback, &Playback::stepPackets, -1>},
    {"packetOn", kStep, QT_TRANSLATE_NOOP("Action", "Next &packet"), ".",
     Do::callIn<playback, &Playback::stepPackets, 1>},
    lineIn("&Time"),
    {"rangeIn", kRange, QT_TRANSLATE_NOOP("Action", "&Begin here"), "I",
     Do::callIn<playback, &Playback::setRangeEdge, false>},
    {"rangeOut", kRange, QT_TRANSLATE_NOOP("Action", "&End here"), "O",
     Do::callIn<playback, &Playback::setRangeEdge, true>},
    {"trimBack", kRange, QT_TRANSLATE_NOOP("Action", "Last edge a sample bac&k"), "",
     Do::call<trimRange<-1>>},
    {"trimOn", kRange, QT_TRANSLATE_NOOP("Action", "Last edge a sample &on"), "", Do::call<trimRange<1>>},
    {"rangeTimes", kRange, QT_TRANSLATE_NOOP("Action", "&Times…"), "Ctrl+I", Do::call<editRange>},
    {"rangeClear", kRange, QT_TRANSLATE_NOOP("Action", "&Clear"), "Ctrl+Shift+I", Do::call<useNewest<0>>},
    {"showFile", "&Time", QT_TRANSLATE_NOOP("Action", "Show the &recording"), "Shift+End",
     Do::callIn<files, &Files::show>},
    {"resetForTake", "&Time", QT_TRANSLATE_NOOP("Action", "Reset &before take"), "Ctrl+Shift+R",
     Do::callIn<commands, &Commands::resetForTake>},
    {"verdictEvidence", "&Time", QT_TRANSLATE_NOOP("Action", "E&vidence of the verdict"), "Ctrl+E",
     Do::callIn<verdict, &VerdictBar::showEvidence>},
    {"figures10s", kFigures, QT_TRANSLATE_NOOP("Action", "The last 10 &s"), "", Do::call<useNewest<10>>,
     Do::is<isNewestUsed<10>>},
    {"figuresMinute", kFigures, QT_TRANSLATE_NOOP("Action", "The last &minute"), "", Do::call<useNewest<60>>,
     Do::is<isNewestUsed<60>>},
    {"figuresSinceReset", kFigures, QT_TRANSLATE_NOOP("Action", "The time since the &reset"), "",
     Do::call<useSinceReset>, Do::is<isSinceResetUsed>},
    {"figuresOfAll", kFigures, QT_TRANSLATE_NOOP("Action", "&All"), "", Do::call<useNewest<0>>,
     Do::is<isNewestUsed<0>>},
    panelsIn("&Time"),

    {"waysOut", QT_TRANSLATE_NOOP("Action", "T&ools"), QT_TRANSLATE_NOOP("Action", "&Ways out…"), "Ctrl+R",
     Do::call<&Window::openInputs, InputsDialog::Page::WaysOut>},
    {"thresholds", QT_TRANSLATE_NOOP("Action", "T&ools"), QT_TRANSLATE_NOOP("Action", "&Thresholds…"),
     "Ctrl+T", Do::call<openPreferences, PreferencesSection::Thresholds>},
    {"copyDiagnostics", QT_TRANSLATE_NOOP("Action", "T&ools"),
     QT_TRANSLATE_NOOP("Action", "&Copy diagnostics"), "", Do::call<copyDiagnostics>},

    panelsIn("T&ools"),
    lineIn("T&ools"),
    {"findCommand", "T&ools", QT_TRANSLATE_NOOP("Action", "&Find a command…"), "Ctrl+Shift+P",
     Do::call<findCommand>},

    {"guide", QT_TRANSLATE_NOOP("Action", "&Help"), QT_TRANSLATE_NOOP("Action", "&User guide"), "Ctrl+F1",
     Do::call<showGuide>},
    {"helpHere", "&Help", QT_TRANSLATE_NOOP("Action", "&Help on this part of the window"), "F1",
     Do::call<showHelpHere>},
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

void gather(std::span<const ActionInfo> table, std::vector<MenuEntry>& into) {
    for (const ActionInfo& info : table) {
        const std::string_view id = info.id;
        if (id == kViewportEntries) {
            gather(viewportEntries(), into);
        } else if (id != kPanelEntries) {
            into.push_back({&info, nullptr});
        }
        for (const PanelInfo& panel : id == kPanelEntries ? panelTable() : std::span<const PanelInfo>()) {
            for (const ActionInfo& action : panel.actions()) {
                if (std::string_view(action.menu).starts_with(info.menu)) {
                    into.push_back({&action, &panel});
                }
            }
        }
    }
}

template <typename Parent>
QMenu* childMenu(Parent& parent, const QString& path) {
    const QString name = path.section(u'/', -1);
    for (QAction* action : parent.actions()) {
        if (action->menu() != nullptr && action->menu()->objectName() == name) {
            return action->menu();
        }
    }
    QMenu* menu =
        parent.addMenu(QCoreApplication::translate("Action", path.toUtf8().constData()).section(u'/', -1));
    menu->setObjectName(name);
    return menu;
}

} // namespace

std::vector<MenuEntry> menuEntries() {
    std::vector<MenuEntry> entries;
    gather(fileEntries(), entries);
    gather(kActions, entries);
    return entries;
}

QMenu* menuAt(QMenuBar& bar, const QString& path) {
    QMenu* menu = childMenu(bar, path.section(u'/', 0, 0));
    for (int level = 1; level <= path.count(u'/'); ++level) {
        menu = childMenu(*menu, path.section(u'/', 0, level));
    }
    return menu;
}

Menus::Menus(MainWindow& window, QMenuBar& bar) : m_window(window), m_entries(menuEntries()) {
    std::set<QMenu*> connected;
    for (const MenuEntry& entry : m_entries) {
        QMenu* menu = menuAt(bar, QString::fromUtf8(entry.action->menu));
        if (entry.action->list != nullptr) {
            QObject::connect(menu, &QMenu::aboutToShow, &window, [this, entry, menu] { list(entry, *menu); });
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

QWidget& Menus::ownerOf(const MenuEntry& entry) const {
    return entry.panel != nullptr ? m_window.docks().panelOf(*entry.panel) : static_cast<QWidget&>(m_window);
}

QAction* Menus::makeAction(const MenuEntry& entry) {
    const ActionInfo& info = *entry.action;
    auto* action = new QAction(QCoreApplication::translate("Action", info.text), &m_window);
    action->setObjectName(QLatin1String(info.id));
    action->setShortcut(QKeySequence(QLatin1String(info.shortcut), QKeySequence::PortableText));
    action->setCheckable(info.isOn != nullptr);
    action->setMenuRole(action->objectName() == QLatin1String("preferences") ? QAction::PreferencesRole
                                                                             : action->menuRole());
    QObject::connect(action, &QAction::triggered, &m_window, [this, entry] {
        if (entry.panel != nullptr && QApplication::activeModalWidget() == nullptr) {
            m_window.docks().show(QLatin1String(entry.panel->id));
        }
        entry.action->run(ownerOf(entry));
        showStates();
    });
    // Also reachable while the menu bar is hidden.
    m_window.addAction(action);
    m_actions.insert(action->objectName(), action);
    return action;
}

void Menus::list(const MenuEntry& entry, QMenu& menu) {
    menu.clear();
    entry.action->list(ownerOf(entry), menu);
    for (QAction* action : entry.panel != nullptr ? menu.actions() : QList<QAction*>()) {
        QObject::connect(action, &QAction::triggered, &m_window,
                         [this, entry] { m_window.docks().show(QLatin1String(entry.panel->id)); });
    }
}

void Menus::showStates() {
    for (const MenuEntry& entry : m_entries) {
        if (entry.action->isOn != nullptr) {
            m_actions[QLatin1String(entry.action->id)]->setChecked(entry.action->isOn(ownerOf(entry)));
        }
    }
}

void carryOut(MainWindow& window, QAction& action) {
    if (const auto* dock = qobject_cast<QDockWidget*>(action.parent())) {
        window.docks().enter(dock->objectName());
    } else {
        action.trigger();
    }
}

} // namespace posewire::gui
