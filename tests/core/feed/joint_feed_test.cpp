// SPDX-License-Identifier: MIT
#include "core/feed/joint_feed.h"

#include "tests/core/export/motion/motion_fixture.h"

namespace posewire::feed {
namespace {

using exporting::MotionTest;
using model::JointExtents;
using namespace std::chrono_literals;

constexpr std::size_t kFlexion = 2;
constexpr std::size_t kRightKneeJoint = 15;

class JointFeedTest : public MotionTest {
protected:
    /// One performer, with the types given and its scale.
    void performTypes(std::vector<std::uint8_t> types, std::uint64_t frames) {
        auto one = settings(1, 60);
        one.types = std::move(types);
        one.types.push_back(13);
        perform(one, frames);
    }
    static JointExtents read(JointFeed& feed) {
        while (feed.advance(kStart + 1h)) {
        }
        return feed.extents();
    }
    static JointExtents read(const PoseSource& source, bool isSent, log::Duration window = {}) {
        JointFeed feed(source, isSent, window);
        return read(feed);
    }
    static void expectSame(const JointExtents& one, const JointExtents& other, double radians) {
        EXPECT_EQ(one.samples(), other.samples());
        for (std::size_t joint = 0; joint < model::kBodyJointCount; ++joint) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::string name =
                    std::string(model::jointDefinitions()[joint].name) + " " + std::to_string(axis);
                ASSERT_EQ(one.range(joint, axis).isEmpty(), other.range(joint, axis).isEmpty()) << name;
                EXPECT_NEAR(one.range(joint, axis).least, other.range(joint, axis).least, radians) << name;
                EXPECT_NEAR(one.range(joint, axis).most, other.range(joint, axis).most, radians) << name;
            }
        }
    }
};

TEST_F(JointFeedTest, BoundsWhatWasSentAndWhatIsComputedAlike) {
    performTypes({2, 20}, 120);
    const JointExtents computed = read(source(), false);
    const JointExtents sent = read(source(), true);
    EXPECT_EQ(computed.samples(), 120U);
    expectSame(computed, sent, 1e-4);
    const model::AngleRange& knee = computed.range(kRightKneeJoint, kFlexion);
    EXPECT_GT(knee.most - knee.least, 0.5) << "a walk bends the knee";
}

TEST_F(JointFeedTest, ComputesAnglesOfOrientationsAlone) {
    performTypes({20, 22}, 60);
    const JointExtents computed = read(source(), false);
    EXPECT_EQ(computed.samples(), 60U);
    expectSame(computed, read(source(), true), 1e-4);
}

TEST_F(JointFeedTest, KeepsAWindowOfTheEnd) {
    performTypes({2}, 240);
    const model::TimeRange second{kStart + 3s, kStart + 4s};
    const JointExtents windowed = read(source(), false, 1s);
    EXPECT_NEAR(static_cast<double>(windowed.samples()), 60.0, 2.0);
    const JointExtents wanted = read(source(second), false);
    for (const std::size_t joint : {15U, 19U}) {
        EXPECT_NEAR(windowed.range(joint, kFlexion).most, wanted.range(joint, kFlexion).most, 0.05);
        EXPECT_NEAR(windowed.range(joint, kFlexion).least, wanted.range(joint, kFlexion).least, 0.05);
    }
}

TEST_F(JointFeedTest, GoesOnWithWhatIsReceived) {
    performTypes({2, 20}, 60);
    JointFeed computed(source(), false, {});
    JointFeed sent(source(), true, {});
    EXPECT_EQ(read(computed).samples(), 60U);
    EXPECT_EQ(read(sent).samples(), 60U);
    auto one = settings(1, 60);
    one.types = {2, 20};
    performer::Performer performer(one);
    for (std::uint64_t frame = 60; frame < 90; ++frame) {
        for (const wire::Datagram& datagram : performer.frame(frame)) {
            send(datagram, kStart + log::durationOf(static_cast<double>(frame) / 60));
        }
    }
    follow();
    EXPECT_EQ(read(computed).samples(), 60U) << "not before it is told how far";
    computed.update(source());
    sent.update(source());
    EXPECT_EQ(read(computed).samples(), 90U);
    EXPECT_EQ(read(sent).samples(), 90U);
}

} // namespace
} // namespace posewire::feed
