// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/interruption.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace posewire::system {
namespace {

TEST(Interruption, HasNotComeWhereNobodyInterrupts) {
    const Interruption interruption;
    EXPECT_FALSE(Interruption::hasCome());
}

#ifndef _WIN32 // whose consoles this process need not have
TEST(Interruption, IsRememberedAndForgottenByTheNext) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const Interruption interruption;
        ASSERT_FALSE(Interruption::hasCome());
        std::raise(signal);
        EXPECT_TRUE(Interruption::hasCome());
        std::raise(signal); // at once: the same again
    }
}

TEST(InterruptionDeathTest, TheSecondEndsTheProgramIfItComesLater) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto interruptTwice = [] {
        const Interruption interruption;
        std::raise(SIGTERM);
        std::this_thread::sleep_for(std::chrono::milliseconds(600));
        std::raise(SIGTERM);
    };
    EXPECT_EXIT(interruptTwice(), testing::KilledBySignal(SIGTERM), "");
}
#endif

} // namespace
} // namespace posewire::system
