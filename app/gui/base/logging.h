// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QLoggingCategory>

namespace posewire::gui {

/// --verbose prints these on standard error. Without it QT_LOGGING_RULES can enable some of them, such as
/// "posewire.inputs.info=true". What a sender wrote is never told.
Q_DECLARE_LOGGING_CATEGORY(inputsLog)   // posewire.inputs: ports, connections, who is listened to
Q_DECLARE_LOGGING_CATEGORY(filesLog)    // posewire.files: files opened, takes, the history on disk
Q_DECLARE_LOGGING_CATEGORY(settingsLog) // posewire.settings
Q_DECLARE_LOGGING_CATEGORY(drawingLog)  // posewire.drawing: who draws, and why not

/// Tells all of them, each line with its time and category.
void tellVerbosely();

} // namespace posewire::gui
