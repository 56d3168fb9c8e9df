// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace posewire::filter {

/// The language of the display filter on one page, in Markdown; its field tables come from the layouts that
/// decode the datagrams.
[[nodiscard]] std::string filterReference();

} // namespace posewire::filter
