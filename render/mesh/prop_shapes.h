// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/mesh.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace posewire::render {

/// What a prop looks like.
enum class PropShape : std::uint8_t { Generic, Sword, GolfClub, Stick, Racket, Gun, Ball, Box };
inline constexpr std::size_t kPropShapeCount = 8;

/// By what a prop is called, in any case: "Golfclub", "katana 2". Generic where the name says nothing.
PropShape propShapeOf(std::string_view name);

/// A mesh of one joint, metres: the hand is at the origin, and the prop goes along x, as the prop's own axes
/// are drawn. Its size is that of a common one, since senders tell none.
SkinnedMesh propMesh(PropShape shape);

} // namespace posewire::render
