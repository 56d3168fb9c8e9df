// SPDX-License-Identifier: MIT
#include "tests/core/model/accounting/events_fixture.h"

namespace posewire::model {
namespace {

TEST_F(EventsTest, TellThatASenderComesAndGoes) {
    poses(1, 100);
    ASSERT_EQ(of(EventKind::SenderUp).size(), 1U);
    m_session.follow(m_at + 3s); // nothing more comes
    auto down = of(EventKind::SenderDown);
    ASSERT_EQ(down.size(), 1U);
    EXPECT_TRUE(down[0].isCurrent);
    EXPECT_EQ(down[0].severity(), EventSeverity::Error);
    EXPECT_EQ(m_session.conditionOf(key()).level, Condition::Level::Error);
    m_at += 4s;
    poses(101, 200);
    down = of(EventKind::SenderDown);
    ASSERT_EQ(down.size(), 1U);
    EXPECT_FALSE(down[0].isCurrent);
}

TEST_F(EventsTest, SayNothingOfSilenceAfterTheEndOfAFile) {
    poses(1, 100);
    while (m_session.followFile(m_at)) {
    }
    m_session.endFile();
    m_session.follow(m_at + 3s);
    EXPECT_TRUE(of(EventKind::SenderDown).empty());
    // Nor where another sender is live.
    pose(1, "127.0.0.1:40002");
    m_session.follow(m_at);
    m_session.follow(m_at + 3s);
    const auto down = of(EventKind::SenderDown);
    ASSERT_EQ(down.size(), 1U);
    EXPECT_EQ(down[0].sender, sender("127.0.0.1:40002"));
    EXPECT_TRUE(of(EventKind::Stale).empty());
    EXPECT_EQ(down[0].text(), "No data for 1 s.");
}

TEST_F(EventsTest, JudgeACharacterWhereTheCursorStands) {
    poses(1, 300);
    poses(311, 400); // ten lost
    poses(401, 1'000);
    follow();
    m_session.follow(m_at + 3s); // nothing more comes
    const auto levelAt = [this](std::uint64_t packet) {
        m_session.setCursor({Cursor::Mode::Paused, packet});
        return m_session.conditionOf(key()).level;
    };
    EXPECT_EQ(levelAt(200), Condition::Level::Good);
    EXPECT_NE(levelAt(350), Condition::Level::Good);
    EXPECT_EQ(levelAt(989), Condition::Level::Good) << "the last packet, before the silence";
    m_session.setCursor({});
    EXPECT_EQ(m_session.conditionOf(key()).level, Condition::Level::Error);
}

TEST_F(EventsTest, CountTheGapsOfAnEpisodeInOne) {
    for (std::uint32_t sample = 1; sample <= 500; ++sample, m_at += 10ms) {
        if (sample % 50 != 0) {
            pose(sample);
        }
    }
    const auto gaps = of(EventKind::Gap);
    ASSERT_EQ(gaps.size(), 1U);
    EXPECT_EQ(gaps[0].count, 9U);
    EXPECT_EQ(gaps[0].samples, 9U);
    EXPECT_EQ(gaps[0].cause, LossCause::Unknown);
    EXPECT_TRUE(gaps[0].text().starts_with("9 samples lost in 9 gaps, cause: unknown.")) << gaps[0].text();
    EXPECT_TRUE(gaps[0].isCurrent);
    const std::uint64_t version = m_session.events().version();
    poses(501, 1'200);
    EXPECT_FALSE(of(EventKind::Gap)[0].isCurrent);
    EXPECT_GT(m_session.events().version(), version);
}

TEST_F(EventsTest, TellRestartsMalformedAndForeignDatagrams) {
    poses(50'000, 50'100);
    poses(1, 50);
    sendBytes(std::as_bytes(std::span("MXTP02")), m_at);
    sendBytes(std::as_bytes(std::span("{\"a\":1}")), m_at);
    sendBytes(std::as_bytes(std::span("{\"a\":2}")), m_at);
    EXPECT_EQ(of(EventKind::Restart).size(), 1U);
    EXPECT_EQ(of(EventKind::Malformed).size(), 1U);
    ASSERT_EQ(of(EventKind::Foreign).size(), 1U);
    EXPECT_EQ(of(EventKind::Foreign)[0].count, 2U);
    EXPECT_TRUE(of(EventKind::TimeCodeJump).empty());
}

TEST_F(EventsTest, CountOneRestartOfAllStreamsOnce) {
    const auto both = [this](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t sample = first; sample <= last; ++sample, m_at += 10ms) {
            pose(sample);
            send(wire::CentreOfMass{}, sample, m_at);
        }
    };
    both(50'000, 50'100);
    both(1, 150);
    ASSERT_EQ(of(EventKind::Restart).size(), 1U);
    EXPECT_EQ(of(EventKind::Restart)[0].count, 1U);
    both(50'000, 50'100);
    EXPECT_EQ(of(EventKind::Restart).back().count + of(EventKind::Restart).size(), 3U)
        << "another one is told, as an event of its own or in the same episode";
}

TEST_F(EventsTest, TellChangesOfMetadataButNotItsRepetition) {
    poses(1, 10);
    send(wire::MetaData{true, "name:Anna\n"}, 0, m_at);
    send(wire::MetaData{true, "name:Anna\n"}, 0, m_at);
    EXPECT_TRUE(of(EventKind::MetadataChange).empty());
    send(wire::MetaData{true, "name:Berta\n"}, 0, m_at);
    ASSERT_EQ(of(EventKind::MetadataChange).size(), 1U);
    EXPECT_EQ(of(EventKind::MetadataChange)[0].text(), "name: Anna → Berta");
}

TEST_F(EventsTest, TellAJumpOfTheTimeCode) {
    poses(1, 100);
    m_timeCodeOff = 5s;
    poses(101, 200);
    ASSERT_EQ(of(EventKind::TimeCodeJump).size(), 1U);
    EXPECT_EQ(of(EventKind::TimeCodeJump)[0].text(), "The time code jumped by 5000 ms.");
}

TEST_F(EventsTest, TakeNoDatagramThatComesLateForAJumpOfTheTimeCode) {
    poses(1, 99);
    const log::Stamp due = m_at;
    m_at += 10ms;
    poses(101, 400);
    m_timeCodeOff = due - m_at; // sample 100 was sent when it was due
    pose(100);
    m_timeCodeOff = 0s;
    poses(401, 500);
    EXPECT_TRUE(of(EventKind::TimeCodeJump).empty());
    EXPECT_TRUE(of(EventKind::Restart).empty());
}

TEST_F(EventsTest, TellTwoSendersWithOneCharacterButNotASuccessor) {
    poses(1, 50);
    for (std::uint32_t sample = 1; sample <= 50; ++sample, m_at += 10ms) {
        pose(sample, "127.0.0.1:40002"); // the same person from another port
    }
    EXPECT_TRUE(of(EventKind::CharacterConflict).empty());
    for (std::uint32_t sample = 51; sample <= 100; ++sample, m_at += 10ms) {
        pose(sample, "127.0.0.1:40002");
        pose(sample, "127.0.0.1:40003");
    }
    ASSERT_EQ(of(EventKind::CharacterConflict).size(), 1U);
    EXPECT_EQ(of(EventKind::CharacterConflict)[0].severity(), EventSeverity::Error);
}

TEST_F(EventsTest, AlertOncePerEpisodeWithHysteresis) {
    poses(1, 1'000);
    EXPECT_TRUE(of(EventKind::LossLimit).empty());
    EXPECT_EQ(m_session.conditionOf(key()).level, Condition::Level::Good);
    for (std::uint32_t sample = 1'001; sample <= 2'000; ++sample, m_at += 10ms) {
        if (sample % 20 != 0) {
            pose(sample);
        }
    }
    auto alerts = of(EventKind::LossLimit);
    ASSERT_EQ(alerts.size(), 1U);
    EXPECT_EQ(alerts[0].count, 1U);
    EXPECT_NEAR(alerts[0].value, 5, 0.5);
    EXPECT_NE(m_session.conditionOf(key()).level, Condition::Level::Good);
    poses(2'001, 4'000);
    alerts = of(EventKind::LossLimit);
    ASSERT_EQ(alerts.size(), 1U);
    EXPECT_FALSE(alerts[0].isCurrent);
    EXPECT_EQ(m_session.conditionOf(key()).level, Condition::Level::Good);
}

TEST_F(EventsTest, AlertOnARateThatFallsByHalf) {
    poses(1, 1'500);
    for (std::uint32_t sample = 1'502; sample <= 3'000; sample += 2, m_at += 20ms) {
        pose(sample);
    }
    EXPECT_EQ(of(EventKind::RateLimit).size(), 1U);
}

TEST(EventList, IsBoundedAndForgetsEndedOnesFirst) {
    Events events;
    Event lasting;
    lasting.kind = EventKind::SenderDown;
    events.report(lasting);
    for (std::uint32_t i = 0; i < 12'000; ++i) {
        Event event;
        event.kind = EventKind::Gap;
        event.sender = static_cast<log::SenderId>(i);
        events.report(event);
        events.end(event, log::Stamp(log::Duration(i)));
    }
    EXPECT_EQ(events.all().size(), Events::kMost);
    EXPECT_EQ(events.all().front().kind, EventKind::SenderDown);
    EXPECT_TRUE(events.isCurrent(lasting));
}

} // namespace
} // namespace posewire::model
