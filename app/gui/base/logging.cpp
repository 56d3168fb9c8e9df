// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/logging.h"

namespace posewire::gui {

Q_LOGGING_CATEGORY(inputsLog, "posewire.inputs", QtWarningMsg)
Q_LOGGING_CATEGORY(filesLog, "posewire.files", QtWarningMsg)
Q_LOGGING_CATEGORY(settingsLog, "posewire.settings", QtWarningMsg)
Q_LOGGING_CATEGORY(drawingLog, "posewire.drawing", QtWarningMsg)

void tellVerbosely() {
    qSetMessagePattern(QStringLiteral("%{time hh:mm:ss.zzz} %{category}: %{message}"));
    QLoggingCategory::setFilterRules(QStringLiteral("posewire.*.info=true"));
}

} // namespace posewire::gui
