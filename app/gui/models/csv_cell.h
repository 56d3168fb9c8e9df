// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

namespace posewire::gui {

/// As one cell of a comma-separated line: in quotation marks where it needs them (RFC 4180).
[[nodiscard]] QString csvCell(QString text);

} // namespace posewire::gui
