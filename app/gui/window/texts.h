// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/program_view.h"
#include "core/model/session/session_view.h"

#include <QString>

class QTextDocument;
class QWidget;

namespace posewire::gui {

/// Gives Markdown's tables, which come with raised white borders, the look of the theme.
void styleTables(QTextDocument& document);

/// All keys of the menus, in a window that deletes itself when closed.
void showShortcuts(QWidget& parent);
void showAbout(QWidget& parent);

/// What someone who helps from afar wants to know, as plain text: program, system, ports, senders, streams.
[[nodiscard]] QString diagnosticsText(model::SessionView& session, const ReceivingState& receiving,
                                      const QString& rendererName);

} // namespace posewire::gui
