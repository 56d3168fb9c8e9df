// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/actions.h"

#include "app/gui/window/main_window.h"

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
    window.driver().setGhostVisible(!window.driver().session().isGhostShown());
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
        window.driver().select({key.sender, key, -1});
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
    {"saveReport", "&File", QT_TRANSLATE_NOOP("Action", "Save stream &report…"), "", false,
     [](Window& w) { w.saveReport(); }},
    {"exportEvents", "&File", QT_TRANSLATE_NOOP("Action", "Export &events…"), "", false,
     [](Window& w) { w.inDock("events", "exportFile"); }},
    lineIn("&File"),
    {"quit", "&File", QT_TRANSLATE_NOOP("Action", "&Quit"), "Ctrl+Q", false, [](Window& w) { w.close(); }},

    {"mark", QT_TRANSLATE_NOOP("Action", "&Edit"), QT_TRANSLATE_NOOP("Action", "&Mark packet"), "Ctrl+M",
     false, [](Window& w) { w.inDock("packets", "toggleMark"); }},
    {"comment", "&Edit", QT_TRANSLATE_NOOP("Action", "&Comment on packet…"), "Ctrl+Alt+C", false,
     [](Window& w) { w.inDock("packets", "editComment"); }},
    lineIn("&Edit"),
    {"copyRows", QT_TRANSLATE_NOOP("Action", "&Edit/Co&py packets"),
     QT_TRANSLATE_NOOP("Action", "&Rows as text"), "", false,
     [](Window& w) { w.inDock("packets", "copyRows"); }},
    {"copyCsv", "&Edit/Co&py packets", QT_TRANSLATE_NOOP("Action", "Rows as C&SV"), "", false,
     [](Window& w) { w.inDock("packets", "copyCsv"); }},
    {"copyCell", "&Edit/Co&py packets", QT_TRANSLATE_NOOP("Action", "Ce&ll"), "", false,
     [](Window& w) { w.inDock("packets", "copyCell"); }},
    lineIn("&Edit/Co&py packets"),
    {"copyBytesText", "&Edit/Co&py packets", QT_TRANSLATE_NOOP("Action", "Bytes as &hexadecimal text"),
     "Ctrl+Shift+C", false, [](Window& w) { w.inDock("packets", "copyBytesText"); }},
    {"copyBytesRaw", "&Edit/Co&py packets", QT_TRANSLATE_NOOP("Action", "Bytes as ra&w hexadecimal"), "",
     false, [](Window& w) { w.inDock("packets", "copyBytesRaw"); }},
    {"copyBytesCArray", "&Edit/Co&py packets", QT_TRANSLATE_NOOP("Action", "Bytes as C &array"), "", false,
     [](Window& w) { w.inDock("packets", "copyBytesCArray"); }},
    {"copyBytesJson", "&Edit/Co&py packets", QT_TRANSLATE_NOOP("Action", "Packets as &JSON"), "", false,
     [](Window& w) { w.inDock("packets", "copyBytesJson"); }},
    lineIn("&Edit"),
    {"filter", "&Edit", QT_TRANSLATE_NOOP("Action", "&Filter packets"), "Ctrl+L", false,
     [](Window& w) { w.inDock("packets", "focusFilter"); }},
    {"filterByCell", QT_TRANSLATE_NOOP("Action", "&Edit/&Apply cell as filter"),
     QT_TRANSLATE_NOOP("Action", "&Only this"), "Ctrl+Shift+L", false,
     [](Window& w) { w.inDock("packets", "filterByCell"); }},
    {"filterAndCell", "&Edit/&Apply cell as filter", QT_TRANSLATE_NOOP("Action", "… &and"), "", false,
     [](Window& w) { w.inDock("packets", "filterAndCell"); }},
    {"filterOrCell", "&Edit/&Apply cell as filter", QT_TRANSLATE_NOOP("Action", "… o&r"), "", false,
     [](Window& w) { w.inDock("packets", "filterOrCell"); }},
    {"filterNotCell", "&Edit/&Apply cell as filter", QT_TRANSLATE_NOOP("Action", "… and &not"), "", false,
     [](Window& w) { w.inDock("packets", "filterNotCell"); }},
    lineIn("&Edit"),
    {"find", "&Edit", QT_TRANSLATE_NOOP("Action", "Find &bytes or text…"), "Ctrl+F", false,
     [](Window& w) { w.inDock("packets", "find"); }},
    {"findNext", "&Edit", QT_TRANSLATE_NOOP("Action", "Find ne&xt"), "F3", false,
     [](Window& w) { w.inDock("packets", "findNext"); }},
    {"findPrevious", "&Edit", QT_TRANSLATE_NOOP("Action", "Find pre&vious"), "Shift+F3", false,
     [](Window& w) { w.inDock("packets", "findPrevious"); }},

    {"inputs", QT_TRANSLATE_NOOP("Action", "&Input"), QT_TRANSLATE_NOOP("Action", "&Inputs…"), "Ctrl+U",
     false, [](Window& w) { w.openInputs(InputsDialog::Page::Inputs); }},
    {"demo", "&Input", QT_TRANSLATE_NOOP("Action", "&Demo stream"), "Ctrl+D", kCheckable, toggleDemo},

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
    {"timeSinceFirst", QT_TRANSLATE_NOOP("Action", "&View/&Packet times"),
     QT_TRANSLATE_NOOP("Action", "Since the &first packet"), "", kCheckable,
     [](Window& w) { w.inDock("packets", "timeSinceFirst"); },
     [](Window& w) { return !w.ofDock("packets", "isTimeOfDay").toBool(); }},
    {"timeOfDay", "&View/&Packet times", QT_TRANSLATE_NOOP("Action", "Date and time of &day"), "", kCheckable,
     [](Window& w) { w.inDock("packets", "timeOfDay"); },
     [](Window& w) { return w.ofDock("packets", "isTimeOfDay").toBool(); }},
    {"deltaInStream", "&View/&Packet times",
     QT_TRANSLATE_NOOP("Action", "Δ to the packet before in its &stream"), "", kCheckable,
     [](Window& w) { w.inDock("packets", "deltaInStream"); },
     [](Window& w) { return !w.ofDock("packets", "isDeltaToRowAbove").toBool(); }},
    {"deltaToRowAbove", "&View/&Packet times", QT_TRANSLATE_NOOP("Action", "Δ to the row &above"), "",
     kCheckable, [](Window& w) { w.inDock("packets", "deltaToRowAbove"); },
     [](Window& w) { return w.ofDock("packets", "isDeltaToRowAbove").toBool(); }},
    lineIn("&View"),
    {"fullScreen", "&View", QT_TRANSLATE_NOOP("Action", "F&ull screen"), "F11", kCheckable,
     [](Window& w) { w.toggleFullScreen(); }},

    {"goToPacket", QT_TRANSLATE_NOOP("Action", "&Go"), QT_TRANSLATE_NOOP("Action", "&Go to packet…"), "G",
     false, [](Window& w) { w.inDock("packets", "goToPacket"); }},
    lineIn("&Go"),
    {"nextProblem", "&Go", QT_TRANSLATE_NOOP("Action", "&Next problem"), "N", false,
     [](Window& w) { w.inDock("packets", "nextProblem"); }},
    {"previousProblem", "&Go", QT_TRANSLATE_NOOP("Action", "&Previous problem"), "Shift+N", false,
     [](Window& w) { w.inDock("packets", "previousProblem"); }},
    lineIn("&Go"),
    {"nextOfStream", "&Go", QT_TRANSLATE_NOOP("Action", "Next packet of the &stream"), "Ctrl+.", false,
     [](Window& w) { w.inDock("packets", "nextOfStream"); }},
    {"previousOfStream", "&Go", QT_TRANSLATE_NOOP("Action", "Previous packet of the s&tream"), "Ctrl+,",
     false, [](Window& w) { w.inDock("packets", "previousOfStream"); }},
    lineIn("&Go"),
    {"nextMark", "&Go", QT_TRANSLATE_NOOP("Action", "Next &mark"), "Ctrl+Shift+N", false,
     [](Window& w) { w.inDock("packets", "nextMark"); }},
    {"previousMark", "&Go", QT_TRANSLATE_NOOP("Action", "Previous m&ark"), "Ctrl+Shift+B", false,
     [](Window& w) { w.inDock("packets", "previousMark"); }},
    lineIn("&Go"),
    {"firstPacket", "&Go", QT_TRANSLATE_NOOP("Action", "&First packet"), "Ctrl+Home", false,
     [](Window& w) { w.inDock("packets", "firstPacket"); }},
    {"newestPacket", "&Go", QT_TRANSLATE_NOOP("Action", "Ne&west packet, and follow"), "Ctrl+End", false,
     [](Window& w) { w.inDock("packets", "newestPacket"); }},

    {"pause", QT_TRANSLATE_NOOP("Action", "&Time"), QT_TRANSLATE_NOOP("Action", "&Pause"), "Space",
     kCheckable, togglePaused},
    {"live", "&Time", QT_TRANSLATE_NOOP("Action", "Back to &live"), "End", false,
     [](Window& w) { w.driver().setPaused(false); }},

    {"relay", QT_TRANSLATE_NOOP("Action", "T&ools"), QT_TRANSLATE_NOOP("Action", "&Relay…"), "Ctrl+R", false,
     [](Window& w) { w.openInputs(InputsDialog::Page::Relay); }},
    {"thresholds", QT_TRANSLATE_NOOP("Action", "T&ools"), QT_TRANSLATE_NOOP("Action", "&Thresholds…"),
     "Ctrl+T", false, [](Window& w) { w.editThresholds(); }},
    {"copyDiagnostics", QT_TRANSLATE_NOOP("Action", "T&ools"),
     QT_TRANSLATE_NOOP("Action", "&Copy diagnostics"), "", false, [](Window& w) { w.copyDiagnostics(); }},

    {"connectionHelp", QT_TRANSLATE_NOOP("Action", "&Help"), QT_TRANSLATE_NOOP("Action", "&Connection help"),
     "Shift+F1", false, [](Window& w) { w.openInputs(InputsDialog::Page::Help); }},
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
