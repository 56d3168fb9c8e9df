// SPDX-License-Identifier: MIT
#include "core/model/session/roster.h"
#include "tests/core/export/motion/motion_fixture.h"
#include "tests/core/performer/faulty_performance.h"

namespace posewire::exporting {
namespace {

/// What is exported must be what was counted: of the same faulty stream, by other code.
class FaultyMotionTest : public MotionTest, public testing::WithParamInterface<std::uint64_t> {
protected:
    void receive(const performer::PerformerSettings& performance, performer::FaultSettings faults) {
        faults.seed = GetParam();
        for (const performer::Sending& sending : performer::performWithFaults(performance, faults, 12)) {
            log::Arrival arrival;
            arrival.stamp = kStart + sending.due;
            arrival.sender = m_log.senders().intern({"127.0.0.1:40001", log::Transport::Udp, 9763});
            m_log.writer().append(sending.bytes, arrival);
        }
        m_log.writer().publish();
        while (m_session.followFile(kStart + 12s)) {
        }
        m_session.endFile();
    }
    void expectWhatWasCounted() const {
        const feed::PoseSource all = source();
        const auto survey = surveyMotion(all, feed::PoseContent::Segments, {});
        ASSERT_TRUE(survey);
        for (std::size_t i = 0; i < all.characters.size(); ++i) {
            const model::CharacterKey key = all.characters[i].key;
            const model::Stream* stream =
                m_session.roster().find(log::StreamKey{key.sender, key.character, 2});
            ASSERT_NE(stream, nullptr);
            const model::StreamCounts counts = stream->accounting.counts();
            const CharacterSurvey& one = survey->characters[i];
            EXPECT_EQ(one.frames - one.gaps, counts.samples);
            EXPECT_EQ(one.gaps, counts.lost + counts.incomplete);
            EXPECT_EQ(one.restarts, counts.restarts);
            EXPECT_EQ(framesOf(all, i).size(), one.frames);
        }
    }
};

TEST_P(FaultyMotionTest, HasTheGapsThatAreCounted) {
    performer::FaultSettings faults;
    faults.drop = 0.03;
    faults.burst = 3;
    faults.duplicate = 0.02;
    faults.reorder = 0.03;
    faults.jitterMs = 8;
    receive(settings(2, 120), faults);
    expectWhatWasCounted();
}

TEST_P(FaultyMotionTest, HasThemThroughARestart) {
    performer::FaultSettings faults;
    faults.drop = 0.01;
    faults.reorder = 0.01;
    faults.restart = {6.0, 1};
    receive(settings(1, 120), faults);
    expectWhatWasCounted();
}

TEST_P(FaultyMotionTest, HasThemWhereSamplesComeInParts) {
    performer::FaultSettings faults;
    faults.drop = 0.02;
    faults.reorder = 0.02;
    faults.duplicate = 0.02;
    faults.splits = true;
    receive(settings(1, 60), faults);
    expectWhatWasCounted();
}

TEST_P(FaultyMotionTest, TakesNoSampleFromDamagedDatagrams) {
    performer::FaultSettings faults;
    faults.corrupt = 0.05;
    faults.truncate = 0.05;
    receive(settings(1, 120), faults);
    const auto exported = write("csv", source());
    ASSERT_TRUE(exported) << exported.error().text;
    for (const std::size_t character : {0U}) {
        std::uint32_t before = 0;
        for (const Frame& frame : framesOf(source(), character)) {
            EXPECT_GT(frame.frame.sample, before);
            before = frame.frame.sample;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, FaultyMotionTest, testing::Range<std::uint64_t>(1, 7));

} // namespace
} // namespace posewire::exporting
