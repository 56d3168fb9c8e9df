// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <thread>

namespace posewire::net {

/// Processor time that a running thread took so far, in seconds; nothing where the system does not tell.
[[nodiscard]] std::optional<double> cpuSeconds(std::thread& thread);

} // namespace posewire::net
