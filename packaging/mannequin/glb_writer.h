// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/mesh.h"

#include <string>

namespace posewire::render::mannequin {

/// The mesh as the bytes of a binary glTF 2.0 file with a skin of kJointCount joints in the reference null
/// pose, in the layout of mannequin_file.h. Vertices stay Z-up; the root node turns them to glTF's Y-up. At
/// most 65536 vertices.
std::string glbOf(const SkinnedMesh& mesh);

} // namespace posewire::render::mannequin
