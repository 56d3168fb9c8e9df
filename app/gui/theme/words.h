// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QCoreApplication>
#include <QString>

namespace posewire::gui {

/// A text of the window in the operator's language, for functions that belong to no QObject. Include this in
/// implementations only.
[[nodiscard]] inline QString tr(const char* text) {
    return QCoreApplication::translate("posewire::gui", text);
}

} // namespace posewire::gui
