// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/reference_body.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace posewire::exporting {

/// A skinned body in the null pose of a performer, from whoever has one: core has none. Metres, Z-up,
/// triangles counter-clockwise seen from outside.
struct BodyMesh {
    std::vector<std::array<float, 3>> positions;
    std::vector<std::array<float, 3>> normals;                     ///< of unit length, one for each position
    std::vector<std::array<std::uint8_t, 4>> segments;             ///< body segments that move it, each once
    std::vector<std::array<float, 4>> weights;                     ///< of these; sum 1
    std::vector<std::uint32_t> indices;                            ///< three for each triangle
    std::array<Eigen::Vector3d, model::kBodySegmentCount> origins; ///< of the segments that it was made for
};

/// The body of a performer with these segment origins.
using MakeBodyMesh = std::function<BodyMesh(const model::BodyOrigins&)>;

} // namespace posewire::exporting
