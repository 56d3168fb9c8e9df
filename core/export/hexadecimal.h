// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/types.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::exporting {

/// Two small letters or digits a byte, nothing between them.
[[nodiscard]] std::string hexadecimal(wire::Bytes bytes);

/// The inverse; capitals are accepted. Empty where there is anything but whole bytes.
[[nodiscard]] std::optional<std::vector<std::byte>> fromHexadecimal(std::string_view text);

} // namespace posewire::exporting
