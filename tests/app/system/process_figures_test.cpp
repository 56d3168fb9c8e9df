// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/process_figures.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <vector>

namespace posewire::system {
namespace {

/// Until so much processor time went by.
void work(double seconds) {
    const double begin = processCpuSeconds().value();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (processCpuSeconds().value() < begin + seconds && std::chrono::steady_clock::now() < end) {
    }
}

TEST(ProcessFigures, GrowWithTheWorkThatIsDone) {
    const double before = processCpuSeconds().value();
    work(0.1);
    EXPECT_GE(processCpuSeconds().value(), before + 0.1);
}

TEST(ProcessFigures, TellTheWorkOfOneThread) {
    std::atomic<bool> isDone = false;
    std::thread busy([&] {
        work(0.2);
        isDone = true;
        isDone.wait(true);
    });
    while (!isDone) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const auto seconds = threadCpuSeconds(busy);
    isDone = false;
    isDone.notify_all();
    busy.join();
#if defined(__linux__) || defined(_WIN32)
    ASSERT_TRUE(seconds);
#endif
    EXPECT_GT(seconds.value_or(0.2), 0.1);
    EXPECT_LE(seconds.value_or(0), processCpuSeconds().value());
}

TEST(ProcessFigures, CountTheMemoryThatIsUsed) {
    constexpr std::uint64_t size = std::uint64_t{64} << 20;
    const auto before = processMemoryBytes();
    const std::vector<char> used(size, 1);
    const auto after = processMemoryBytes();
#if defined(__linux__) || defined(_WIN32)
    ASSERT_TRUE(before && after);
#endif
    EXPECT_GE(after.value_or(size), before.value_or(0) + size / 2);
    EXPECT_EQ(used.back(), 1);
}

TEST(ProcessFigures, KnowHowOldTheProcessIs) {
    const double age = processAgeMs();
    EXPECT_GE(age, 0);
    EXPECT_LT(age, 600e3);
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    EXPECT_GE(processAgeMs(), age + 20);
}

TEST(ProcessFigures, AThreadThatYieldsStillRuns) {
    bool hasRun = false;
    std::thread([&] {
        yieldToOthers();
        hasRun = true;
    }).join();
    EXPECT_TRUE(hasRun);
}

} // namespace
} // namespace posewire::system
