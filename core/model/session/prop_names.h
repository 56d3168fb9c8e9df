// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/segments.h"
#include "core/model/session/session_view.h"

#include <string>

namespace posewire::model {

/// What the sender calls a prop of a character, counted from 0: in its scale message (type 13, where props
/// follow the body), else in type 11 (E 2.6). Empty where neither tells.
[[nodiscard]] std::string propName(const SessionView& session, const CharacterKey& key,
                                   const SegmentLayout& layout, int prop);

} // namespace posewire::model
