// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/null_pose_findings.h"
#include "core/model/keys.h"

namespace posewire::model {

class SessionView;

/// Of a character at the session's cursor, or of its predecessor where it has sent no scale message itself.
/// Valid until the session's next follow().
[[nodiscard]] NullPoseEvidence nullPoseEvidence(const SessionView& session, const CharacterKey& key);

} // namespace posewire::model
