// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/session/session_view.h"

#include <utility>
#include <vector>

namespace posewire::exporting {

using CharacterPair = std::pair<model::CharacterKey, model::CharacterKey>;

/// Which character of the one session is the same as which of the other: those with the same name, then those
/// with the same ID, then the others in order. Each has one partner at most; in the order of the first.
[[nodiscard]] std::vector<CharacterPair> pairCharacters(const model::SessionView& first,
                                                        const model::SessionView& second);

} // namespace posewire::exporting
