// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/process_figures.h"

#include <chrono>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>

#include <pthread.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace posewire::system {
namespace {

const std::chrono::steady_clock::time_point kLoaded = std::chrono::steady_clock::now();

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

} // namespace

std::optional<double> processCpuSeconds() {
    const std::clock_t ticks = std::clock();
    return ticks == static_cast<std::clock_t>(-1)
               ? std::nullopt
               : std::optional(static_cast<double>(ticks) / CLOCKS_PER_SEC);
}

std::optional<double> threadCpuSeconds(std::thread& thread) {
    clockid_t clock{};
    timespec time{};
    if (::pthread_getcpuclockid(thread.native_handle(), &clock) == 0 && ::clock_gettime(clock, &time) == 0) {
        return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
    }
    return std::nullopt;
}

std::optional<std::uint64_t> processMemoryBytes() {
    std::ifstream file("/proc/self/statm"); // proc(5): size and resident, in pages
    std::uint64_t size = 0;
    std::uint64_t resident = 0;
    if (file >> size >> resident) {
        return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    }
    return std::nullopt;
}

double processAgeMs() {
    timespec now{};
    const auto ticks = startTicks();
    if (ticks && ::clock_gettime(CLOCK_BOOTTIME, &now) == 0) {
        const double nowMs = static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) / 1e6;
        return nowMs - *ticks * 1e3 / static_cast<double>(::sysconf(_SC_CLK_TCK));
    }
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - kLoaded).count();
}

void yieldToOthers() {
    constexpr int kNice = 8;
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::syscall(SYS_gettid)), kNice);
}

} // namespace posewire::system
