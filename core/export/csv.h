// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

namespace posewire::exporting {

/// One line of a table of comma-separated values (RFC 4180): cells in quotation marks where they need them,
/// CR LF at the end.
[[nodiscard]] std::string csvLine(std::span<const std::string> cells);

} // namespace posewire::exporting
