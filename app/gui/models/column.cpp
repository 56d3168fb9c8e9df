// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/column.h"

namespace posewire::gui {

QVariant numberAlignment() {
    return int{Qt::AlignRight | Qt::AlignVCenter};
}

QVariant headerCell(const QString& title, const QString& help, bool isNumber, int role) {
    switch (role) {
    case Qt::DisplayRole:
        return title;
    case Qt::ToolTipRole:
        return help.isEmpty() ? QVariant() : help;
    case Qt::TextAlignmentRole:
        return isNumber ? numberAlignment() : QVariant();
    default:
        return {};
    }
}

QString cellText(const QModelIndex& index) {
    const QString text = index.data(Qt::DisplayRole).toString();
    const QString suffix = index.data(kSuffixRole).toString();
    return suffix.isEmpty() ? text : text + QLatin1Char(' ') + suffix;
}

} // namespace posewire::gui
