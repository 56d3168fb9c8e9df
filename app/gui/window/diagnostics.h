// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/program_state.h"
#include "core/model/session/session_view.h"

#include <QString>

namespace posewire::gui {

/// Plain text for support: program, system, ports, senders and streams.
[[nodiscard]] QString diagnosticsText(model::SessionView& session, const ReceivingState& receiving,
                                      const QString& rendererName);

} // namespace posewire::gui
