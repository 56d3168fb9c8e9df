// SPDX-License-Identifier: MIT
#include "core/model/body/pose_interpolation.h"

#include <gtest/gtest.h>

#include <numbers>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

constexpr log::Stamp kStart{1'000s};
constexpr log::Duration kPeriod = 40ms;

/// One segment that moves 1 m and turns 90° about z each sample.
CharacterPose sample(std::uint32_t number) {
    CharacterPose pose;
    SegmentPose segment;
    segment.position = {static_cast<double>(number), 0, 1};
    segment.orientation = Eigen::AngleAxisd(number * std::numbers::pi / 2, Eigen::Vector3d::UnitZ());
    pose.segments = {segment};
    pose.sources = {{Provenance::Sent, Provenance::Sent}};
    pose.sample = number;
    pose.packet = number;
    pose.stamp = kStart + number * kPeriod;
    return pose;
}

class PoseInterpolationTest : public testing::Test {
protected:
    double placeAt(const CharacterPose& newest, log::Duration since) {
        return motion.at(newest, newest.stamp + since).segments[0].position.x();
    }

    PoseInterpolation motion;
};

TEST_F(PoseInterpolationTest, TheFirstSampleIsShownAsItIs) {
    EXPECT_EQ(placeAt(sample(1), 0ms), 1);
    EXPECT_EQ(placeAt(sample(1), 30ms), 1);
    EXPECT_FALSE(motion.isUnderWay());
}

TEST_F(PoseInterpolationTest, GlidesToEachSampleInTheTimeThatLayBetween) {
    for (const log::Duration since : {0ms, 10ms, 20ms, 30ms}) {
        placeAt(sample(1), since);
    }
    EXPECT_DOUBLE_EQ(placeAt(sample(2), 0ms), 1);
    EXPECT_DOUBLE_EQ(placeAt(sample(2), 10ms), 1.25);
    EXPECT_TRUE(motion.isUnderWay());
    EXPECT_DOUBLE_EQ(placeAt(sample(2), 30ms), 1.75);
    const Eigen::Quaterniond turned = motion.at(sample(2), sample(2).stamp + 20ms).segments[0].orientation;
    const Eigen::Quaterniond half(Eigen::AngleAxisd(0.75 * std::numbers::pi, Eigen::Vector3d::UnitZ()));
    EXPECT_LT(turned.angularDistance(half), 1e-9);
    EXPECT_DOUBLE_EQ(placeAt(sample(2), 50ms), 2) << "never beyond what was sent";
    EXPECT_FALSE(motion.isUnderWay());
}

TEST_F(PoseInterpolationTest, ASampleThatComesEarlyIsNoJump) {
    placeAt(sample(1), 0ms);
    placeAt(sample(1), 20ms);
    placeAt(sample(2), 0ms);
    EXPECT_DOUBLE_EQ(placeAt(sample(2), 20ms), 1.5);
    CharacterPose early = sample(3);
    early.stamp = sample(2).stamp + 24ms;
    EXPECT_DOUBLE_EQ(placeAt(early, 0ms), 1.5);
    EXPECT_DOUBLE_EQ(placeAt(early, 12ms), 2.25);
}

TEST_F(PoseInterpolationTest, SamplesAsFastAsTheDisplayAreShownAsTheyAre) {
    for (std::uint32_t number = 1; number < 20; ++number) {
        EXPECT_EQ(placeAt(sample(number), 3ms), number);
    }
}

TEST_F(PoseInterpolationTest, NothingIsMadeUpOverAGapOrForAnotherBody) {
    placeAt(sample(1), 0ms);
    placeAt(sample(1), 20ms);
    EXPECT_EQ(placeAt(sample(9), 0ms), 9) << "320 ms later";
    placeAt(sample(9), 20ms);
    CharacterPose other = sample(10);
    other.segments.push_back(other.segments[0]);
    other.sources.push_back(other.sources[0]);
    EXPECT_EQ(placeAt(other, 0ms), 10);
}

TEST_F(PoseInterpolationTest, ASegmentThatWasMissingComesAtOnce) {
    CharacterPose missing = sample(1);
    missing.sources = {{Provenance::None, Provenance::None}};
    placeAt(missing, 0ms);
    placeAt(missing, 20ms);
    EXPECT_EQ(placeAt(sample(2), 10ms), 2);
}

} // namespace
} // namespace posewire::model
