// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/clock_history.h"
#include "app/gui/models/property_model.h"

namespace posewire::gui {

/// Which clock of the sender the large figures show.
enum class ClockChoice { Header, Type25 };

/// "00:10:39.175", or dashes where there is none.
[[nodiscard]] QString clockText(const ClockHistory& clock, ClockChoice choice);

/// Both clocks side by side, their offset, drift, frame rate, last jump.
[[nodiscard]] std::vector<Property> clockFacts(const ClockHistory& clock);

} // namespace posewire::gui
