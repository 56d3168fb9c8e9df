// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace posewire::exporting {

/// The last part of the protocol reference in Markdown: what the identifiers stand for. Segments in both
/// orders, fingers, points and joints, from the tables of core/model/body.
[[nodiscard]] std::string referenceTables();

} // namespace posewire::exporting
