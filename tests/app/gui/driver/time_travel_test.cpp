// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/session_driver.h"
#include "core/log/output_file.h"
#include "core/log/pcapng_writer.h"
#include "core/model/session/roster.h"
#include "tests/app/gui/models/stage.h"
#include "tests/support/manual_clock.h"

#include <QSignalSpy>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include <thread>

namespace posewire::gui {
namespace {

constexpr std::uint64_t kPackets = 600; ///< a sample each, 60 a second

class TimeTravelTest : public testing::Test {
protected:
    static constexpr log::Duration kApart = 30us; ///< of characters in one sample

    explicit TimeTravelTest(std::uint8_t characters = 1) : m_characters(characters) {}
    void SetUp() override {
        const std::string path = m_folder.filePath("take.pcapng").toStdString();
        auto sink = log::createFile(path).value();
        log::PcapngWriter writer(*sink);
        ASSERT_TRUE(writer.begin({}));
        for (std::uint32_t sample = 0; sample < kPackets; ++sample) {
            for (std::uint8_t character = 0; character < m_characters; ++character) {
                wire::Datagram datagram;
                datagram.body = smallPose();
                datagram.header.sampleCounter = sample;
                datagram.header.character = character;
                wire::completeHeader(datagram, wire::HeaderEra::Counted);
                const auto bytes = wire::encode(datagram).value();
                ASSERT_TRUE(writer.add({0, momentOf(sample) + character * kApart, {}, 0, {}, bytes},
                                       {"10.0.0.2:4000", log::Transport::Udp, 9763}));
            }
        }
        ASSERT_TRUE(writer.addStatistics());
        ASSERT_TRUE(sink->flush());
        m_driver.files().open(QString::fromStdString(path));
        for (int i = 0; i < 5000 && m_driver.files().isOpening(); ++i) {
            m_driver.tick();
            std::this_thread::sleep_for(1ms);
        }
        ASSERT_EQ(m_driver.commands().session().end(), m_characters * kPackets);
    }

    static log::Stamp momentOf(std::uint64_t packet) {
        return Stage::kStart + packet * log::Duration(1s) / 60;
    }
    [[nodiscard]] std::uint64_t packet() { return m_driver.commands().session().choices().cursor.packet; }
    [[nodiscard]] model::CharacterKey key() {
        return m_driver.commands().session().roster().characters()[0].key;
    }
    void pass(log::Duration time) {
        m_clock.advance(time);
        m_driver.tick();
    }

    const std::uint8_t m_characters;
    QTemporaryDir m_folder;
    log::ManualClock m_clock{log::asWallTime(Stage::kStart + 1h)};
    SessionDriver m_driver{m_clock};
};

TEST_F(TimeTravelTest, StepsSamplesPacketsAndTime) {
    m_driver.playback().showMoment(momentOf(300));
    EXPECT_EQ(packet(), 300U);
    m_driver.playback().stepSamples(key(), 1);
    EXPECT_EQ(packet(), 301U);
    m_driver.playback().stepSamples(key(), -10);
    EXPECT_EQ(packet(), 291U);
    m_driver.playback().stepTime(1s);
    EXPECT_EQ(packet(), 351U);
    m_driver.playback().stepTime(1ms); // in a silence of 17
    EXPECT_EQ(packet(), 352U);
    m_driver.playback().stepPackets(-1);
    m_driver.playback().stepPackets(-1);
    EXPECT_EQ(packet(), 350U);
    EXPECT_EQ(m_driver.commands().session().choices().selection.packet, 350U)
        << "that packet is what is looked at";
    m_driver.playback().stepTime(-1h);
    EXPECT_EQ(packet(), 0U);
    m_driver.playback().stepSamples(key(), -1);
    EXPECT_EQ(packet(), 0U);
    m_driver.playback().stepTime(1h);
    EXPECT_EQ(packet(), kPackets - 1);
    m_driver.playback().stepPackets(1);
    EXPECT_EQ(packet(), kPackets - 1);
}

TEST_F(TimeTravelTest, PlaysAtASpeedAndStopsAtTheEnd) {
    using Direction = Playback::Direction;
    m_driver.playback().showMoment(momentOf(300));
    m_driver.playback().setSpeed(2);
    m_driver.playback().play(Direction::Forwards);
    EXPECT_TRUE(m_driver.playback().isPlaying(Direction::Forwards));
    pass(1s);
    EXPECT_EQ(packet(), 420U);
    m_driver.playback().setSpeed(0.5);
    pass(1s);
    EXPECT_EQ(packet(), 450U) << "on from where it was";
    pass(1min);
    EXPECT_EQ(packet(), kPackets - 1);
    EXPECT_FALSE(m_driver.playback().isPlaying(Direction::Forwards));
    m_driver.playback().play(Direction::Forwards); // once more
    pass(2s);
    EXPECT_EQ(packet(), 60U);
    m_driver.playback().play(Direction::Forwards);
    pass(2s);
    EXPECT_EQ(packet(), 60U) << "stopped";
}

TEST_F(TimeTravelTest, PlaysBackwardsToTheBeginning) {
    using Direction = Playback::Direction;
    m_driver.playback().showMoment(momentOf(300));
    m_driver.playback().play(Direction::Backwards);
    pass(1s);
    EXPECT_EQ(packet(), 240U);
    pass(1min);
    EXPECT_EQ(packet(), 0U);
    EXPECT_FALSE(m_driver.playback().isPlaying(Direction::Backwards));
}

TEST_F(TimeTravelTest, LoopsTheRangeThatIsSelected) {
    m_driver.commands().selectRange({.fixed = model::TimeRange{momentOf(60), momentOf(120)}});
    m_driver.playback().setLooping(true);
    m_driver.playback().play(Playback::Direction::Forwards);
    pass(500ms);
    EXPECT_EQ(packet(), 90U);
    pass(1s);
    EXPECT_EQ(packet(), 90U) << "once around";
    m_driver.playback().setSpeed(16);
    for (int i = 0; i < 50; ++i) {
        pass(33ms);
        EXPECT_GE(packet(), 60U);
        EXPECT_LE(packet(), 120U);
    }
}

TEST_F(TimeTravelTest, AJumpStopsThereAndOneComesBackToTheMomentBefore) {
    m_driver.playback().showMoment(momentOf(300));
    m_driver.commands().jump(100, "type == 02");
    EXPECT_EQ(packet(), 100U);
    m_driver.commands().goBack();
    EXPECT_EQ(packet(), 300U);
    m_driver.commands().selectPacket(42);
    EXPECT_EQ(packet(), 42U) << "what is looked at is what is shown";
}

TEST_F(TimeTravelTest, SpaceStopsAndPlaysWithoutLosingThePlace) {
    m_driver.playback().showMoment(momentOf(300));
    m_driver.playback().playOrStop();
    pass(1s);
    EXPECT_EQ(packet(), 360U);
    m_driver.playback().playOrStop();
    pass(1s);
    EXPECT_EQ(packet(), 360U);
    EXPECT_TRUE(m_driver.playback().isPaused());
}

TEST_F(TimeTravelTest, BackAndForwardKnowEveryJump) {
    m_driver.playback().showMoment(momentOf(300));
    m_driver.playback().goToFirst();
    EXPECT_EQ(packet(), 0U);
    m_driver.playback().goToLast();
    EXPECT_EQ(packet(), kPackets - 1);
    m_driver.commands().jump(100, "type == 02");
    Commands& commands = m_driver.commands();
    const auto filter = [&] { return commands.session().choices().displayFilter; };
    EXPECT_TRUE(commands.goBack());
    EXPECT_EQ(packet(), kPackets - 1);
    EXPECT_EQ(filter(), "");
    EXPECT_TRUE(commands.goBack());
    EXPECT_EQ(packet(), 0U);
    EXPECT_TRUE(commands.goForward());
    EXPECT_TRUE(commands.goForward());
    EXPECT_EQ(packet(), 100U);
    EXPECT_EQ(filter(), "type == 02");
    EXPECT_EQ(commands.session().choices().ownFilter(), "");
    EXPECT_FALSE(commands.goForward());
}

TEST_F(TimeTravelTest, ARangeBeginsAndEndsWithTheSampleThatIsShown) {
    m_driver.playback().showMoment(momentOf(60));
    m_driver.playback().setRangeEdge(false);
    m_driver.playback().showMoment(momentOf(120));
    m_driver.playback().setRangeEdge(true);
    const auto range = m_driver.commands().session().range();
    ASSERT_TRUE(range);
    EXPECT_EQ(m_driver.commands().session().packetFrom(range->from), 60U);
    EXPECT_EQ(m_driver.commands().session().packetFrom(range->to), 121U);
    m_driver.playback().showMoment(momentOf(30));
    m_driver.playback().setRangeEdge(true); // before its beginning
    EXPECT_EQ(m_driver.commands().session().packetFrom(m_driver.commands().session().range()->from), 0U);
}

TEST_F(TimeTravelTest, ARangeThatIsBegunEndsWithTheNewestPacket) {
    const model::SessionView& session = m_driver.commands().session();
    m_driver.playback().showMoment(momentOf(60));
    m_driver.playback().setRangeEdge(false);
    EXPECT_EQ(session.range()->to, session.packet(session.end() - 1)->stamp + log::Duration(1));
}

TEST_F(TimeTravelTest, TheEdgeThatWasSetLastIsTrimmedBySamples) {
    Playback& playback = m_driver.playback();
    const auto first = [&] {
        return m_driver.commands().session().packetFrom(m_driver.commands().session().range()->from);
    };
    const auto after = [&] {
        return m_driver.commands().session().packetFrom(m_driver.commands().session().range()->to);
    };
    playback.trimRange(key(), 1);
    EXPECT_FALSE(m_driver.commands().session().range()) << "nothing to trim";
    playback.showMoment(momentOf(60));
    playback.setRangeEdge(false);
    playback.showMoment(momentOf(120));
    playback.setRangeEdge(true);
    playback.showMoment(momentOf(10));
    playback.trimRange(key(), -1);
    EXPECT_EQ(first(), 60U);
    EXPECT_EQ(after(), 120U);
    EXPECT_EQ(packet(), 119U) << "the last sample of the range is shown";
    playback.trimRange(key(), -100);
    EXPECT_EQ(first(), 60U);
    EXPECT_EQ(after(), 120U) << "an end is not moved before the beginning";
    playback.showMoment(momentOf(61));
    playback.setRangeEdge(false);
    playback.trimRange(key(), 2);
    EXPECT_EQ(first(), 63U);
    EXPECT_EQ(after(), 120U);
}

class TripleTravelTest : public TimeTravelTest {
protected:
    TripleTravelTest() : TimeTravelTest(3) {}
};

TEST_F(TripleTravelTest, AnEdgeIsTrimmedByWholeSamplesWhoeverIsSelected) {
    Playback& playback = m_driver.playback();
    const model::SessionView& session = m_driver.commands().session();
    for (const model::Character& one : session.roster().characters()) {
        playback.showMoment(momentOf(60) + 2 * kApart);
        playback.setRangeEdge(false);
        EXPECT_EQ(session.packetFrom(session.range()->from), 3U * 60);
        for (const int step : {1, 1, 1, -1, -1, -1, -1, 1}) {
            const auto before = static_cast<int>(session.packetFrom(session.range()->from));
            playback.trimRange(one.key, step);
            EXPECT_EQ(static_cast<int>(session.packetFrom(session.range()->from)), before + 3 * step)
                << int{one.key.character} << " from " << before;
        }
    }
}

TEST_F(TimeTravelTest, AStepLetsGoOfThePacketThatWasHeld) {
    m_driver.commands().selectPacket(42);
    m_driver.playback().stepSamples(key(), 1);
    EXPECT_EQ(packet(), 43U);
    EXPECT_FALSE(m_driver.commands().session().choices().selection.packet);
}

} // namespace
} // namespace posewire::gui
