// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/process_figures.h"

#include <chrono>
#include <ctime>

namespace posewire::system {
namespace {

const std::chrono::steady_clock::time_point kLoaded = std::chrono::steady_clock::now();

} // namespace

std::optional<double> processCpuSeconds() {
    const std::clock_t ticks = std::clock();
    return ticks == static_cast<std::clock_t>(-1)
               ? std::nullopt
               : std::optional(static_cast<double>(ticks) / CLOCKS_PER_SEC);
}

std::optional<double> threadCpuSeconds(std::thread&) {
    return std::nullopt;
}

std::optional<std::uint64_t> processMemoryBytes() {
    return std::nullopt;
}

double processAgeMs() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - kLoaded).count();
}

void yieldToOthers() {}

} // namespace posewire::system
