// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/codec.h"

#include <string>

namespace posewire::wire::test {

/// What the golden of that name says, with the notices it deserves, written down from the comments in its
/// file and not from its bytes.
[[nodiscard]] Datagram expectedDatagram(const std::string& name);

} // namespace posewire::wire::test
