// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/mannequin.h"

namespace posewire::render::mannequin {

/// Builds the mannequin from its implicit surface: closed, symmetric in y to the last bit, with baked
/// occlusion and skin weights, in the order in which it is best drawn. Takes up to a second.
/// readMannequinFile returns the same of the written file.
SkinnedMesh generate(Detail detail);

} // namespace posewire::render::mannequin
