// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/replaying.h"

#include "tests/app/gui/models/stage.h"

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

TEST(Replaying, EndsWithTheLogThatItReadsAndNotWithAnother) {
    Stage live;
    Stage file;
    performer::Performer performer(sending(1, {2}));
    live.perform(performer, 0, 240);
    live.follow();
    const log::SystemClock clock;
    Replaying replaying(clock);
    const ReplayRequest request{.target = {{"127.0.0.1", 9}}, .isLooping = true};
    ASSERT_EQ(replaying.start(request, live.session), "");
    replaying.endOf(file.log);
    EXPECT_NE(replaying.current(), nullptr) << "it was of what is live, and a file was closed";
    replaying.endOf(live.log);
    EXPECT_EQ(replaying.current(), nullptr);
}

TEST(Replaying, AStoppedOneIsWaitedForBeforeItsLogGoes) {
    const log::SystemClock clock;
    Replaying replaying(clock);
    {
        Stage file;
        performer::Performer performer(sending(1, {2}));
        file.perform(performer, 0, 240);
        file.follow();
        ASSERT_EQ(replaying.start({.target = {{"127.0.0.1", 9}}, .isLooping = true}, file.session), "");
        replaying.stop();
        replaying.endOf(file.log);
    }
    EXPECT_EQ(replaying.current(), nullptr);
}

} // namespace
} // namespace posewire::gui
