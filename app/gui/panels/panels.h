// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"
#include "app/gui/base/playback.h"
#include "app/gui/base/program_state.h"
#include "app/gui/driver/comparing.h"

namespace posewire::gui {

/// All of it outlives the panels. The constructor of each says what it reads and may do.
struct PanelParts {
    model::SessionView& view;
    Commands& commands;
    Playback& playback;
    Comparing& comparing;
    const ReceivingState& receiving;
    const MonitorHealth& health;
};

/// One row of the table of docks. To add a dock: a file pair in panels/ and a row in panels.cpp.
struct PanelInfo {
    const char* id;    ///< object name of the dock, fixed for scripts
    const char* title; ///< translated in context "Panel"
    Qt::DockWidgetArea area;
    Panel* (*make)(const PanelParts& parts, QWidget* parent);
    std::span<const ActionInfo> (*actions)();
};

[[nodiscard]] std::span<const PanelInfo> panelTable();

} // namespace posewire::gui
