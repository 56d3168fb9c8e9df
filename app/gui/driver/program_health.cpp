// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/program_health.h"

#include <chrono>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#ifdef __linux__
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

std::optional<double> shareOf(const std::optional<double>& before, const std::optional<double>& now,
                              double seconds) {
    return before && now ? std::optional((*now - *before) / seconds) : std::nullopt;
}

} // namespace

std::optional<double> processCpuSeconds() {
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

void HealthMeter::add(const Reading& reading) {
    const std::optional<Reading> before = std::exchange(m_before, reading);
    m_health.bufferFill = reading.bufferFill;
    m_health.memoryBytes = reading.memoryBytes;
    const log::Duration follow = std::exchange(m_follow, {});
    const std::uint64_t followed = std::exchange(m_followed, 0);
    if (followed != 0) {
        m_health.followUsPerPacket =
            static_cast<double>(follow.count()) * 1e-3 / static_cast<double>(followed);
    }
    const double seconds = before ? log::secondsOf(reading.monotonic - before->monotonic) : 0;
    if (seconds <= 0) {
        return;
    }
    m_health.receiverShare = shareOf(before->receiverCpuS, reading.receiverCpuS, seconds);
    m_health.processShare = shareOf(before->processCpuS, reading.processCpuS, seconds);
    m_health.followShare = log::secondsOf(follow) / seconds;
    m_health.framesPerSecond = static_cast<double>(reading.frames - before->frames) / seconds;
}

} // namespace posewire::gui
