// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/action.h"
#include "app/gui/commands.h"
#include "app/gui/program_view.h"
#include "core/model/session/session_view.h"

#include <QJsonObject>
#include <QWidget>

#include <span>

namespace posewire::gui {

/// The content of one dock.
class Panel : public QWidget {
    Q_OBJECT

public:
    Panel(model::SessionView& view, Commands& commands, QWidget* parent)
        : QWidget(parent), m_view(view), m_commands(commands) {}

    /// What the menus of the window do here; a panel that has entries there hides this by a table of its own.
    [[nodiscard]] static std::span<const ActionInfo> actionTable() { return {}; }

    /// The view has moved; called at most once per display tick (at most ten times a second for tables), and
    /// only while visible.
    virtual void refresh() = 0;

    /// Shown at the right of the dock's title, such as "2 of 2 live"; empty for nothing.
    [[nodiscard]] virtual QString summary() const { return {}; }

    /// What the operator set here and wants to find again in the next run; empty for nothing.
    [[nodiscard]] virtual QJsonObject state() const { return {}; }
    /// Takes such a state; ignores what it does not understand.
    virtual void restoreState(const QJsonObject& /*state*/) {}

protected:
    model::SessionView& m_view;
    Commands& m_commands;
};

/// One row of the table of docks. To add a dock: a file pair in panels/ and a row in panels.cpp.
struct PanelInfo {
    const char* id;    ///< object name of the dock, fixed for scripts
    const char* title; ///< translated in context "Panel"
    Qt::DockWidgetArea area;
    Panel* (*make)(model::SessionView& view, Commands& commands, const ProgramView& program, QWidget* parent);
    std::span<const ActionInfo> (*actions)();
};

[[nodiscard]] std::span<const PanelInfo> panelTable();

} // namespace posewire::gui
