// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "core/model/session/session_view.h"

#include <QJsonObject>
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
    void (*run)(QWidget& owner) = nullptr;               ///< null for a line
    bool (*isOn)(const QWidget& owner) = nullptr;        ///< only where the entry can be checked
    void (*list)(QWidget& owner, QMenu& menu) = nullptr; ///< instead: fills the menu each time that it opens
};

constexpr ActionInfo lineIn(const char* menu) {
    return {"", menu, "", ""};
}

/// Entries that are listed when the menu opens.
constexpr ActionInfo listIn(const char* menu, void (*list)(QWidget& owner, QMenu& menu)) {
    return {"", menu, "", "", nullptr, nullptr, list};
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
    template <auto function>
    static void list(QWidget& owner, QMenu& menu) {
        std::invoke(function, static_cast<Owner&>(owner), menu);
    }
    /// The same with a part of the owner.
    template <auto part, auto function>
    static void listOf(QWidget& owner, QMenu& menu) {
        std::invoke(function, std::invoke(part, static_cast<Owner&>(owner)), menu);
    }
    /// Whether a member function without arguments returns `value`.
    template <auto function, auto value = true>
    static bool is(const QWidget& owner) {
        return std::invoke(function, static_cast<const Owner&>(owner)) == value;
    }
    /// The same with a part of the owner.
    template <auto part, auto function, auto value = true>
    static bool isIn(const QWidget& owner) {
        return std::invoke(function, std::invoke(part, static_cast<const Owner&>(owner))) == value;
    }
    /// Calls a function of a part with fixed arguments and returns its result.
    template <auto part, auto function, auto... arguments>
    static bool isFor(const QWidget& owner) {
        return std::invoke(function, std::invoke(part, static_cast<const Owner&>(owner)), arguments...);
    }
};

/// Adds the entries of a table that belong to the menu at the path `from`, as they are now.
void addEntries(QMenu& menu, std::span<const ActionInfo> table, const char* from, QWidget& owner);

class Panel : public QWidget {
    Q_OBJECT

public:
    Panel(model::SessionView& view, Commands& commands, QWidget* parent)
        : QWidget(parent), m_view(view), m_commands(commands) {}

    /// Entries of the window's menus that act here; a panel that has some hides this by a table of its own.
    [[nodiscard]] static std::span<const ActionInfo> actionTable() { return {}; }

    /// The view has moved; called at most once per display tick (at most ten times a second for tables), and
    /// only while visible.
    virtual void refresh() = 0;
    /// It shows something in a window of its own: then it is told as well while it is not visible itself.
    [[nodiscard]] virtual bool hasWindow() const { return false; }

    /// Shown at the right of the dock's title, such as "2 of 2 live"; empty for nothing.
    [[nodiscard]] virtual QString summary() const { return {}; }

    /// Settings of the operator that the next run restores; empty for none.
    [[nodiscard]] virtual QJsonObject state() const { return {}; }
    /// Takes such a state; ignores what it does not understand.
    virtual void restoreState(const QJsonObject& /*state*/) {}

protected:
    model::SessionView& m_view;
    Commands& m_commands;
};

} // namespace posewire::gui
