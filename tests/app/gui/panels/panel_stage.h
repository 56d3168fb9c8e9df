// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/panels/panels.h"
#include "tests/app/gui/models/stage.h"

#include <QClipboard>
#include <QGuiApplication>

namespace posewire::gui {

inline QString copiedText() {
    return QGuiApplication::clipboard()->text();
}

/// With all that panels are made of. Receives nothing.
struct PanelStage : Stage {
    Comparing comparing{commands, clock, {}};
    ReceivingState receiving;
    MonitorHealth health;
    PanelParts parts{session, commands, playback, comparing, receiving, health};
};

} // namespace posewire::gui
