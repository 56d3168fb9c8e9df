// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose.h"

#include <gtest/gtest.h>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

wire::NullPose segmentPart(float height) {
    wire::NullPose part;
    part.segments = {{"Pelvis", {0, 0, height}}, {"L5", {0, 0, height + 0.1F}}};
    return part;
}

wire::NullPose pointPart(std::uint16_t first) {
    wire::NullPose part;
    part.points = {{1, first, "p", 0, {0, 0, 0}},
                   {1, static_cast<std::uint16_t>(first + 1), "p", 0, {0, 0, 0}}};
    return part;
}

TEST(NullPoseAssembler, HasNothingBeforeSegmentsArrive) {
    NullPoseAssembler assembler;
    assembler.add(pointPart(1), 1, 0, {});
    EXPECT_EQ(assembler.newest(), nullptr);
    EXPECT_EQ(assembler.arriving().partsReceived, 1U);
}

TEST(NullPoseAssembler, GathersPartsInAnyOrder) {
    NullPoseAssembler assembler;
    assembler.add(segmentPart(1), 0x00, 0, log::Stamp(10ns));
    assembler.add(pointPart(5), 0x82, 1, log::Stamp(11ns));
    EXPECT_FALSE(assembler.newest()->isComplete());
    assembler.add(pointPart(3), 0x01, 2, log::Stamp(12ns));
    const NullPose* pose = assembler.newest();
    ASSERT_TRUE(pose->isComplete());
    EXPECT_EQ(pose->partsReceived, 3U);
    ASSERT_EQ(pose->points.size(), 4U);
    EXPECT_EQ(pose->points[0].id, 3);
    EXPECT_EQ(pose->points[2].id, 5);
    EXPECT_EQ(pose->stamp, log::Stamp(12ns));
}

TEST(NullPoseAssembler, CountsARepeatedPartOnce) {
    NullPoseAssembler assembler;
    assembler.add(segmentPart(1), 0x00, 0, {});
    assembler.add(pointPart(3), 0x01, 1, {});
    assembler.add(pointPart(3), 0x01, 2, {});
    EXPECT_EQ(assembler.newest()->points.size(), 2U);
    EXPECT_EQ(assembler.newest()->partsReceived, 2U);
}

TEST(NullPoseAssembler, KeepsTheCompleteMessageWhileTheSameIsSentAgain) {
    NullPoseAssembler assembler;
    assembler.add(segmentPart(1), 0x00, 0, {});
    assembler.add(pointPart(3), 0x81, 1, {});
    assembler.add(segmentPart(1), 0x00, 2, {});
    EXPECT_TRUE(assembler.newest()->isComplete());
    EXPECT_EQ(assembler.newest()->points.size(), 2U);
}

TEST(NullPoseAssembler, UsesNewSegmentsAtOnceAlthoughPartsAreMissing) {
    NullPoseAssembler assembler;
    assembler.add(segmentPart(1), 0x00, 0, {});
    assembler.add(pointPart(3), 0x81, 1, {});
    assembler.add(segmentPart(1.2F), 0x00, 2, {});
    EXPECT_FLOAT_EQ(static_cast<float>(assembler.newest()->segments[0].position.z()), 1.2F);
}

TEST(NullPoseHistory, TellsWhatWasKnownAtAPacket) {
    NullPoseHistory history;
    history.add(segmentPart(1), 0x80, 10, {});
    history.add(segmentPart(1), 0x80, 20, {});
    history.add(segmentPart(2), 0x80, 30, {});
    EXPECT_EQ(history.at(9), nullptr);
    EXPECT_FLOAT_EQ(static_cast<float>(history.at(25)->segments[0].position.z()), 1.0F);
    EXPECT_FLOAT_EQ(static_cast<float>(history.at(30)->segments[0].position.z()), 2.0F);
}

TEST(NullPoseHistory, StaysBounded) {
    NullPoseHistory history;
    for (std::uint64_t packet = 0; packet < 10'000; ++packet) {
        history.add(segmentPart(static_cast<float>(packet)), 0x80, packet, {});
    }
    EXPECT_FLOAT_EQ(static_cast<float>(history.at(9'999)->segments[0].position.z()), 9'999.0F);
    EXPECT_FLOAT_EQ(static_cast<float>(history.at(0)->segments[0].position.z()),
                    static_cast<float>(10'000 - NullPoseHistory::kMostVersions));
}

} // namespace
} // namespace posewire::model
