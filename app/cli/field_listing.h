// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/wire/types.h"

#include <string>

namespace posewire::cli {

/// Every field of a datagram with its offset, value and unit, one per line, then notices and errors.
[[nodiscard]] std::string fieldListing(wire::Bytes bytes);

} // namespace posewire::cli
