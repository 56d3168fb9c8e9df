// SPDX-License-Identifier: MIT
#include "core/feed/pose_feed.h"
#include "core/model/session/messages.h"
#include "tests/core/export/motion/motion_fixture.h"
#include "tests/core/performer/faulty_performance.h"

#include <atomic>
#include <thread>

namespace posewire::feed {
namespace {

using exporting::MotionTest;
using model::Provenance;
using namespace std::chrono_literals;

struct Sources {
    const char* name;
    std::vector<std::uint8_t> types; ///< besides metadata and scale
};

/// Every source of poses: what is fed is what is drawn, and every format takes it.
class PoseSourcesTest : public MotionTest, public testing::WithParamInterface<Sources> {
protected:
    static constexpr double kPrecision = 1e-9;

    static performer::PerformerSettings settingsOf(const Sources& sources) {
        auto all = settings();
        all.types = sources.types;
        all.types.insert(all.types.end(), {12, 13});
        return all;
    }
    void receiveWithFaults(performer::FaultSettings faults) {
        faults.seed = 7;
        for (const auto& sending : performer::performWithFaults(settingsOf(GetParam()), faults, 2)) {
            log::Arrival arrival;
            arrival.stamp = kStart + sending.due;
            arrival.sender = m_log.senders().intern({"127.0.0.1:40001", log::Transport::Udp, 9763});
            m_log.writer().append(sending.bytes, arrival);
        }
        follow();
    }
    static std::vector<PoseSample> fed(const PoseSource& from) {
        std::vector<PoseSample> samples;
        PoseFeed poses(from, PoseContent::Segments);
        while (poses.advance([&](const PoseSample& sample) { samples.push_back(sample); })) {
        }
        return samples;
    }
    /// Compares each sample with what the session has at the packet that completed it.
    void expectWhatIsDrawn(const std::vector<PoseSample>& samples) {
        for (const PoseSample& sample : samples) {
            m_session.setCursor({model::Cursor::Mode::Paused, sample.pose.packet});
            const model::CharacterPose* drawn = m_session.messages().pose(source().characters[0].key);
            ASSERT_NE(drawn, nullptr);
            ASSERT_EQ(drawn->sample, sample.pose.sample);
            EXPECT_EQ(drawn->stamp, sample.pose.stamp);
            EXPECT_EQ(drawn->types, sample.pose.types);
            EXPECT_EQ(drawn->sources, sample.pose.sources);
            EXPECT_LT(exporting::differenceOf(drawn->segments, sample.pose.segments), kPrecision);
        }
        m_session.setCursor({});
    }
};

TEST_P(PoseSourcesTest, FeedsWhatIsDrawn) {
    perform(settingsOf(GetParam()), 60);
    const auto samples = fed(source());
    EXPECT_EQ(samples.size(), 60U);
    expectWhatIsDrawn(samples);
}

TEST_P(PoseSourcesTest, FeedsWhatIsDrawnOfSamplesInParts) {
    performer::FaultSettings faults;
    faults.splits = true;
    receiveWithFaults(faults);
    const auto samples = fed(source());
    EXPECT_EQ(samples.size(), 120U);
    expectWhatIsDrawn(samples);
}

TEST_P(PoseSourcesTest, FeedsEachSampleOnceInOrderWhateverIsLost) {
    performer::FaultSettings faults;
    faults.drop = 0.05;
    faults.duplicate = 0.05;
    faults.reorder = 0.05;
    receiveWithFaults(faults);
    const auto samples = fed(source());
    EXPECT_GT(samples.size(), 80U);
    EXPECT_TRUE(std::ranges::is_sorted(samples, std::ranges::less_equal(),
                                       [](const PoseSample& sample) { return sample.pose.sample; }));
    // As it begins, a type may be taken alone before the others are known to be on the air.
    constexpr std::size_t kBegin = 8;
    const auto typesOf = [](const PoseSample& sample) { return sample.pose.types; };
    const auto all = typesOf(samples[samples.size() / 2]);
    EXPECT_THAT(std::span(samples).subspan(kBegin), testing::Each(testing::ResultOf(typesOf, all)));
}

TEST_P(PoseSourcesTest, AllFormatsTakeIt) {
    perform(settingsOf(GetParam()), 30);
    for (const exporting::MotionFormat& format : exporting::motionFormats()) {
        const auto exported = write(format.suffix, source());
        ASSERT_TRUE(exported) << exported.error().text;
        ASSERT_EQ(exported->size(), 1U) << format.suffix;
        EXPECT_EQ(exported->front().frames, 30U) << format.suffix;
        EXPECT_EQ(exported->front().gaps, 0U) << format.suffix;
    }
}

INSTANTIATE_TEST_SUITE_P(All, PoseSourcesTest,
                         testing::Values(Sources{"Euler", {1}}, Sources{"Quaternion", {2}},
                                         Sources{"Unity", {5}}, Sources{"Linear", {21}},
                                         Sources{"Angular", {22}}, Sources{"Kinematics", {21, 22}},
                                         Sources{"Markers", {3}}, Sources{"MarkersAndLinear", {3, 21}},
                                         Sources{"AllParts", {3, 21, 22}},
                                         Sources{"Everything", {1, 2, 3, 5, 21, 22}}),
                         [](const auto& sources) { return std::string(sources.param.name); });

class PoseFeedTest : public MotionTest {};

TEST_F(PoseFeedTest, SaysWhatIsSolvedAndWhatIsAssumed) {
    auto angular = settings();
    angular.types = {22, 13};
    perform(angular, 10);
    const PoseSource from = source();
    PoseFeed poses(from, PoseContent::Segments);
    while (poses.advance([](const PoseSample& sample) {
        EXPECT_TRUE(sample.pose.isPlaceAssumed);
        EXPECT_EQ(sample.pose.sources[5].orientation, Provenance::Sent);
        EXPECT_EQ(sample.pose.sources[5].position, Provenance::Solved);
    })) {
    }
}

TEST_F(PoseFeedTest, OfTwoRatesFeedsTheSamplesThatBothHave) {
    auto both = settings(1, 240);
    both.types = {21, 22, 13};
    perform(both, 240, [](const wire::Datagram& datagram) {
        return datagram.header.type() != 21 || datagram.header.sampleCounter % 4 == 1;
    });
    std::vector<std::uint32_t> numbers;
    const PoseSource from = source();
    PoseFeed poses(from, PoseContent::Segments);
    while (poses.advance([&](const PoseSample& sample) {
        numbers.push_back(sample.pose.sample);
        EXPECT_EQ(sample.pose.types.size(), 2U);
    })) {
    }
    EXPECT_EQ(numbers.size(), 60U);
}

TEST_F(PoseFeedTest, FollowsWhatIsReceivedByOneWaitingTime) {
    perform(settings(), 1);
    PoseSource from = source();
    from.endPacket = UINT64_MAX;
    from.firstPacket = m_session.end();
    PoseFeed poses(from, PoseContent::Segments, 50ms);
    std::vector<std::uint32_t> numbers;
    const TakePose take = [&](const PoseSample& sample) { numbers.push_back(sample.pose.sample); };
    auto later = settings();
    later.firstSample = 2;
    perform(later, 2, sendsAll, kStart + 16ms);
    EXPECT_TRUE(poses.advance(take, kStart + 40ms));
    EXPECT_THAT(numbers, testing::IsEmpty());
    EXPECT_FALSE(poses.advance(take, kStart + 67ms));
    EXPECT_THAT(numbers, testing::ElementsAre(2));
    EXPECT_FALSE(poses.advance(take, kStart + 200ms));
    EXPECT_THAT(numbers, testing::ElementsAre(2, 3));
    EXPECT_EQ(poses.missed(), 0U);
}

TEST_F(PoseFeedTest, CountsWhatItMissedOnAnotherThread) {
    log::PacketLog small{{.memoryCap = std::size_t{1} << 20, .chunkSize = std::size_t{256} << 10}};
    perform(settings(), 1);
    PoseSource from = source();
    from.log = &small;
    from.firstPacket = 0;
    from.endPacket = UINT64_MAX;
    from.characters[0].parts[0].key.sender = small.senders().intern({"127.0.0.1:40001"});
    performer::Performer performer(settings());
    constexpr std::uint64_t kFrames = 4000;
    std::atomic<bool> isDone = false;
    std::uint64_t samples = 0;
    PoseFeed poses(from, PoseContent::Segments, 50ms);
    std::thread reader([&] {
        const TakePose take = [&](const PoseSample&) { ++samples; };
        while (!isDone) {
            poses.advance(take);
        }
        while (poses.advance(take, log::Stamp::max() - 1s)) {
        }
    });
    std::uint64_t sent = 0;
    for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
        for (const wire::Datagram& datagram : performer.frame(frame)) {
            log::Arrival arrival;
            arrival.stamp = kStart + frame * 16ms;
            arrival.sender = from.characters[0].parts[0].key.sender;
            small.writer().append(wire::encode(datagram).value(), arrival);
            ++sent;
        }
        small.writer().publish();
    }
    isDone = true;
    reader.join();
    EXPECT_GT(samples, 0U);
    EXPECT_GE(samples + poses.missed(), kFrames);
    EXPECT_LT(poses.missed(), sent);
}

using UpAxisTest = MotionTest;

/// What one performer sends, in each of the frames, is one pose, drawn and exported.
TEST_F(UpAxisTest, AYUpSenderIsFedAndWrittenAsAZUpOne) {
    constexpr double kHundredthOfAMillimetre = 1e-5;
    for (const std::vector<std::uint8_t>& types :
         std::vector<std::vector<std::uint8_t>>{{2, 12, 13}, {21, 22, 12, 13}}) {
        std::array<std::vector<std::vector<model::SegmentPose>>, 2> poses;
        for (const bool isYUp : {false, true}) {
            auto all = settings();
            all.types = types;
            all.isYUp = isYUp;
            const std::string address = "10.0.0." + std::to_string(types[0]) + (isYUp ? "1:1" : "2:1");
            perform(all, 60, sendsAll, kStart, address);
            const model::Sender& sender = m_session.roster().senders().back();
            EXPECT_EQ(sender.up(), isYUp ? model::UpAxis::Y : model::UpAxis::Z) << types[0];
            const std::array keys{model::CharacterKey{sender.id, 0}};
            const auto from = poseSourceOf(m_session, model::kAllTime, keys);
            for (const auto& one : framesOf(from)) {
                poses[isYUp ? 1 : 0].push_back(one.pose.segments);
            }
            EXPECT_LT(exporting::differenceOf(m_session.messages().pose(keys[0])->segments,
                                              poses[isYUp ? 1 : 0].back()),
                      kHundredthOfAMillimetre);
        }
        ASSERT_EQ(poses[0].size(), 60U);
        ASSERT_EQ(poses[1].size(), 60U);
        for (std::size_t i = 0; i < poses[0].size(); ++i) {
            EXPECT_LT(exporting::differenceOf(poses[0][i], poses[1][i]), kHundredthOfAMillimetre);
        }
    }
}

TEST_F(UpAxisTest, AllPoseTypesOfAYUpSenderAgreeWithinATenthOfAMillimetre) {
    std::vector<std::vector<model::SegmentPose>> poses;
    for (const std::uint8_t type : std::vector<std::uint8_t>{1, 2, 5}) {
        auto all = settings();
        all.types = {type, 12, 13};
        all.isYUp = true;
        perform(all, 30, sendsAll, kStart, "10.0.0." + std::to_string(type) + ":1");
        const std::array keys{model::CharacterKey{m_session.roster().senders().back().id, 0}};
        poses.push_back(framesOf(poseSourceOf(m_session, model::kAllTime, keys)).back().pose.segments);
    }
    for (std::size_t i = 0; i < model::kBodySegments; ++i) {
        EXPECT_LT((poses[0][i].position - poses[1][i].position).norm(), 1e-4);
        EXPECT_LT((poses[2][i].position - poses[1][i].position).norm(), 1e-4);
    }
}

TEST_F(UpAxisTest, WhatTheOperatorDeclaresHoldsAlsoForWhatWasReadBefore) {
    auto all = settings();
    all.isYUp = true;
    perform(all, 30);
    const model::CharacterKey key{m_session.roster().senders().back().id, 0};
    const auto heightOfHead = [&] {
        return m_session.messages().pose(key)->segments[model::segment::kHead].position.z();
    };
    EXPECT_GT(heightOfHead(), 1.2);
    m_session.setOverride(key.sender, {.up = model::UpAxis::Z});
    EXPECT_LT(heightOfHead(), 1.2);
    m_session.setOverride(key.sender, {.up = model::UpAxis::Y});
    EXPECT_GT(heightOfHead(), 1.2);
}

} // namespace
} // namespace posewire::feed
