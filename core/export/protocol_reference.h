// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace posewire::exporting {

/// The protocol reference in Markdown: the header and every message type with each field's offset, size,
/// unit, meaning and specification section, written from the layouts.
[[nodiscard]] std::string protocolReference();

} // namespace posewire::exporting
