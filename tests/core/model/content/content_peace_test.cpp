// SPDX-License-Identifier: MIT
#include "tests/core/model/content/content_fixture.h"

#include "core/performer/motion.h"
#include "tests/core/performer/faulty_performance.h"

/// What looks odd and is right: no incident comes of it.
namespace posewire::model {
namespace {

class Peace : public ContentTest,
              public testing::WithParamInterface<std::tuple<std::string, performer::Revision>> {
protected:
    /// With losses, doubles and reordering, and samples in parts.
    void performFaulty(double seconds, const performer::FaultSettings& settings) {
        for (const performer::Sending& sending :
             performer::performWithFaults(m_settings, settings, seconds)) {
            send(sending.bytes, stampOf(0) + sending.due);
        }
        m_session.follow(m_now);
    }
    void expectPeaceOnABadNetwork(bool splits) {
        std::tie(m_settings.motion, m_settings.revision) = GetParam();
        m_settings.props = 1;
        performer::FaultSettings faults;
        faults.drop = faults.duplicate = faults.reorder = faults.corrupt = 0.03;
        faults.burst = 10;
        faults.jitterMs = 10;
        faults.splits = splits;
        performFaulty(2, faults);
        EXPECT_TRUE(told().empty()) << testing::PrintToString(told());
    }
};

TEST_P(Peace, IsKeptWithAllThatPerformersSend) {
    std::tie(m_settings.motion, m_settings.revision) = GetParam();
    m_settings.types = {};
    m_settings.characters = 2;
    m_settings.props = 2;
    m_settings.fingers = m_settings.revision == performer::Revision::N;
    perform(2);
    EXPECT_TRUE(told().empty()) << testing::PrintToString(told());
}

TEST_P(Peace, IsKeptOnABadNetwork) {
    expectPeaceOnABadNetwork(false);
}

TEST_P(Peace, IsKeptOnABadNetworkInParts) {
    expectPeaceOnABadNetwork(true);
}

INSTANTIATE_TEST_SUITE_P(All, Peace,
                         testing::Combine(testing::Values("walk", "idle", "wave", "squat", "tpose"),
                                          testing::Values(performer::Revision::E, performer::Revision::J,
                                                          performer::Revision::K, performer::Revision::N)));

TEST(PeaceOfMotions, IsTestedWithAll) {
    EXPECT_EQ(performer::motionNames().size(), 5U) << "another motion is tested above, too";
}

TEST_F(ContentTest, AStillPropBesideAMovingBodyIsNoFault) {
    m_settings.props = 1;
    perform(3, ofSegments([](auto& segments) {
                segments.back().position = {1, 1, 1};
                segments.back().orientation = {1, 0, 0, 0};
            }));
    EXPECT_TRUE(told().empty()) << testing::PrintToString(told());
}

/// The lower body, or objects, of a sender that counts them in its header.
ContentChange withSegments(std::vector<std::uint32_t> ids) {
    return [ids](wire::Datagram& datagram) {
        if (auto* pose = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
            std::erase_if(pose->segments,
                          [&](const auto& segment) { return std::ranges::count(ids, segment.id) == 0; });
            datagram.header.items = datagram.header.bodySegments = static_cast<std::uint8_t>(ids.size());
            datagram.header.payloadSize = static_cast<std::uint16_t>(32 * ids.size());
        }
    };
}

TEST_F(ContentTest, ALowerBodyOfEightSegmentsIsNoFault) {
    m_settings.types = {2};
    perform(3, withSegments({1, 16, 17, 18, 19, 20, 21, 22}));
    EXPECT_TRUE(told().empty()) << testing::PrintToString(told());
}

TEST_F(ContentTest, OneObjectThatLiesStillIsNoFault) {
    m_settings.types = {2};
    perform(3, [&](wire::Datagram& datagram) {
        withSegments({1})(datagram);
        std::get<wire::PoseQuaternion>(datagram.body).segments.front().position = {400, 1, 0.5F};
        std::get<wire::PoseQuaternion>(datagram.body).segments.front().orientation = {1, 0, 0, 0};
    });
    EXPECT_TRUE(told().empty()) << testing::PrintToString(told());
}

TEST_F(ContentTest, ASenderWithoutCountsMaySendFewSegmentsFromTheBeginning) {
    m_settings.types = {2};
    m_settings.revision = performer::Revision::K;
    perform(3, [](wire::Datagram& datagram) {
        auto& segments = std::get<wire::PoseQuaternion>(datagram.body).segments;
        segments.resize(8);
        datagram.header.items = 8;
    });
    EXPECT_TRUE(told().empty()) << testing::PrintToString(told());
}

TEST_F(ContentTest, ALoopThatJumpsBackIsAJumpAndNoMore) {
    perform(3, ofEach([](auto& segment) { segment.position[0] += 2; }));
    perform(2);
    EXPECT_EQ(of(ContentFault::Jump).size(), 1U);
    EXPECT_EQ(told().size(), 1U) << testing::PrintToString(told());
}

TEST_F(ContentTest, APauseWithoutSamplesIsNoFrozenPose) {
    perform(2);
    const std::uint64_t held = m_frame;
    m_frame += 300; // nothing is sent meanwhile
    EXPECT_GT(m_frame, held);
    perform(2);
    EXPECT_TRUE(told().empty()) << testing::PrintToString(told());
}

TEST_F(ContentTest, ARunnerBehindABurstOfLossesDoesNotJump) {
    const auto run = [frame = 0](wire::Datagram& datagram) mutable {
        if (auto* pose = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
            for (wire::SegmentQuaternion& segment : pose->segments) {
                segment.position[0] += 10.0F / 60 * static_cast<float>(frame);
            }
            ++frame;
        }
    };
    perform(2, run);
    performer::PerformerSettings settings = m_settings;
    m_frame += 30;
    perform(2, [&](wire::Datagram& datagram) {
        if (auto* pose = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
            for (wire::SegmentQuaternion& segment : pose->segments) {
                segment.position[0] += 10.0F / 60 * static_cast<float>(datagram.header.sampleCounter);
            }
        }
    });
    EXPECT_TRUE(told().empty()) << testing::PrintToString(told());
}

} // namespace
} // namespace posewire::model
