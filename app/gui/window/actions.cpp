// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/actions.h"

#include "app/gui/window/dock_layout.h"
#include "app/gui/window/main_window.h"

#include <QCoreApplication>

#include <string_view>

namespace posewire::gui {

namespace {

using Window = MainWindow;
using Do = ActionsOf<MainWindow>;

constexpr int kDemoCharacters = 2;

bool isDemoOn(const Window& window) {
    return window.driver().isDemoRunning();
}

void toggleDemo(Window& window) {
    window.driver().setDemo(isDemoOn(window) ? 0 : kDemoCharacters);
}

bool isPaused(const Window& window) {
    return window.driver().isPaused();
}

void togglePaused(Window& window) {
    window.driver().setPaused(!isPaused(window));
}

void backToLive(Window& window) {
    window.driver().setPaused(false);
}

void nextAxes(Window& window) {
    const AxesMode mode = window.viewport().axes();
    window.viewport().setAxes(mode == AxesMode::All        ? AxesMode::Selected
                              : mode == AxesMode::Selected ? AxesMode::None
                                                           : AxesMode::All);
}

bool isGhostOn(const Window& window) {
    return window.driver().session().isGhostShown();
}

void toggleGhost(Window& window) {
    window.driver().setGhostVisible(!isGhostOn(window));
}

bool isOrthographic(const Window& window) {
    return window.viewport().projection() == render::Projection::Orthographic;
}

void toggleOrthographic(Window& window) {
    window.viewport().setProjection(isOrthographic(window) ? render::Projection::Perspective
                                                           : render::Projection::Orthographic);
}

void frameAll(Window& window) {
    window.viewport().frameAll();
}

template <std::size_t index>
void useShippedLayout(Window& window) {
    window.useLayout(layoutNames()[index]);
}

template <render::StandardView view>
void face(Window& window) {
    window.viewport().face(view);
}

template <int index>
void selectCharacter(Window& window) {
    const auto characters = window.driver().session().currentCharacters();
    if (index < static_cast<int>(characters.size())) {
        const model::CharacterKey& key = characters[index]->key;
        window.driver().select({key.sender, key, -1});
    }
}

/// Where the entries of panels go in a menu and in its submenus.
constexpr const char* kPanels = "panels"; ///< an id
constexpr ActionInfo panelsIn(const char* menu) {
    return {kPanels, menu, "", ""};
}

const ActionInfo kActions[] = {
    {"open", QT_TRANSLATE_NOOP("Action", "&File"), QT_TRANSLATE_NOOP("Action", "&Open…"), "Ctrl+O",
     Do::call<&Window::openFile>},
    {"saveScreenshot", "&File", QT_TRANSLATE_NOOP("Action", "&Save screenshot…"), "Ctrl+Shift+S",
     Do::call<&Window::saveScreenshot>},
    {"saveReport", "&File", QT_TRANSLATE_NOOP("Action", "Save stream &report…"), "",
     Do::call<&Window::saveReport>},
    panelsIn("&File"),
    lineIn("&File"),
    {"quit", "&File", QT_TRANSLATE_NOOP("Action", "&Quit"), "Ctrl+Q", Do::call<&Window::close>},

    panelsIn(QT_TRANSLATE_NOOP("Action", "&Edit")),

    {"inputs", QT_TRANSLATE_NOOP("Action", "&Input"), QT_TRANSLATE_NOOP("Action", "&Inputs…"), "Ctrl+U",
     Do::call<&Window::openInputs, InputsDialog::Page::Inputs>},
    {"demo", "&Input", QT_TRANSLATE_NOOP("Action", "&Demo stream"), "Ctrl+D", Do::call<toggleDemo>,
     Do::is<isDemoOn>},

    {"resetLayout", QT_TRANSLATE_NOOP("Action", "&View"), QT_TRANSLATE_NOOP("Action", "&Reset layout"), "",
     Do::call<&Window::resetLayout>},
    {"dockAll", "&View", QT_TRANSLATE_NOOP("Action", "&Dock all"), "", Do::call<&Window::dockAll>},
    {"nextDock", "&View", QT_TRANSLATE_NOOP("Action", "&Next dock"), "F6", Do::call<&Window::nextDock>},
    lineIn("&View"),
    {"layoutCheck", QT_TRANSLATE_NOOP("Action", "&View/&Layout"), QT_TRANSLATE_NOOP("Action", "&Check"),
     "Ctrl+1", Do::call<useShippedLayout<0>>},
    {"layoutDebug", "&View/&Layout", QT_TRANSLATE_NOOP("Action", "&Debug"), "Ctrl+2",
     Do::call<useShippedLayout<1>>},
    {"layoutInspect", "&View/&Layout", QT_TRANSLATE_NOOP("Action", "&Inspect"), "Ctrl+3",
     Do::call<useShippedLayout<2>>},
    {"themeSystem", QT_TRANSLATE_NOOP("Action", "&View/&Theme"),
     QT_TRANSLATE_NOOP("Action", "As the &desktop"), "", Do::call<&Window::useTheme, ThemeChoice::System>,
     Do::is<&Window::themeChoice, ThemeChoice::System>},
    {"themeDark", "&View/&Theme", QT_TRANSLATE_NOOP("Action", "Dar&k"), "",
     Do::call<&Window::useTheme, ThemeChoice::Dark>, Do::is<&Window::themeChoice, ThemeChoice::Dark>},
    {"themeLight", "&View/&Theme", QT_TRANSLATE_NOOP("Action", "&Light"), "",
     Do::call<&Window::useTheme, ThemeChoice::Light>, Do::is<&Window::themeChoice, ThemeChoice::Light>},
    {"viewFront", QT_TRANSLATE_NOOP("Action", "&View/&Camera"), QT_TRANSLATE_NOOP("Action", "&Front"),
     "Alt+1", Do::call<face<render::StandardView::Front>>},
    {"viewBack", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "&Back"), "Alt+2",
     Do::call<face<render::StandardView::Back>>},
    {"viewLeft", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "&Left side"), "Alt+3",
     Do::call<face<render::StandardView::Left>>},
    {"viewRight", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "&Right side"), "Alt+4",
     Do::call<face<render::StandardView::Right>>},
    {"viewTop", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "&Top"), "Alt+5",
     Do::call<face<render::StandardView::Top>>},
    {"viewThreeQuarter", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "T&hree-quarter"), "Alt+6",
     Do::call<face<render::StandardView::ThreeQuarter>>},
    lineIn("&View/&Camera"),
    {"orthographic", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "&Orthographic"), "O",
     Do::call<toggleOrthographic>, Do::is<isOrthographic>},
    {"frame", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "Fr&ame all"), "F", Do::call<frameAll>},
    {"axes", "&View", QT_TRANSLATE_NOOP("Action", "&Axes: all, selected, none"), "A", Do::call<nextAxes>},
    {"ghost", "&View", QT_TRANSLATE_NOOP("Action", "Null pose as &ghost"), "Shift+G", Do::call<toggleGhost>,
     Do::is<isGhostOn>},
    {"select1", QT_TRANSLATE_NOOP("Action", "&View/&Select character"), QT_TRANSLATE_NOOP("Action", "First"),
     "1", Do::call<selectCharacter<0>>},
    {"select2", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Second"), "2",
     Do::call<selectCharacter<1>>},
    {"select3", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Third"), "3",
     Do::call<selectCharacter<2>>},
    {"select4", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Fourth"), "4",
     Do::call<selectCharacter<3>>},
    {"select5", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Fifth"), "5",
     Do::call<selectCharacter<4>>},
    {"select6", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Sixth"), "6",
     Do::call<selectCharacter<5>>},
    {"select7", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Seventh"), "7",
     Do::call<selectCharacter<6>>},
    {"select8", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Eighth"), "8",
     Do::call<selectCharacter<7>>},
    {"select9", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Ninth"), "9",
     Do::call<selectCharacter<8>>},
    panelsIn("&View"),
    lineIn("&View"),
    {"fullScreen", "&View", QT_TRANSLATE_NOOP("Action", "F&ull screen"), "F11",
     Do::call<&Window::toggleFullScreen>, Do::is<&Window::isFullScreen>},

    panelsIn(QT_TRANSLATE_NOOP("Action", "&Go")),

    {"pause", QT_TRANSLATE_NOOP("Action", "&Time"), QT_TRANSLATE_NOOP("Action", "&Pause"), "Space",
     Do::call<togglePaused>, Do::is<isPaused>},
    {"live", "&Time", QT_TRANSLATE_NOOP("Action", "Back to &live"), "End", Do::call<backToLive>},

    {"relay", QT_TRANSLATE_NOOP("Action", "T&ools"), QT_TRANSLATE_NOOP("Action", "&Relay…"), "Ctrl+R",
     Do::call<&Window::openInputs, InputsDialog::Page::Relay>},
    {"thresholds", QT_TRANSLATE_NOOP("Action", "T&ools"), QT_TRANSLATE_NOOP("Action", "&Thresholds…"),
     "Ctrl+T", Do::call<&Window::editThresholds>},
    {"copyDiagnostics", QT_TRANSLATE_NOOP("Action", "T&ools"),
     QT_TRANSLATE_NOOP("Action", "&Copy diagnostics"), "", Do::call<&Window::copyDiagnostics>},

    panelsIn("T&ools"),

    {"connectionHelp", QT_TRANSLATE_NOOP("Action", "&Help"), QT_TRANSLATE_NOOP("Action", "&Connection help"),
     "Shift+F1", Do::call<&Window::openInputs, InputsDialog::Page::Help>},
    {"shortcuts", QT_TRANSLATE_NOOP("Action", "&Help"), QT_TRANSLATE_NOOP("Action", "&Keyboard shortcuts"),
     "F1", Do::call<&Window::showShortcuts>},
    {"reference", "&Help", QT_TRANSLATE_NOOP("Action", "&Protocol reference"), "",
     Do::call<&Window::showReference>},
    lineIn("&Help"),
    {"about", "&Help", QT_TRANSLATE_NOOP("Action", "&About Posewire"), "", Do::call<&Window::showAbout>},
};

} // namespace

std::vector<MenuEntry> menuEntries() {
    std::vector<MenuEntry> entries;
    for (const ActionInfo& info : kActions) {
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

} // namespace posewire::gui
