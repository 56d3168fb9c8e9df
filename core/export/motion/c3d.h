// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/motion/motion_writer.h"

#include <memory>

namespace posewire::exporting {

/// C3D of one character (c3d.org, Intel byte order, floats): the markers of type 03 where those were sent,
/// else the origins of its segments. Millimetres, Z up. Each sample is a frame; what did not come is a point
/// without a measurement (residual -1). From 65,536 frames on their number is in TRIAL and in
/// POINT:LONG_FRAMES.
[[nodiscard]] std::unique_ptr<MotionWriter> makeC3d(const MotionTask& task);

} // namespace posewire::exporting
