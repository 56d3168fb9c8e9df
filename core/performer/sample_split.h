// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/codec.h"

#include <cstddef>
#include <span>
#include <vector>

namespace posewire::performer {

/// One sample in several datagrams (§2.4.1.3): its items are divided evenly, in their order, among `parts` or
/// as many as there are items. One datagram unchanged where it cannot be divided: types that do not count
/// frames or have no list, single items, what is in parts already, what cannot be decoded.
std::vector<std::vector<std::byte>> splitSample(std::span<const std::byte> datagram, std::size_t parts);

} // namespace posewire::performer
