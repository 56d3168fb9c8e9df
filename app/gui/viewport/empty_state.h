// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/receiving_state.h"
#include "app/gui/theme/theme.h"
#include "core/model/session/session_view.h"

#include <QString>
#include <QStringList>

namespace posewire::gui {

/// What the viewport says while there is no character to see. Nothing where `title` is empty.
struct EmptyState {
    Health level = Health::Unknown;
    QString title;
    QStringList lines;
};

[[nodiscard]] EmptyState emptyState(model::SessionView& session, const ReceivingState& receiving);

} // namespace posewire::gui
