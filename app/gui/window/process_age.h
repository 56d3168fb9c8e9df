// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace posewire::gui {

/// Milliseconds since the operating system started this process; where that cannot be learnt, since the
/// program's static objects were made. Good to 10 ms.
[[nodiscard]] double processAgeMs();

} // namespace posewire::gui
