// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// Rights that a program gives up before it opens a foreign file. One unit for each duty and system.
namespace posewire::render {

/// At most 1 GB of memory, 10 s of the processor and 30 s in all; no core dump, no file written, no process
/// begun. Out of time it writes `outOfTime` to standard output and ends with status 2, if the system lets it.
void limitThisProcess(const char* outOfTime);

/// From here on files can only be opened to be read and below `folder`, and the network and other processes
/// are out of reach. Returns the means that the system has for that, such as "Landlock 4, seccomp"; "none" if
/// it has none.
[[nodiscard]] std::string confineTo(const std::string& folder);

} // namespace posewire::render
