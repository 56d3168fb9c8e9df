// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/ending_request.h"
#include "app/system/interruption.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>

namespace posewire::system {
namespace {

TEST(Interruption, HasNotComeWhereNobodyInterrupts) {
    const Interruption interruption;
    EXPECT_FALSE(Interruption::hasCome());
}

TEST(EndingRequest, IsNotMadeWhereNobodyAsks) {
    std::atomic<int> asked = 0;
    {
        const EndingRequest request([&] { ++asked; });
    }
    EXPECT_EQ(asked, 0);
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

TEST(EndingRequest, IsMadeOnceOnAnotherThread) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        std::atomic<bool> isAsked = false;
        std::thread::id thread;
        const EndingRequest request([&] {
            thread = std::this_thread::get_id();
            isAsked = true;
            isAsked.notify_all();
        });
        std::raise(signal);
        isAsked.wait(false);
        EXPECT_NE(thread, std::this_thread::get_id());
    }
}

TEST(EndingRequestDeathTest, TheSecondEndsTheProgram) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto askTwice = [] {
        const EndingRequest request([] {});
        std::raise(SIGTERM);
        std::raise(SIGTERM);
    };
    EXPECT_EXIT(askTwice(), testing::KilledBySignal(SIGTERM), "");
}
#endif

} // namespace
} // namespace posewire::system
