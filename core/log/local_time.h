// SPDX-License-Identifier: MIT
#pragma once

#include <ctime>

namespace posewire::log {

/// What the clocks of this place show at a time; from any thread.
[[nodiscard]] std::tm localTime(std::time_t time);

} // namespace posewire::log
