// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/help_topics.h"
#include "app/gui/base/program_state.h"
#include "app/gui/models/column.h"
#include "app/gui/theme/theme.h"
#include "core/model/session/session_view.h"

#include <QString>
#include <QStringList>

namespace posewire::gui {

/// How one character does, in one look: "240 Hz", "3 lost · network", "stale 3.2 s". The session's judgement,
/// with the rate where it is good.
[[nodiscard]] PropertyValue characterHealth(model::SessionView& session, const model::CharacterKey& key);

/// Age of what is shown of a character: of its newest pose, or of any message where it sends no poses.
[[nodiscard]] double shownAgeSeconds(model::SessionView& session, const model::CharacterKey& key);

/// Nothing if `title` is empty.
struct EmptyState {
    Health level = Health::Unknown;
    QString title;
    QStringList lines;
    HelpTopic topic = HelpTopic::NothingArrives;
};

/// `file` is the name of the file that the session is of; empty if it is received.
[[nodiscard]] EmptyState emptyState(model::SessionView& session, const ReceivingState& receiving,
                                    const QString& file = {});

} // namespace posewire::gui
