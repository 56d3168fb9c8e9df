// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace posewire::filter {

/// Seconds since 1970 of "2026-01-31", "2026-01-31T12:00", "2026-01-31 12:00:00.25Z"; empty for other
/// texts.
[[nodiscard]] std::optional<double> utcSeconds(std::string_view text);

} // namespace posewire::filter
