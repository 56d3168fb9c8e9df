// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include <functional>
#include <span>

class QMenu;

namespace posewire::gui {

/// One entry of a menu. The window and each panel own a table of the entries that they carry out.
struct ActionInfo {
    const char* id;       ///< object name, fixed for scripts; empty for a line between entries
    const char* menu;     ///< "&File", "&View/&Theme"; translated in context "Action", as `text`
    const char* text;     ///< with the letter to press after &
    const char* shortcut; ///< portable text, empty for none
    void (*run)(QWidget& owner) = nullptr;        ///< null for a line
    bool (*isOn)(const QWidget& owner) = nullptr; ///< only where the entry can be checked
};

/// A line between the entries of a menu.
constexpr ActionInfo lineIn(const char* menu) {
    return {"", menu, "", ""};
}

/// Makes functions for a table from members of its owner, with fixed arguments. A member that Owner does not
/// have fails to compile; so does one that takes other arguments.
template <class Owner>
struct ActionsOf {
    /// Calls a member function of the owner, or a free function that takes the owner first.
    template <auto function, auto... arguments>
    static void call(QWidget& owner) {
        std::invoke(function, static_cast<Owner&>(owner), arguments...);
    }
    /// The same with a part of the owner: a data member, or a member function that returns the part.
    template <auto part, auto function, auto... arguments>
    static void callIn(QWidget& owner) {
        std::invoke(function, std::invoke(part, static_cast<Owner&>(owner)), arguments...);
    }
    /// Whether a member function without arguments returns `value`.
    template <auto function, auto value = true>
    static bool is(const QWidget& owner) {
        return std::invoke(function, static_cast<const Owner&>(owner)) == value;
    }
};

/// Adds the entries of a table that belong to the menu at the path `from`, as they are now.
void addEntries(QMenu& menu, std::span<const ActionInfo> table, const char* from, QWidget& owner);

} // namespace posewire::gui
