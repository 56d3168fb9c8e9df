// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/json.h"
#include "core/export/json_fields.h"

namespace posewire::exporting {

/// The bytes of the datagram that an object stands for.
[[nodiscard]] tl::expected<std::vector<std::byte>, JsonFault> datagramFromObject(const Json& object);

} // namespace posewire::exporting
