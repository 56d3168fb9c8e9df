// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose.h"

#include <gtest/gtest.h>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

constexpr log::Stamp at(log::Duration time) {
    return log::Stamp(time);
}

wire::NullPose segmentsOf(float height) {
    wire::NullPose part;
    part.segments = {{"Pelvis", {0, 0, height}}};
    return part;
}

wire::NullPose pointsOf(std::uint16_t id) {
    wire::NullPose part;
    part.points = {{1, id, "p", 0, {0, 0, 0}}};
    return part;
}

/// Sends messages of three parts, one part a packet.
class NullPoseRecordTest : public testing::Test {
protected:
    void send(float height, log::Stamp stamp, const std::vector<int>& lost = {}) {
        for (int part = 0; part < 3; ++part) {
            if (std::find(lost.begin(), lost.end(), part) == lost.end()) {
                const auto counter = static_cast<std::uint8_t>(part == 2 ? 0x82 : part);
                history.add(part == 0 ? segmentsOf(height) : pointsOf(static_cast<std::uint16_t>(part)),
                            counter, packet, stamp + part * 1ns);
            }
            ++packet;
        }
    }
    NullPoseRecord now() const { return history.record(packet); }

    NullPoseHistory history;
    std::uint64_t packet = 0;
};

TEST_F(NullPoseRecordTest, CountsMessagesAndKnowsHowOftenTheyCome) {
    for (int i = 0; i < 5; ++i) {
        send(1, at(i * 5s));
    }
    EXPECT_EQ(now().messages, 5U);
    EXPECT_EQ(now().repetition, 5s);
    EXPECT_EQ(now().incompleteMessages, 0U);
    EXPECT_EQ(now().before, nullptr);
    EXPECT_EQ(now().changed, log::Stamp());
    EXPECT_EQ(history.record(5).messages, 2U);
}

TEST_F(NullPoseRecordTest, RemembersWhatWasSaidBeforeAChange) {
    send(1, at(0s));
    send(1, at(5s));
    send(2, at(10s));
    send(2, at(15s));
    const NullPoseRecord record = now();
    EXPECT_EQ(record.changed, at(10s));
    ASSERT_NE(record.before, nullptr);
    EXPECT_EQ(record.before->segments[0].position.z(), 1.0);
    EXPECT_TRUE(record.before->isComplete());
    EXPECT_EQ(history.record(4).before, nullptr);
    EXPECT_EQ(history.record(4).pose->segments[0].position.z(), 1.0);
}

TEST_F(NullPoseRecordTest, ALostPartIsNoChange) {
    send(1, at(0s), {1});
    EXPECT_EQ(now().newest->missingParts, std::vector<unsigned>{1});
    send(1, at(5s));
    EXPECT_EQ(now().before, nullptr);
    EXPECT_EQ(now().incompleteMessages, 1U);
    EXPECT_TRUE(now().newest->isComplete());
    EXPECT_EQ(now().pose->points.size(), 2U);
}

TEST_F(NullPoseRecordTest, WithoutTheLastPartTheNumberOfPartsIsOpen) {
    send(1, at(0s), {2});
    EXPECT_EQ(now().newest->partsExpected, 0U);
    EXPECT_FALSE(now().newest->isComplete());
    EXPECT_TRUE(now().newest->missingParts.empty());
}

TEST_F(NullPoseRecordTest, PartsThatTheNetworkRepeatsBeginNoMessage) {
    send(1, at(0s));
    history.add(pointsOf(2), 0x82, packet, at(10ns));
    history.add(segmentsOf(1), 0x00, packet + 1, at(11ns));
    EXPECT_EQ(now().messages, 1U);
    EXPECT_TRUE(now().newest->isComplete());
}

TEST_F(NullPoseRecordTest, HasNothingBeforeTheFirstMessage) {
    packet = 10;
    send(1, at(0s));
    EXPECT_EQ(history.record(9).pose, nullptr);
    EXPECT_EQ(history.record(9).messages, 0U);
    EXPECT_EQ(history.record(9).newest, nullptr);
}

TEST_F(NullPoseRecordTest, OneMessageTakesNoMoreThanTwoVersions) {
    for (int i = 0; i < 16; ++i) {
        send(static_cast<float>(i), at(i * 1s));
    }
    // 16 bodies in 48 steps: the first is still known.
    EXPECT_EQ(history.at(2)->segments[0].position.z(), 0.0);
    EXPECT_EQ(history.at(2)->points.size(), 2U);
}

} // namespace
} // namespace posewire::model
