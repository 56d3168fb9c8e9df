// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/program_state.h"
#include "core/model/session/session_view.h"

#include <QString>

namespace posewire::gui {

/// What someone who helps from afar wants to know, as plain text: program, system, ports, senders, streams.
[[nodiscard]] QString diagnosticsText(model::SessionView& session, const ReceivingState& receiving,
                                      const QString& rendererName);

} // namespace posewire::gui
