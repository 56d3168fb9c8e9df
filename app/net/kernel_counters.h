// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/kernel_counters.h"

#include <optional>
#include <string>

namespace posewire::net {

/// Since the computer was started; nothing if the system does not show them in files, as only Linux does.
/// `root` is for tests.
[[nodiscard]] std::optional<log::KernelCounters> readKernelCounters(const std::string& root = "/");

} // namespace posewire::net
