// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/provenance.h"

#include <string>

namespace posewire::model {

/// Where a segment's pose comes from, in a few words: "Sent", "Position sent, orientation solved, turn about
/// itself assumed".
[[nodiscard]] std::string sourceText(const SegmentSource& source);

} // namespace posewire::model
