// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/process_age.h"

#include <chrono>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

#ifdef __linux__
#include <ctime>
#include <unistd.h>
#endif

namespace posewire::gui {

namespace {

const std::chrono::steady_clock::time_point kLoaded = std::chrono::steady_clock::now();

#ifdef __linux__
/// Field 22 of /proc/self/stat: clock ticks between the start of the system and that of the process
/// (proc(5)).
std::optional<double> startTicks() {
    std::ifstream file("/proc/self/stat");
    std::string line;
    std::getline(file, line);
    const std::size_t name = line.rfind(')');
    if (name == std::string::npos) {
        return std::nullopt;
    }
    std::istringstream fields(line.substr(name + 1));
    std::string field;
    constexpr int kFieldsAfterName = 20;
    for (int i = 0; i < kFieldsAfterName; ++i) {
        fields >> field;
    }
    double ticks = 0;
    return fields && std::istringstream(field) >> ticks ? std::optional(ticks) : std::nullopt;
}
#endif

} // namespace

double processAgeMs() {
#ifdef __linux__
    timespec now{};
    const auto ticks = startTicks();
    if (ticks && clock_gettime(CLOCK_BOOTTIME, &now) == 0) {
        const double nowMs = static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) / 1e6;
        return nowMs - *ticks * 1e3 / static_cast<double>(sysconf(_SC_CLK_TCK));
    }
#endif
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - kLoaded).count();
}

} // namespace posewire::gui
