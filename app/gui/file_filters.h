// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/export/formats.h"

#include <QCoreApplication>
#include <QStringList>

namespace posewire::gui {

/// A format for QFileDialog: "JSON (*.json)".
template <class Subject>
[[nodiscard]] QString fileFilter(const exporting::Format<Subject>& format) {
    return QStringLiteral("%1 (*.%2)")
        .arg(QCoreApplication::translate("Formats", format.kind), QLatin1String(format.suffix));
}

/// All formats of a subject for QFileDialog, the usual one first.
template <class Subject>
[[nodiscard]] QString fileFilters() {
    QStringList filters;
    for (const exporting::Format<Subject>& format : exporting::formats<Subject>()) {
        filters += fileFilter(format);
    }
    return filters.join(QStringLiteral(";;"));
}

} // namespace posewire::gui
