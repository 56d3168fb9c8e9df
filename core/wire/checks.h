// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/codec.h"

namespace posewire::wire {

/// Appends a notice for whatever is odd in the values of a datagram that has been read from `bytes`.
void checkValues(Bytes bytes, Datagram& datagram);

} // namespace posewire::wire
