// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace posewire::filter {

/// The language of the display filter on one page, in Markdown; the tables of fields are written from those
/// that decode the datagrams.
[[nodiscard]] std::string filterReference();

} // namespace posewire::filter
