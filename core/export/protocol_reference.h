// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace posewire::exporting {

/// The protocol reference in Markdown: the header and every message type with each field's offset, size,
/// unit, meaning and specification section, written from the layouts.
[[nodiscard]] std::string protocolReference();

/// What the heading `title` is linked by: lower case, words joined by hyphens, as most readers of Markdown
/// have it.
[[nodiscard]] std::string headingAnchor(std::string_view title);

} // namespace posewire::exporting
