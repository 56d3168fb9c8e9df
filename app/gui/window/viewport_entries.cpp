// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/menus.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "app/gui/viewport/overlays.h"
#include "app/gui/window/main_window.h"
#include "app/gui/window/own_character_dialog.h"
#include "core/model/session/roster.h"

#include <algorithm>

namespace posewire::gui {

namespace {

using Window = MainWindow;
using ViewDo = ActionsOf<MainWindow>;

ViewChoice& choiceOf(const Window& window) {
    return window.viewport().choice();
}

void nextAxes(Window& window) {
    constexpr int kModes = 3;
    choiceOf(window).setAxes(static_cast<AxesMode>((static_cast<int>(choiceOf(window).axes()) + 1) % kModes));
}

bool isGhostOn(const Window& window) {
    return window.driver().commands().session().choices().isGhostShown;
}

void toggleGhost(Window& window) {
    window.driver().commands().setGhostVisible(!isGhostOn(window));
}

bool isAnyLifted(const Window& window) {
    const model::SessionView& session = window.driver().commands().session();
    return std::ranges::any_of(session.roster().listed(), [&session](const model::Character* character) {
        return session.roster().isLifted(character->key);
    });
}

void toggleLifted(Window& window) {
    const bool isOn = !isAnyLifted(window);
    for (const model::Character* character : window.driver().commands().session().roster().listed()) {
        window.driver().commands().setLifted(character->key, isOn);
    }
}

template <int index>
void selectCharacter(Window& window) {
    const auto characters = window.driver().commands().session().roster().listed();
    if (index < static_cast<int>(characters.size())) {
        const model::CharacterKey& key = characters[index]->key;
        window.driver().commands().select({key.sender, key, -1});
    }
}

constexpr const char* kSelect = QT_TRANSLATE_NOOP("Action", "&View/&Select character");
template <render::StandardView view>
constexpr ActionInfo viewEntry(const char* id, const char* text, const char* shortcut) {
    return {id, QT_TRANSLATE_NOOP("Action", "&View/&Camera"), text, shortcut,
            ViewDo::callIn<&Window::viewport, &ViewportWidget::face, view>};
}

void editOwnCharacter(Window& window) {
    model::SessionView& session = window.driver().commands().session();
    QStringList names;
    for (const model::Character* character : session.roster().listed()) {
        names += shown(session.roster().displayName(character->key));
    }
    names.removeDuplicates();
    const std::optional<model::CharacterKey>& selected = session.choices().selection.character;
    const QString name = selected ? shown(session.roster().displayName(*selected)) : QString();
    OwnCharacterDialog(choiceOf(window).ownCharacters(), names, name, &window).exec();
}

template <int index>
void showView(Window& window) {
    if (choiceOf(window).isKept(index)) {
        choiceOf(window).showKeptView(index);
    } else {
        window.say(tr("No view %1 is kept: View > Camera > Keep view does").arg(index + 1),
                   HelpTopic::ViewNotKept);
    }
}
template <int index>
void keepView(Window& window) {
    choiceOf(window).keepView(index);
    window.say(tr("View %1 kept").arg(index + 1));
}
constexpr const char* kShowView = QT_TRANSLATE_NOOP("Action", "&View/&Camera/&Go to view");
template <int index>
constexpr ActionInfo keepViewEntry(const char* id, const char* text, const char* shortcut) {
    return {id, QT_TRANSLATE_NOOP("Action", "&View/&Camera/&Keep view"), text, shortcut,
            ViewDo::call<keepView<index>>};
}

template <auto move, auto... steps>
constexpr ActionInfo moveEntry(const char* id, const char* text, const char* shortcut) {
    return {id, QT_TRANSLATE_NOOP("Action", "&View/&Camera/&Move"), text, shortcut,
            ViewDo::callIn<choiceOf, move, steps...>};
}
constexpr auto kOrbit = &ViewChoice::orbitBy;
constexpr auto kPan = &ViewChoice::panBy;
constexpr auto kZoom = &ViewChoice::zoomBy;

template <int count>
constexpr ActionInfo splitEntry(const char* id, const char* text, const char* shortcut) {
    constexpr auto split = ViewDo::callIn<&Window::viewport, &ViewportWidget::split, count>;
    return {id,    QT_TRANSLATE_NOOP("Action", "&View/Sp&lit view"),     text, shortcut,
            split, ViewDo::isIn<choiceOf, &ViewChoice::viewCount, count>};
}

template <ViewSwitch which>
constexpr ActionInfo switchEntry(const char* id, const char* menu, const char* text) {
    constexpr auto toggle = ViewDo::callIn<choiceOf, &ViewChoice::toggleSwitch, which>;
    return {id, menu, text, "", toggle, ViewDo::isFor<choiceOf, &ViewChoice::isSwitchedOn, which>};
}

template <AxesMode mode>
constexpr ActionInfo axesEntry(const char* id, const char* text) {
    constexpr auto set = ViewDo::callIn<choiceOf, &ViewChoice::setAxes, mode>;
    return {id,  QT_TRANSLATE_NOOP("Action", "&View/&Axes"),     text, "",
            set, ViewDo::isIn<choiceOf, &ViewChoice::axes, mode>};
}

template <Overlay overlay>
constexpr ActionInfo overlayEntry() {
    constexpr const OverlayEntry& entry = kOverlayTable[static_cast<std::size_t>(overlay)];
    static_assert(entry.overlay == overlay);
    constexpr auto toggle = ViewDo::callIn<choiceOf, &ViewChoice::toggle, overlay>;
    return {entry.key, QT_TRANSLATE_NOOP("Action", "&View/O&verlays"),     entry.title, "",
            toggle,    ViewDo::isFor<choiceOf, &ViewChoice::isOn, overlay>};
}

const ActionInfo kEntries[] = {
    viewEntry<render::StandardView::Front>("viewFront", QT_TRANSLATE_NOOP("Action", "&Front"), "Alt+1"),
    viewEntry<render::StandardView::Back>("viewBack", QT_TRANSLATE_NOOP("Action", "&Back"), "Alt+2"),
    viewEntry<render::StandardView::Left>("viewLeft", QT_TRANSLATE_NOOP("Action", "&Left side"), "Alt+3"),
    viewEntry<render::StandardView::Right>("viewRight", QT_TRANSLATE_NOOP("Action", "&Right side"), "Alt+4"),
    viewEntry<render::StandardView::Top>("viewTop", QT_TRANSLATE_NOOP("Action", "&Top"), "Alt+5"),
    viewEntry<render::StandardView::ThreeQuarter>("viewThreeQuarter",
                                                  QT_TRANSLATE_NOOP("Action", "T&hree-quarter"), "Alt+6"),
    switchEntry<ViewSwitch::RelativeViews>("relativeViews", "&View/&Camera",
                                           QT_TRANSLATE_NOOP("Action", "Relative to the &pelvis")),
    lineIn("&View/&Camera"),
    {"orthographic", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "&Orthographic"), "P",
     ViewDo::callIn<choiceOf, &ViewChoice::toggleProjection>,
     ViewDo::isIn<choiceOf, &ViewChoice::projection, render::Projection::Orthographic>},
    {"frame", "&View/&Camera", QT_TRANSLATE_NOOP("Action", "Fr&ame all"), "F",
     ViewDo::callIn<&Window::viewport, &ViewportWidget::frameAll>},
    moveEntry<kOrbit, -1, 0>("orbitLeft", QT_TRANSLATE_NOOP("Action", "Orbit to the &left"),
                             "Alt+Shift+Left"),
    moveEntry<kOrbit, 1, 0>("orbitRight", QT_TRANSLATE_NOOP("Action", "Orbit to the &right"),
                            "Alt+Shift+Right"),
    moveEntry<kOrbit, 0, 1>("orbitUp", QT_TRANSLATE_NOOP("Action", "Orbit &up"), "Alt+Shift+Up"),
    moveEntry<kOrbit, 0, -1>("orbitDown", QT_TRANSLATE_NOOP("Action", "Orbit &down"), "Alt+Shift+Down"),
    moveEntry<kPan, -1, 0>("panLeft", QT_TRANSLATE_NOOP("Action", "Pan to the l&eft"), "Ctrl+Shift+Left"),
    moveEntry<kPan, 1, 0>("panRight", QT_TRANSLATE_NOOP("Action", "Pan to the ri&ght"), "Ctrl+Shift+Right"),
    moveEntry<kPan, 0, 1>("panUp", QT_TRANSLATE_NOOP("Action", "&Pan up"), "Ctrl+Shift+Up"),
    moveEntry<kPan, 0, -1>("panDown", QT_TRANSLATE_NOOP("Action", "Pa&n down"), "Ctrl+Shift+Down"),
    moveEntry<kZoom, 1>("zoomIn", QT_TRANSLATE_NOOP("Action", "&Closer"), "Z"),
    moveEntry<kZoom, -1>("zoomOut", QT_TRANSLATE_NOOP("Action", "&Farther"), "Shift+Z"),
    {"showView1", kShowView, QT_TRANSLATE_NOOP("Action", "View &1"), "Alt+7", ViewDo::call<showView<0>>},
    {"showView2", kShowView, QT_TRANSLATE_NOOP("Action", "View &2"), "Alt+8", ViewDo::call<showView<1>>},
    {"showView3", kShowView, QT_TRANSLATE_NOOP("Action", "View &3"), "Alt+9", ViewDo::call<showView<2>>},
    {"showView4", kShowView, QT_TRANSLATE_NOOP("Action", "View &4"), "Alt+0", ViewDo::call<showView<3>>},
    keepViewEntry<0>("keepView1", QT_TRANSLATE_NOOP("Action", "As view &1"), "Alt+Shift+7"),
    keepViewEntry<1>("keepView2", QT_TRANSLATE_NOOP("Action", "As view &2"), "Alt+Shift+8"),
    keepViewEntry<2>("keepView3", QT_TRANSLATE_NOOP("Action", "As view &3"), "Alt+Shift+9"),
    keepViewEntry<3>("keepView4", QT_TRANSLATE_NOOP("Action", "As view &4"), "Alt+Shift+0"),
    splitEntry<1>("splitOne", QT_TRANSLATE_NOOP("Action", "&One view"), "Ctrl+Alt+1"),
    splitEntry<2>("splitTwo", QT_TRANSLATE_NOOP("Action", "&Two side by side"), "Ctrl+Alt+2"),
    splitEntry<4>("splitFour", QT_TRANSLATE_NOOP("Action", "&Four views"), "Ctrl+Alt+4"),
    {"nextView", "&View/Sp&lit view", QT_TRANSLATE_NOOP("Action", "&Next view"), "Ctrl+Alt+N",
     ViewDo::callIn<choiceOf, &ViewChoice::activateNext>},
    axesEntry<AxesMode::All>("axesOfAll", QT_TRANSLATE_NOOP("Action", "&All segments")),
    axesEntry<AxesMode::Selected>("axesOfSelected", QT_TRANSLATE_NOOP("Action", "&Selected character")),
    axesEntry<AxesMode::None>("axesOfNone", QT_TRANSLATE_NOOP("Action", "&None")),
    {"axes", "&View/&Axes", QT_TRANSLATE_NOOP("Action", "Ne&xt of these"), "A", ViewDo::call<nextAxes>},
    overlayEntry<Overlay::SegmentNames>(),
    overlayEntry<Overlay::JointAngles>(),
    overlayEntry<Overlay::Markers>(),
    overlayEntry<Overlay::Trackers>(),
    overlayEntry<Overlay::CentreOfMass>(),
    overlayEntry<Overlay::Contacts>(),
    overlayEntry<Overlay::Velocity>(),
    overlayEntry<Overlay::Acceleration>(),
    overlayEntry<Overlay::Trails>(),
    switchEntry<ViewSwitch::Scale>("scale", "&View/O&verlays",
                                   QT_TRANSLATE_NOOP("Action", "Metres on the f&loor")),
    switchEntry<ViewSwitch::Card>("segmentCard", "&View/O&verlays",
                                  QT_TRANSLATE_NOOP("Action", "Val&ues of a segment")),
    {"ownCharacter", "&View", QT_TRANSLATE_NOOP("Action", "O&wn character…"), "",
     ViewDo::call<editOwnCharacter>},
    switchEntry<ViewSwitch::Interpolation>("interpolation", "&View",
                                           QT_TRANSLATE_NOOP("Action", "Interpolate between sa&mples")),
    {"lift", "&View", QT_TRANSLATE_NOOP("Action", "Place bodies &below the floor on it"), "",
     ViewDo::call<toggleLifted>, ViewDo::is<isAnyLifted>},
    {"ghost", "&View", QT_TRANSLATE_NOOP("Action", "Null pose as &ghost"), "Shift+G",
     ViewDo::call<toggleGhost>, ViewDo::is<isGhostOn>},
    {"select1", kSelect, QT_TRANSLATE_NOOP("Action", "First"), "1", ViewDo::call<selectCharacter<0>>},
    {"select2", kSelect, QT_TRANSLATE_NOOP("Action", "Second"), "2", ViewDo::call<selectCharacter<1>>},
    {"select3", kSelect, QT_TRANSLATE_NOOP("Action", "Third"), "3", ViewDo::call<selectCharacter<2>>},
    {"select4", kSelect, QT_TRANSLATE_NOOP("Action", "Fourth"), "4", ViewDo::call<selectCharacter<3>>},
    {"select5", kSelect, QT_TRANSLATE_NOOP("Action", "Fifth"), "5", ViewDo::call<selectCharacter<4>>},
    {"select6", kSelect, QT_TRANSLATE_NOOP("Action", "Sixth"), "6", ViewDo::call<selectCharacter<5>>},
    {"select7", kSelect, QT_TRANSLATE_NOOP("Action", "Seventh"), "7", ViewDo::call<selectCharacter<6>>},
    {"select8", kSelect, QT_TRANSLATE_NOOP("Action", "Eighth"), "8", ViewDo::call<selectCharacter<7>>},
    {"select9", kSelect, QT_TRANSLATE_NOOP("Action", "Ninth"), "9", ViewDo::call<selectCharacter<8>>},
};

} // namespace

std::span<const ActionInfo> viewportEntries() {
    return kEntries;
}

} // namespace posewire::gui
