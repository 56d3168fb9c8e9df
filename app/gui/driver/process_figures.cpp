// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/process_figures.h"

#include <ctime>

#ifdef __linux__
#include <fstream>

#include <unistd.h>
#endif

namespace posewire::gui {

std::optional<double> processCpuSeconds() {
#ifdef CLOCK_PROCESS_CPUTIME_ID
    timespec time{};
    if (::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time) == 0) {
        return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
    }
#endif
    const std::clock_t ticks = std::clock();
    return ticks == static_cast<std::clock_t>(-1)
               ? std::nullopt
               : std::optional(static_cast<double>(ticks) / CLOCKS_PER_SEC);
}

std::optional<std::uint64_t> processMemoryBytes() {
#ifdef __linux__
    std::ifstream file("/proc/self/statm"); // proc(5): size and resident, in pages
    std::uint64_t size = 0;
    std::uint64_t resident = 0;
    if (file >> size >> resident) {
        return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    }
#endif
    return std::nullopt;
}

} // namespace posewire::gui
