// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <thread>

namespace posewire::net {

/// CPU time of a running thread so far, in seconds; empty where the system does not report it.
[[nodiscard]] std::optional<double> cpuSeconds(std::thread& thread);

} // namespace posewire::net
