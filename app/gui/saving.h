// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/export/formats.h"

#include <QByteArrayView>
#include <QCoreApplication>
#include <QStringList>

namespace posewire::gui {

/// Writes a file whole or not at all: what was there stays until all is written. Returns what went wrong as a
/// sentence for the operator, empty for nothing.
[[nodiscard]] QString saveFile(const QString& path, QByteArrayView content);

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
