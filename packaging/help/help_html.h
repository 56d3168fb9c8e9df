// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/help/help_pages.h"

namespace posewire::gui {

/// One page of the guide as a whole HTML document, with the contents of the guide and a search beside it.
[[nodiscard]] QString helpHtml(const HelpPages& pages, const HelpPage& page);

/// What the search in the pages looks through: a script that sets `guide` to titles and texts.
[[nodiscard]] QString searchIndex(const HelpPages& pages);

} // namespace posewire::gui
