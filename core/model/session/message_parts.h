// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/codec.h"

namespace posewire::model {

/// Appends the items of the next datagram of the same sample (§2.4.1.3). Both must be of one type; types
/// without a list of items keep what is there.
void appendPart(wire::Datagram& whole, const wire::Datagram& part);

} // namespace posewire::model
