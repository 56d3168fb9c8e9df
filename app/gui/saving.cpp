// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/saving.h"

#include "app/gui/theme/words.h"

#include <QSaveFile>

namespace posewire::gui {

QString saveFile(const QString& path, QByteArrayView content) {
    QSaveFile file(path);
    const bool isWritten = file.open(QIODevice::WriteOnly) &&
                           file.write(content.data(), content.size()) == content.size() && file.commit();
    return isWritten ? QString() : tr("%1 could not be written: %2").arg(path, file.errorString());
}

} // namespace posewire::gui
