// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/program_state.h"
#include "core/model/session/session_view.h"

#include <QMap>
#include <QString>

class QWidget;

/// Texts that the program itself writes.
namespace posewire::gui {

/// The parts of the user guide that come from tables of the program, in Markdown, by their names: the keys of
/// the menus, the figures of streams, the protocol.
[[nodiscard]] QMap<QString, QString> madeHelpParts();
void showAbout(QWidget& parent);

/// What someone who helps from afar wants to know, as plain text: program, system, ports, senders, streams.
[[nodiscard]] QString diagnosticsText(model::SessionView& session, const ReceivingState& receiving,
                                      const QString& rendererName);

} // namespace posewire::gui
