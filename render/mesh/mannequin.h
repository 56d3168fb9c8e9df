// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/mesh.h"

namespace posewire::render {

/// How fine the built-in mannequin is.
enum class Detail {
    Low,    ///< For software OpenGL.
    Medium, ///< For many characters.
    High    ///< For a close look.
};

/// The built-in mannequin in the reference null pose (kReferenceNullPose), with the joints of joints.h.
/// Read from bytes inside the library: no file is needed and it cannot fail.
SkinnedMesh loadMannequin(Detail detail);

} // namespace posewire::render
