// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"
#include "core/model/session/session_view.h"

#include <QString>

namespace posewire::gui {

/// How one character does, in one look: the session's judgement, with the rate where it is good.
struct CharacterHealth {
    Health level = Health::Unknown;
    QString words; ///< "240 Hz", "3 lost · network", "stale 3.2 s"
    double ageSeconds = 0;
};

[[nodiscard]] CharacterHealth characterHealth(model::SessionView& session, const model::CharacterKey& key);

/// Age of what is shown of a character: of its newest pose, or of any message where it sends no poses.
[[nodiscard]] double shownAgeSeconds(model::SessionView& session, const model::CharacterKey& key);

} // namespace posewire::gui
