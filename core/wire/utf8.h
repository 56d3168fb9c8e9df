// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace posewire::wire {

/// Index of the first byte that is not part of a well-formed UTF-8 sequence (RFC 3629: no overlong forms, no
/// surrogates, nothing above U+10FFFF); text.size() where all is well.
[[nodiscard]] std::size_t firstInvalidUtf8(std::string_view text);

} // namespace posewire::wire
