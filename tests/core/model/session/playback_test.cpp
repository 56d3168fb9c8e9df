// SPDX-License-Identifier: MIT
#include "core/model/session/playback.h"

#include <gtest/gtest.h>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

constexpr log::Stamp kFrom{100s};
constexpr log::Moment kNow{5s};

TEST(PlaybackTest, MovesByItsSpeed) {
    EXPECT_EQ(Playback(kFrom, kNow, 1).at(kNow), kFrom);
    EXPECT_EQ(Playback(kFrom, kNow, 1).at(kNow + 2s), kFrom + 2s);
    EXPECT_EQ(Playback(kFrom, kNow, -0.5).at(kNow + 2s), kFrom - 1s);
    EXPECT_EQ(Playback(kFrom, kNow, 4).at(kNow + 250ms), kFrom + 1s);
}

TEST(PlaybackTest, KnowsASlowestAndAFastest) {
    EXPECT_EQ(Playback(kFrom, kNow, 1000).speed(), Playback::kFastest);
    EXPECT_EQ(Playback(kFrom, kNow, -1000).speed(), -Playback::kFastest);
    EXPECT_EQ(Playback(kFrom, kNow, -0.001).speed(), -Playback::kSlowest);
}

TEST(PlaybackTest, BeginsAgainAtTheOtherEndOfItsLoop) {
    const TimeRange loop{kFrom, kFrom + 3s};
    EXPECT_EQ(Playback(kFrom + 1s, kNow, 1, loop).at(kNow + 1s), kFrom + 2s);
    EXPECT_EQ(Playback(kFrom + 1s, kNow, 1, loop).at(kNow + 2s), kFrom);
    EXPECT_EQ(Playback(kFrom + 1s, kNow, 1, loop).at(kNow + 3602s), kFrom);
    EXPECT_EQ(Playback(kFrom + 1s, kNow, -1, loop).at(kNow + 2s), kFrom + 2s);
}

TEST(PlaybackTest, BeginsInItsLoop) {
    const TimeRange loop{kFrom, kFrom + 3s};
    EXPECT_EQ(Playback(kFrom - 50s, kNow, 1, loop).at(kNow), kFrom);
    EXPECT_LT(Playback(kFrom + 50s, kNow, -1, loop).at(kNow), kFrom + 3s);
    EXPECT_GT(Playback(kFrom + 50s, kNow, -1, loop).at(kNow), kFrom + 2s);
    EXPECT_EQ(Playback(kFrom, kNow, 1, TimeRange{kFrom, kFrom}).at(kNow + 1s), kFrom + 1s) << "no loop";
}

} // namespace
} // namespace posewire::model
