// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

namespace posewire::gui {

/// Processor time that all threads of this process took so far, in seconds.
[[nodiscard]] std::optional<double> processCpuSeconds();

/// Main memory that this process has now, in bytes; nothing where the system does not tell.
[[nodiscard]] std::optional<std::uint64_t> processMemoryBytes();

} // namespace posewire::gui
