// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <thread>

namespace posewire::system {

/// Processor time that all threads of this process took so far, in seconds.
[[nodiscard]] std::optional<double> processCpuSeconds();

/// CPU time of a running thread; empty if the system does not report it.
[[nodiscard]] std::optional<double> threadCpuSeconds(std::thread& thread);

/// Main memory that this process has now, in bytes; nothing if the system does not report it.
[[nodiscard]] std::optional<std::uint64_t> processMemoryBytes();

/// Milliseconds since the operating system started this process; where that is not known, since the
/// program's static objects were made. Good to 10 ms.
[[nodiscard]] double processAgeMs();

/// For a thread that takes all the processor it is given: the others go first. The threads that it starts
/// inherit this, where the system knows that.
void yieldToOthers();

} // namespace posewire::system
