// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/mesh.h"

namespace posewire::render {

/// How fine the built-in mannequin is.
enum class Detail {
    Low,    ///< For shadows, and for bodies that are small in the picture.
    Medium, ///< For software OpenGL.
    High    ///< For graphics processors.
};

/// The built-in mannequin in the reference null pose (kReferenceNullPose), with the joints of joints.h.
/// Read from bytes inside the library: no file is needed and it cannot fail.
SkinnedMesh loadMannequin(Detail detail);

} // namespace posewire::render
