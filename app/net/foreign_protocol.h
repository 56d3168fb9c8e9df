// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace posewire::net {

/// What the first bytes of a foreign datagram look like, in words an operator knows: "OSC",
/// "NatNet (OptiTrack Motive)". Empty if they resemble nothing known. Only a guess: these protocols begin
/// with few fixed bytes.
[[nodiscard]] std::string protocolThatBegins(std::span<const std::byte> bytes);

/// "4d 58 54 50  MXTP", at most 16 bytes, with dots for unprintable ones.
[[nodiscard]] std::string shownBytes(std::span<const std::byte> bytes);

} // namespace posewire::net
