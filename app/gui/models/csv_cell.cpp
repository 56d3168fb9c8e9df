// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/csv_cell.h"

namespace posewire::gui {

QString csvCell(QString text) {
    if (!text.contains(QLatin1Char('"')) && !text.contains(QLatin1Char(',')) &&
        !text.contains(QLatin1Char('\n')) && !text.contains(QLatin1Char('\r'))) {
        return text;
    }
    text.replace(QLatin1String("\""), QLatin1String("\"\""));
    return QLatin1Char('"') + text + QLatin1Char('"');
}

} // namespace posewire::gui
