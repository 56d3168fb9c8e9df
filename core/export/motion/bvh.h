// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/motion/motion_writer.h"

#include <memory>

namespace posewire::exporting {

/// Biovision hierarchy of one character: body and fingers, without props. Y up, Z forward, centimetres,
/// degrees. Offsets are those of the null pose (see skeletonOf()); the pelvis has position and rotation, all
/// others rotation alone (Z, X, Y in this order, R = Rz·Rx·Ry): joints stand where bones of constant length
/// put them. The frame time is that of the stream, and each sample is a frame: one that did not come whole
/// repeats the pose before it, and a restart of the sender leaves no pause.
[[nodiscard]] std::unique_ptr<MotionWriter> makeBvh(const MotionTask& task);

} // namespace posewire::exporting
