// SPDX-License-Identifier: MIT
#include "core/log/recording.h"

#include "tests/core/log/log_fixture.h"
#include "tests/core/log/recording_fixture.h"

#include <gmock/gmock.h>

#include <array>
#include <vector>

namespace posewire::log {
namespace {

using namespace std::chrono_literals;

class RecorderTest : public testing::Test {
protected:
    void append(std::uint32_t sample, std::uint32_t drops = 0) {
        const SenderId sender = m_log.senders().intern({"10.0.0.2:40001", Transport::Udp, 9763});
        m_log.writer().append(poseDatagram(sample), {m_stamp, sender, drops, {.stampedByKernel = true}});
        m_log.writer().publish();
        m_stamp += 1ns;
    }
    PacketLog m_log{kSmallLog};
    MemorySink m_sink;
    Stamp m_stamp{1us};
};

TEST_F(RecorderTest, WritesWhatTheLogGetsAndHandsItToTheSystemEachTime) {
    Recorder recorder(m_log, m_sink);
    ASSERT_TRUE(recorder.begin({}));
    EXPECT_EQ(m_sink.flushed, m_sink.bytes.size());
    for (std::uint32_t sample = 0; sample < 10; ++sample) {
        append(sample, sample);
        ASSERT_TRUE(recorder.follow());
        EXPECT_EQ(m_sink.flushed, m_sink.bytes.size());
        const auto seen = recordedIn(m_sink.bytes);
        ASSERT_EQ(seen.size(), sample + 1);
        EXPECT_EQ(seen.back().bytes, poseDatagram(sample));
        EXPECT_EQ(seen.back().stamp, Stamp(1us + Duration(sample)));
        EXPECT_EQ(seen.back().kernelDropsBefore, sample);
    }
    ASSERT_TRUE(recorder.finish());
    EXPECT_EQ(recordedIn(m_sink.bytes).size(), 10U);
    EXPECT_EQ(recorder.figures().packets, 10U);
    EXPECT_EQ(recorder.figures().missed, 0U);
}

TEST_F(RecorderTest, BringsToTheDiskWhatIsNew) {
    Recorder recorder(m_log, m_sink);
    ASSERT_TRUE(recorder.begin({}));
    ASSERT_TRUE(recorder.sync());
    EXPECT_EQ(m_sink.syncs, 0) << "nothing was recorded";
    append(1);
    ASSERT_TRUE(recorder.follow());
    EXPECT_EQ(m_sink.syncs, 0) << "that takes too long for every packet";
    for (int i = 0; i < 2; ++i) {
        ASSERT_TRUE(recorder.sync());
        EXPECT_EQ(m_sink.syncs, 1);
    }
    ASSERT_TRUE(recorder.finish());
    EXPECT_EQ(m_sink.syncs, 2);
}

TEST_F(RecorderTest, HasAheadOfTheFirstPacketWhatCameBeforeIt) {
    for (std::uint32_t sample = 0; sample < 10; ++sample) {
        append(sample);
    }
    Recorder recorder(m_log, m_sink, 7);
    ASSERT_TRUE(recorder.begin({}, std::vector<std::uint64_t>{2, 5, 99}));
    ASSERT_TRUE(recorder.finish());
    const auto seen = recordedIn(m_sink.bytes);
    ASSERT_EQ(seen.size(), 5U);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const std::uint32_t sample = std::array{2U, 5U, 7U, 8U, 9U}.at(i);
        EXPECT_EQ(seen[i].bytes, poseDatagram(sample));
        EXPECT_EQ(seen[i].stamp, Stamp(1us + Duration(sample)));
        EXPECT_EQ(seen[i].flags.isFromBefore, i < 2);
    }
    EXPECT_EQ(recorder.placeOf(8), 3U);
}

TEST_F(RecorderTest, BeginsWithThePacketThatWasAskedFor) {
    for (std::uint32_t sample = 0; sample < 10; ++sample) {
        append(sample);
    }
    Recorder recorder(m_log, m_sink, 7);
    ASSERT_TRUE(recorder.begin({}));
    ASSERT_TRUE(recorder.finish());
    const auto seen = recordedIn(m_sink.bytes);
    ASSERT_EQ(seen.size(), 3U);
    EXPECT_EQ(seen.front().bytes, poseDatagram(7));
}

TEST_F(RecorderTest, TellsOfWhatTheLogDroppedBeforeItCouldBeWritten) {
    Recorder recorder(m_log, m_sink);
    ASSERT_TRUE(recorder.begin({}));
    append(0);
    ASSERT_TRUE(recorder.follow());
    for (std::uint32_t sample = 1; sample < 5000; ++sample) {
        append(sample);
    }
    ASSERT_TRUE(recorder.finish());
    const auto seen = recordedIn(m_sink.bytes);
    ASSERT_GT(seen.size(), 2U);
    EXPECT_GT(recorder.figures().missed, 0U);
    EXPECT_EQ(seen.size() + recorder.figures().missed, 5000U);
    EXPECT_EQ(seen[1].kernelDropsBefore, recorder.figures().missed);
    EXPECT_EQ(seen[2].kernelDropsBefore, 0U);
}

TEST_F(RecorderTest, SaysWhatWentWrong) {
    MemorySink full(1'000);
    Recorder recorder(m_log, full);
    ASSERT_TRUE(recorder.begin({}));
    append(0);
    append(1);
    const auto result = recorder.follow();
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().text, "memory: the disk is full");
}

} // namespace
} // namespace posewire::log
