// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/export/motion/motion_writer.h"

namespace posewire::figure {

/// The mannequin fitted to a performer, as exports take it: see exporting::MakeBodyMesh. Joints between
/// segments keep its form in programs that blend matrices.
[[nodiscard]] exporting::BodyMesh mannequinBody(const exporting::SegmentPlaces& performer);

} // namespace posewire::figure
