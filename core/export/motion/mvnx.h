// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/motion/motion_writer.h"

#include <memory>

namespace posewire::exporting {

/// MVNX, version 4, of one character: XML in the order of the vendor's own files. Metres, Z up, quaternions w
/// x y z. It has what was sent or follows from it: the 23 segments of the body with the points of the null
/// pose, the joints, the null pose as the frame `tpose` (where one was sent), and of each sample orientation,
/// position and joint angles (degrees). Sensors, velocities, contacts, props and fingers are not in it: their
/// elements are empty or missing, and a comment says so. A sample that did not come whole has no frame;
/// `index` counts it.
[[nodiscard]] std::unique_ptr<MotionWriter> makeMvnx(const MotionTask& task);

} // namespace posewire::exporting
