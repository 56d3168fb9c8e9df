// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/export/motion/motion_writer.h"

namespace posewire::figure {

/// The mannequin fitted to a performer, as exports take it: what twist joints move is moved by their segments
/// here, which other programs know.
[[nodiscard]] exporting::BodyMesh mannequinBody(const model::BodyOrigins& performer);

} // namespace posewire::figure
