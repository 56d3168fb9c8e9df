// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_io.h"
#include "core/wire/types.h"
#include "core/words/fact.h"

#include <string>
#include <string_view>

namespace posewire::model {

/// What a datagram or a file that is not MXTP looks like by its first bytes, at most log::kLookedAt of them;
/// nothing if they resemble no format that is known. Only a hint: most of these begin with few fixed bytes.
[[nodiscard]] words::Fact looksLike(wire::Bytes head);

/// What a file holds instead of MXTP, or besides little of it, and what to do, as it follows the file's name;
/// empty if most of it is MXTP.
[[nodiscard]] std::string otherContents(const log::FileContents& contents, std::string_view name);

} // namespace posewire::model
