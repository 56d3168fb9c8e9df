// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/actions.h"

#include "app/gui/main_window.h"

#include <QCoreApplication>

namespace posewire::gui {

namespace {

using Window = MainWindow;

constexpr auto kCheckable = true;
constexpr int kDemoCharacters = 2;

void toggleDemo(Window& window) {
    window.driver().setDemo(window.driver().isDemoRunning() ? 0 : kDemoCharacters);
}

void togglePaused(Window& window) {
    window.driver().setPaused(!window.driver().isPaused());
}

void nextAxes(Window& window) {
    const AxesMode mode = window.viewport().axes();
    window.viewport().setAxes(mode == AxesMode::All        ? AxesMode::Selected
                              : mode == AxesMode::Selected ? AxesMode::None
                                                           : AxesMode::All);
}

void toggleGhost(Window& window) {
    window.driver().setGhostVisible(!window.driver().isGhostVisible());
}

void toggleOrthographic(Window& window) {
    const bool isPerspective = window.viewport().projection() == render::Projection::Perspective;
    window.viewport().setProjection(isPerspective ? render::Projection::Orthographic
                                                  : render::Projection::Perspective);
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
        window.driver().select({key.source, key, -1});
    }
}

constexpr ActionInfo kLine{"", "", "", "", false, nullptr};
constexpr ActionInfo lineIn(const char* menu) {
    ActionInfo line = kLine;
    line.menu = menu;
    return line;
}

const ActionInfo kActions[] = {
    {"open", QT_TRANSLATE_NOOP("Action", "&File"), QT_TRANSLATE_NOOP("Action", "&Open…"), "Ctrl+O", false,
     [](Window& w) { w.openFile(); }},
    {"saveScreenshot", "&File", QT_TRANSLATE_NOOP("Action", "&Save screenshot…"), "Ctrl+Shift+S", false,
     [](Window& w) { w.saveScreenshot(); }},
    lineIn("&File"),
    {"quit", "&File", QT_TRANSLATE_NOOP("Action", "&Quit"), "Ctrl+Q", false, [](Window& w) { w.close(); }},

    {"addUdpPort", QT_TRANSLATE_NOOP("Action", "&Source"), QT_TRANSLATE_NOOP("Action", "&Add UDP port…"),
     "Ctrl+U", false, [](Window& w) { w.addUdpPort(); }},
    {"demo", "&Source", QT_TRANSLATE_NOOP("Action", "&Demo stream"), "Ctrl+D", kCheckable, toggleDemo},

    {"resetLayout", QT_TRANSLATE_NOOP("Action", "&View"), QT_TRANSLATE_NOOP("Action", "&Reset layout"), "",
     false, [](Window& w) { w.resetLayout(); }},
    {"dockAll", "&View", QT_TRANSLATE_NOOP("Action", "&Dock all"), "", false, [](Window& w) { w.dockAll(); }},
    {"nextDock", "&View", QT_TRANSLATE_NOOP("Action", "&Next dock"), "F6", false,
     [](Window& w) { w.nextDock(); }},
    lineIn("&View"),
    {"layoutCheck", QT_TRANSLATE_NOOP("Action", "&View/&Layout"), QT_TRANSLATE_NOOP("Action", "&Check"),
     "Ctrl+1", false, [](Window& w) { w.useLayout("Check"); }},
    {"layoutDebug", "&View/&Layout", QT_TRANSLATE_NOOP("Action", "&Debug"), "Ctrl+2", false,
     [](Window& w) { w.useLayout("Debug"); }},
    {"layoutInspect", "&View/&Layout", QT_TRANSLATE_NOOP("Action", "&Inspect"), "Ctrl+3", false,
     [](Window& w) { w.useLayout("Inspect"); }},
    {"themeSystem", QT_TRANSLATE_NOOP("Action", "&View/&Theme"),
     QT_TRANSLATE_NOOP("Action", "As the &desktop"), "", kCheckable,
     [](Window& w) { w.useTheme(ThemeChoice::System); }},
    {"themeDark", "&View/&Theme", QT_TRANSLATE_NOOP("Action", "Dar&k"), "", kCheckable,
     [](Window& w) { w.useTheme(ThemeChoice::Dark); }},
    {"themeLight", "&View/&Theme", QT_TRANSLATE_NOOP("Action", "&Light"), "", kCheckable,
     [](Window& w) { w.useTheme(ThemeChoice::Light); }},
    {"viewFront", QT_TRANSLATE_NOOP("Action", "&View/&Camera"), QT_TRANSLATE_NOOP("Action", "&Front"),
     "Alt+1", false, face<render::StandardView::Front>},
    {"viewBack", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "&Back"), "Alt+2", false,
     face<render::StandardView::Back>},
    {"viewLeft", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "&Left side"), "Alt+3", false,
     face<render::StandardView::Left>},
    {"viewRight", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "&Right side"), "Alt+4", false,
     face<render::StandardView::Right>},
    {"viewTop", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "&Top"), "Alt+5", false,
     face<render::StandardView::Top>},
    {"viewThreeQuarter", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "T&hree-quarter"), "Alt+6", false,
     face<render::StandardView::ThreeQuarter>},
    lineIn("&View/&Camera"),
    {"orthographic", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "&Orthographic"), "O", kCheckable,
     toggleOrthographic},
    {"frame", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "Fr&ame all"), "F", false,
     [](Window& w) { w.viewport().frameAll(); }},
    {"axes", "&View", QT_TRANSLATE_NOOP("Action", "&Axes: all, selected, none"), "A", false, nextAxes},
    {"ghost", "&View", QT_TRANSLATE_NOOP("Action", "Null pose as &ghost"), "Shift+G", kCheckable,
     toggleGhost},
    {"select1", QT_TRANSLATE_NOOP("Action", "&View/&Select character"), QT_TRANSLATE_NOOP("Action", "First"),
     "1", false, selectCharacter<0>},
    {"select2", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Second"), "2", false,
     selectCharacter<1>},
    {"select3", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Third"), "3", false,
     selectCharacter<2>},
    {"select4", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Fourth"), "4", false,
     selectCharacter<3>},
    {"select5", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Fifth"), "5", false,
     selectCharacter<4>},
    {"select6", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Sixth"), "6", false,
     selectCharacter<5>},
    {"select7", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Seventh"), "7", false,
     selectCharacter<6>},
    {"select8", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Eighth"), "8", false,
     selectCharacter<7>},
    {"select9", "&View/&Select character", QT_TRANSLATE_NOOP("Action", "Ninth"), "9", false,
     selectCharacter<8>},
    lineIn("&View"),
    {"fullScreen", "&View", QT_TRANSLATE_NOOP("Action", "F&ull screen"), "F11", kCheckable,
     [](Window& w) { w.toggleFullScreen(); }},

    {"pause", QT_TRANSLATE_NOOP("Action", "&Time"), QT_TRANSLATE_NOOP("Action", "&Pause"), "Space",
     kCheckable, togglePaused},
    {"live", "&Time", QT_TRANSLATE_NOOP("Action", "Back to &live"), "End", false,
     [](Window& w) { w.driver().setPaused(false); }},

    {"copyDiagnostics", QT_TRANSLATE_NOOP("Action", "T&ools"),
     QT_TRANSLATE_NOOP("Action", "&Copy diagnostics"), "", false, [](Window& w) { w.copyDiagnostics(); }},

    {"shortcuts", QT_TRANSLATE_NOOP("Action", "&Help"), QT_TRANSLATE_NOOP("Action", "&Keyboard shortcuts"),
     "F1", false, [](Window& w) { w.showShortcuts(); }},
    {"reference", "&Help", QT_TRANSLATE_NOOP("Action", "&Protocol reference"), "", false,
     [](Window& w) { w.showReference(); }},
    lineIn("&Help"),
    {"about", "&Help", QT_TRANSLATE_NOOP("Action", "&About Posewire"), "", false,
     [](Window& w) { w.showAbout(); }},
};

} // namespace

std::span<const ActionInfo> actionTable() {
    return kActions;
}

} // namespace posewire::gui
