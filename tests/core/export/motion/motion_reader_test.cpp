// SPDX-License-Identifier: MIT
#include "tests/core/export/motion/motion_fixture.h"

#include "core/wire/codec.h"

namespace posewire::exporting {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// The wire's floats, in metres from the floor's middle.
constexpr double kPrecision = 1e-6;

class MotionReaderTest : public MotionTest {
protected:
    static std::vector<std::uint32_t> samplesOf(const std::vector<Frame>& frames) {
        std::vector<std::uint32_t> samples;
        for (const Frame& frame : frames) {
            samples.push_back(frame.frame.sample);
        }
        return samples;
    }
    static std::vector<std::uint32_t> gapsOf(const std::vector<Frame>& frames) {
        std::vector<std::uint32_t> samples;
        for (const Frame& frame : frames) {
            if (frame.frame.isGap()) {
                samples.push_back(frame.frame.sample);
            }
        }
        return samples;
    }
    static std::vector<std::uint32_t> runsOf(const std::vector<Frame>& frames) {
        std::vector<std::uint32_t> samples;
        std::map<std::size_t, std::uint64_t> runs; // by character
        for (const Frame& frame : frames) {
            if (std::exchange(runs[frame.frame.character], frame.frame.run) != frame.frame.run) {
                samples.push_back(frame.frame.sample);
            }
        }
        return samples;
    }
    /// Every frame of type 02 that was performed, sent at once, in the order given.
    void sendInOrder(const std::vector<std::uint32_t>& samples) {
        performer::Performer performer(settings());
        std::uint32_t place = 0;
        for (const std::uint32_t sample : samples) {
            for (const wire::Datagram& datagram : performer.frame(sample - 1)) {
                if (datagram.header.type() == 2) {
                    send(datagram, kStart + place * 16ms);
                }
            }
            ++place;
        }
        follow();
    }
};

TEST_F(MotionReaderTest, GivesEverySampleAsItWasSent) {
    auto two = settings(2);
    two.fingers = true;
    two.props = 2;
    perform(two, 150);
    for (std::size_t character : {0U, 1U}) {
        const auto frames = framesOf(source(), character);
        ASSERT_EQ(frames.size(), 150U);
        for (const Frame& frame : frames) {
            const auto id = static_cast<std::uint8_t>(source().characters[character].key.character);
            EXPECT_LT(differenceOf(frame.pose.segments, sent(id, frame.frame.sample)), kPrecision);
        }
        EXPECT_THAT(gapsOf(frames), IsEmpty());
        EXPECT_NEAR(frames.back().frame.seconds, 149.0 / 60, 1e-4);
    }
}

TEST_F(MotionReaderTest, MarksSamplesThatAreMissing) {
    perform(settings(), 100, without({30, 31, 32, 70}));
    const auto frames = framesOf(source());
    EXPECT_EQ(frames.size(), 100U);
    EXPECT_THAT(gapsOf(frames), ElementsAre(30, 31, 32, 70));
    EXPECT_NEAR(frames[30].frame.seconds, 30.0 / 60, 1e-4); // sample 31
    EXPECT_THAT(runsOf(frames), ElementsAre(1));
}

TEST_F(MotionReaderTest, PutsSamplesInOrderEachOnce) {
    sendInOrder({1, 2, 4, 3, 5, 5, 8, 7, 6, 2, 9, 10});
    EXPECT_THAT(samplesOf(framesOf(source())), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10));
}

TEST_F(MotionReaderTest, KnowsTheStepOfAStreamThatIsThinnedOut) {
    perform(settings(1, 240), 400, [](const wire::Datagram& datagram) {
        return datagram.header.type() != 2 ||
               (datagram.header.sampleCounter % 4 == 1 && datagram.header.sampleCounter != 41);
    });
    const auto survey = surveyMotion(source(), feed::PoseContent::Segments, {});
    EXPECT_EQ(survey->characters[0].step, 4U);
    EXPECT_EQ(survey->characters[0].rateHz, 60.0);
    EXPECT_EQ(survey->characters[0].frames, 100U);
    EXPECT_THAT(gapsOf(framesOf(source())), ElementsAre(41));
}

TEST_F(MotionReaderTest, BeginsANewRunWhereCountersAreSetBack) {
    perform(settings(), 200);
    perform(settings(), 50, sendsAll, kStart + 5s);
    const auto frames = framesOf(source());
    EXPECT_EQ(frames.size(), 250U);
    EXPECT_THAT(gapsOf(frames), IsEmpty());
    EXPECT_THAT(runsOf(frames), ElementsAre(1, 1));
    EXPECT_EQ(frames[199].frame.run, 1U);
    EXPECT_EQ(frames[200].frame.run, 2U);
    EXPECT_NEAR(frames[200].frame.seconds, 5.0, 1e-3); // the pause is kept
}

TEST_F(MotionReaderTest, FollowsACharacterThroughARestartOfItsSender) {
    perform(settings(), 60);
    perform(settings(), 60, sendsAll, kStart + 4s, "127.0.0.1:40777");
    const feed::PoseSource one = source();
    ASSERT_EQ(one.characters.size(), 1U);
    EXPECT_EQ(one.characters[0].parts.size(), 2U);
    const auto frames = framesOf(one);
    EXPECT_EQ(frames.size(), 120U);
    EXPECT_EQ(frames[59].frame.run, 1U);
    EXPECT_EQ(frames[60].frame.run, 2U);
}

TEST_F(MotionReaderTest, BelievesNoSingleCounterThatJumps) {
    perform(settings(), 40);
    performer::Performer performer(settings());
    wire::Datagram strange = performer.frame(1).front();
    strange.header.sampleCounter = 0x70000000;
    send(strange, kStart + 1s);
    follow();
    auto later = settings();
    later.firstSample = 41;
    perform(later, 40, sendsAll, kStart + 1s);
    const auto frames = framesOf(source());
    EXPECT_EQ(frames.size(), 80U);
    EXPECT_THAT(runsOf(frames), ElementsAre(1));
}

TEST_F(MotionReaderTest, JoinsSamplesThatComeInSeveralDatagrams) {
    auto fingers = settings();
    fingers.fingers = true;
    performer::Performer performer(fingers);
    std::vector<std::vector<model::SegmentPose>> whole;
    for (std::uint64_t frame = 0; frame < 30; ++frame) {
        for (const wire::Datagram& datagram : performer.frame(frame)) {
            const auto* message = std::get_if<wire::PoseQuaternion>(&datagram.body);
            if (message == nullptr) {
                continue;
            }
            wire::Datagram first = datagram;
            wire::Datagram second = datagram;
            wire::keepItems(first.body, 0, 40);
            wire::keepItems(second.body, 40, message->segments.size());
            first.header.datagramCounter = 0;
            second.header.datagramCounter = 0x81;
            for (wire::Datagram* part : {&first, &second}) {
                wire::completeHeader(*part, wire::HeaderEra::Counted);
            }
            if (frame % 2 == 0) {
                std::swap(first, second);
            }
            send(first, kStart + frame * 16ms);
            if (frame != 20) {
                send(second, kStart + frame * 16ms);
            }
            std::vector<model::SegmentPose>& poses = whole.emplace_back();
            for (const auto& item : message->segments) {
                poses.push_back(model::poseFromQuaternion(item));
            }
        }
    }
    follow();
    const auto frames = framesOf(source());
    ASSERT_EQ(frames.size(), 30U);
    EXPECT_THAT(gapsOf(frames), ElementsAre(21));
    EXPECT_LT(differenceOf(frames[7].pose.segments, whole[7]), kPrecision);
    EXPECT_LT(differenceOf(frames[8].pose.segments, whole[8]), kPrecision);
}

TEST_F(MotionReaderTest, TakesNoSampleOfMorePartsThanAMessageHas) {
    auto fingers = settings();
    fingers.fingers = true;
    performer::Performer performer(fingers);
    for (std::uint64_t frame = 0; frame < 20; ++frame) {
        for (wire::Datagram datagram : performer.frame(frame)) {
            if (datagram.header.type() == 2) {
                for (const int part : {0, 1, 2, 3, 0x84}) { // 10 KB
                    datagram.header.datagramCounter = static_cast<std::uint8_t>(part);
                    send(datagram, kStart + frame * 16ms);
                }
            }
        }
    }
    follow();
    EXPECT_THAT(framesOf(source()), IsEmpty());
}

TEST_F(MotionReaderTest, KeepsItsSamplesAmongCountersThatMeanNothing) {
    perform(settings(), 60);
    wire::Datagram datagram = performer::Performer(settings()).frame(1).front();
    for (std::uint32_t i = 0; i < 20'000; ++i) {
        datagram.header.sampleCounter = i * 2'654'435'761U;
        send(datagram, kStart + 1s);
    }
    follow();
    const auto frames = framesOf(source());
    for (std::uint32_t sample = 1; sample <= 60; ++sample) {
        EXPECT_TRUE(std::ranges::any_of(frames, [&](const Frame& frame) {
            return frame.frame.sample == sample && !frame.frame.isGap();
        })) << sample;
    }
}

TEST_F(MotionReaderTest, PrefersTypesAsTheViewportDoes) {
    auto all = settings();
    all.types = {1, 2, 5, 12, 13};
    perform(all, 120, [](const wire::Datagram& datagram) {
        return datagram.header.type() != 2 || datagram.header.sampleCounter <= 60;
    });
    const auto frames = framesOf(source());
    EXPECT_EQ(frames[0].pose.type, 2);
    EXPECT_EQ(frames[59].pose.type, 2);
    EXPECT_EQ(frames.back().pose.type, 1); // a quarter of a second after the last of type 02
    EXPECT_EQ(frames.back().frame.sample, 120U);
    EXPECT_LT(differenceOf(frames[59].pose.segments, sent(0, 60)), kPrecision);
}

TEST_F(MotionReaderTest, ReadsTheRangeThatIsAskedFor) {
    perform(settings(), 120);
    const auto frames = framesOf(source({kStart + 500ms, kStart + 1s}));
    EXPECT_EQ(frames.front().frame.sample, 31U);
    EXPECT_EQ(frames.back().frame.sample, 60U);
}

TEST_F(MotionReaderTest, ReadsMarkersWithTheirIds) {
    auto points = settings();
    points.types = {2, 3, 12, 13};
    perform(points, 30);
    const auto survey = surveyMotion(source(), feed::PoseContent::Markers, {});
    EXPECT_EQ(survey->characters[0].frames, 30U);
    EXPECT_EQ(survey->characters[0].markerIds.size(), static_cast<std::size_t>(model::kMarkerCount));
    std::size_t seen = 0;
    const auto read = readMotion(source(), feed::PoseContent::Markers, *survey,
                                 [&](const MotionFrame& frame) {
                                     for (const feed::Marker& marker : frame.markers) {
                                         ++seen;
                                         EXPECT_GT(marker.position.z(), -0.1);
                                         EXPECT_LT(marker.position.z(), 2.3);
                                     }
                                 },
                                 {});
    EXPECT_TRUE(read);
    EXPECT_EQ(seen, 30U * model::kMarkerCount);
}

TEST_F(MotionReaderTest, StopsWhereItIsCancelled) {
    perform(settings(), 6'000);
    const auto survey =
        surveyMotion(source(), feed::PoseContent::Segments, [](double share) { return share < 0.3; });
    ASSERT_FALSE(survey);
    EXPECT_EQ(survey.error().kind, log::FileError::Kind::Cancelled);
}

TEST_F(MotionReaderTest, TellsAnIrregularStreamWithoutGaps) {
    perform(settings(1, 240), 600, [](const wire::Datagram& datagram) {
        constexpr std::uint32_t steps[]{0, 2, 6, 9}; // of 10: differences 2, 4, 3, 1
        return datagram.header.type() != 2 ||
               std::ranges::find(steps, datagram.header.sampleCounter % 10) != std::end(steps);
    });
    const auto survey = surveyMotion(source(), feed::PoseContent::Segments, {});
    EXPECT_EQ(survey->characters[0].step, 0U);
    EXPECT_EQ(survey->characters[0].gaps, 0U);
    EXPECT_NEAR(survey->characters[0].rateHz, 96, 1);
}

} // namespace
} // namespace posewire::exporting
