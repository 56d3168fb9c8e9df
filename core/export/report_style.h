// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace posewire::exporting {

/// The style sheet of reports, without the element around it.
[[nodiscard]] std::string_view reportStyle();

} // namespace posewire::exporting
