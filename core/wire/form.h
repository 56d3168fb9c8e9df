// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/field.h"
#include "core/wire/header.h"

namespace posewire::wire {

/// Which of its layouts the payload of a datagram is in. The specification and real senders differ for types
/// 04, 12, 23, 24 and 25; sizes and the first bytes decide. `payload` ends where the datagram (or, if that is
/// shorter, the announced payload) ends. Never fails: what fits no form is reported when it is read.
[[nodiscard]] Form formOf(const Header& header, Bytes payload);

/// Bytes of `payload` that belong to the datagram by its header: all where the payload size is left out. At
/// least one sender counts 12 bytes of a time code and sends the four bytes of its length before them too.
[[nodiscard]] std::size_t sentPayload(const Header& header, Bytes payload);

} // namespace posewire::wire
