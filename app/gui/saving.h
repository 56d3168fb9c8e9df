// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArrayView>
#include <QString>

namespace posewire::gui {

/// Writes a file whole or not at all: what was there stays until all is written. The answer is what went
/// wrong as a sentence for the operator, empty for nothing.
[[nodiscard]] QString saveFile(const QString& path, QByteArrayView content);

} // namespace posewire::gui
