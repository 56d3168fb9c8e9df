// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/columns.h"

namespace posewire::gui {

QVariant columnHeader(std::span<const ColumnText> columns, const char* context, int section, int role) {
    if (section < 0 || static_cast<std::size_t>(section) >= columns.size()) {
        return {};
    }
    const ColumnText& column = columns[static_cast<std::size_t>(section)];
    switch (role) {
    case Qt::DisplayRole:
        return QCoreApplication::translate(context, column.title);
    case Qt::ToolTipRole:
        return column.toolTip[0] == '\0' ? QVariant() : QCoreApplication::translate(context, column.toolTip);
    case Qt::TextAlignmentRole:
        return column.isNumber ? numberAlignment() : QVariant();
    default:
        return {};
    }
}

} // namespace posewire::gui
