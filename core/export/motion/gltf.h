// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/motion/motion_writer.h"

#include <memory>

namespace posewire::exporting {

/// Binary glTF 2.0: each character a node with its segments as joints, and a skinned body where the task has
/// one; one animation moves all. Metres, Y up, Z forward. Joints have position and rotation, so that each
/// stands exactly where its segment was sent. Keys are at the samples' times (MotionFrame::seconds): a sample
/// that did not come whole has none, so players go on evenly from the one before to the next.
[[nodiscard]] std::unique_ptr<MotionWriter> makeGlb(const MotionTask& task);

} // namespace posewire::exporting
