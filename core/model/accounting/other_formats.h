// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_io.h"
#include "core/wire/types.h"
#include "core/words/fact.h"

#include <string>
#include <string_view>

namespace posewire::model {

/// Guesses the format of a datagram or a file that is not MXTP by its first bytes, at most log::kLookedAt of
/// them; returns an empty fact for formats that are not known. Most of these begin with few fixed bytes.
[[nodiscard]] words::Fact looksLike(wire::Bytes head);

/// Explains a file that holds little or no MXTP, with advice, as it follows the file's name; empty if most of
/// it is MXTP.
[[nodiscard]] std::string otherContents(const log::FileContents& contents, std::string_view name);

} // namespace posewire::model
