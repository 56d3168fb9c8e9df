// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace posewire::net {

/// What the first bytes of something that is not MXTP look like, in words an operator knows: "OSC",
/// "NatNet (OptiTrack Motive)". Empty where they look like nothing known. A guess: these protocols have few
/// bytes that are sure.
[[nodiscard]] std::string protocolThatBegins(std::span<const std::byte> bytes);

/// "4d 58 54 50  MXTP", at most 16 bytes, with dots for what cannot be read.
[[nodiscard]] std::string shownBytes(std::span<const std::byte> bytes);

} // namespace posewire::net
