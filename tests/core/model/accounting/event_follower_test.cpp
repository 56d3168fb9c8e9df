// SPDX-License-Identifier: MIT
#include "tests/core/model/accounting/events_fixture.h"

/// At which bounds what comes, and what does not, becomes an event.
namespace posewire::model {
namespace {

class EventBounds : public EventsTest {
protected:
    /// Nothing more comes: time passes by this much after the newest packet.
    void waitFor(log::Duration time) {
        follow();
        m_session.follow(m_now + time);
    }
    /// Another character of the same sender.
    void poseOfOther(std::uint32_t sample, std::uint8_t character = 1) {
        wire::Datagram datagram{{}, standingAt(0), {}};
        datagram.header.sampleCounter = sample;
        datagram.header.character = character;
        datagram.header.timeCode = static_cast<std::uint32_t>(m_at.time_since_epoch() / 1ms);
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), m_at);
    }
};

TEST_F(EventBounds, ASenderIsDownAfterMoreThanASecond) {
    poses(1, 100);
    waitFor(1s);
    EXPECT_TRUE(of(EventKind::SenderDown).empty());
    waitFor(1s + 100ms);
    const auto down = of(EventKind::SenderDown);
    ASSERT_EQ(down.size(), 1U);
    EXPECT_EQ(down[0].firstStamp, m_now + 1s) << "not when it was found out";
}

TEST_F(EventBounds, ASenderThatOnlyRepeatsItsNamesIsDown) {
    poses(1, 100);
    for (int i = 0; i < 30; ++i, m_at += 100ms) {
        send(wire::MetaData{true, "name:Ana\n"}, 0, m_at);
    }
    EXPECT_EQ(of(EventKind::SenderDown).size(), 1U);
    EXPECT_TRUE(of(EventKind::Stale).empty());
}

TEST_F(EventBounds, ACharacterIsStaleWhileItsSenderSendsAnother) {
    for (std::uint32_t sample = 1; sample <= 100; ++sample, m_at += 10ms) {
        pose(sample);
        poseOfOther(sample);
    }
    const log::Stamp last = m_at - 10ms;
    poses(101, 400);
    auto stale = of(EventKind::Stale);
    ASSERT_EQ(stale.size(), 1U);
    EXPECT_EQ(stale[0].character, 1);
    EXPECT_EQ(stale[0].firstStamp, last + 1s);
    EXPECT_TRUE(stale[0].isCurrent);
    EXPECT_EQ(stale[0].text(), "No pose for 1 s, though the source sends.");
    EXPECT_TRUE(of(EventKind::SenderDown).empty());
    EXPECT_EQ(m_session.conditionOf({sender(), 1}).level, Condition::Level::Error) << "by its age";
    EXPECT_EQ(m_session.conditionOf(key()).level, Condition::Level::Good);
    for (std::uint32_t sample = 401; sample <= 500; ++sample, m_at += 10ms) {
        pose(sample);
        poseOfOther(sample);
    }
    stale = of(EventKind::Stale);
    ASSERT_EQ(stale.size(), 1U);
    EXPECT_FALSE(stale[0].isCurrent);
}

TEST_F(EventBounds, TenSamplesLostInARowAreABurst) {
    poses(1, 100);
    m_at += 90ms;
    poses(110, 200); // nine
    m_at += 100ms;
    poses(211, 300); // ten
    const auto gaps = of(EventKind::Gap);
    const auto bursts = of(EventKind::Burst);
    ASSERT_EQ(gaps.size(), 1U);
    ASSERT_EQ(bursts.size(), 1U);
    EXPECT_EQ(gaps[0].samples, 9U);
    EXPECT_EQ(bursts[0].samples, 10U);
    EXPECT_EQ(gaps[0].severity(), EventSeverity::Warning);
    EXPECT_EQ(bursts[0].severity(), EventSeverity::Error);
}

TEST_F(EventBounds, AGapThatIsFilledInTimeIsNone) {
    poses(1, 100);
    m_at += 10ms;
    pose(102);
    pose(101);
    m_at += 10ms;
    poses(103, 300);
    EXPECT_TRUE(of(EventKind::Gap).empty());
}

TEST_F(EventBounds, ATimeCodeJumpsByMoreThanHalfASecond) {
    for (const auto& [off, jumps] :
         {std::pair<log::Duration, bool>{500ms, false}, {501ms, true}, {-500ms, false}, {-501ms, true}}) {
        SCOPED_TRACE(off.count());
        log::PacketLog log;
        Session session(log);
        const log::SenderId sender = log.senders().intern({"10.0.0.1:1", log::Transport::Udp, 9763});
        for (std::uint32_t i = 0; i < 200; ++i) {
            const log::Stamp stamp = at(100s + i * 10ms);
            wire::Datagram datagram{{}, standingAt(0), {}};
            datagram.header.sampleCounter = i;
            const log::Duration shown = stamp.time_since_epoch() + (i >= 100 ? off : log::Duration());
            datagram.header.timeCode = static_cast<std::uint32_t>(shown / 1ms);
            wire::completeHeader(datagram, wire::HeaderEra::Counted);
            log.writer().append(*wire::encode(datagram), {.stamp = stamp, .sender = sender});
        }
        log.writer().publish();
        session.follow(at(102s));
        const auto count = std::ranges::count(session.events().all(), EventKind::TimeCodeJump, &Event::kind);
        EXPECT_EQ(count, jumps ? 1 : 0);
    }
}

TEST_F(EventBounds, AFrozenTimeCodeIsNoJump) {
    for (std::uint32_t sample = 1; sample <= 300; ++sample, m_at += 10ms) {
        m_timeCodeOff = 100s - m_at.time_since_epoch(); // always the same
        pose(sample);
    }
    EXPECT_TRUE(of(EventKind::TimeCodeJump).empty());
}

TEST_F(EventBounds, ATimeCodeMayJumpWhereTheCounterRestarts) {
    poses(50'000, 50'100);
    m_timeCodeOff = -3'600s;
    m_at += 3'600s;
    poses(1, 200);
    EXPECT_TRUE(of(EventKind::TimeCodeJump).empty());
    EXPECT_EQ(of(EventKind::Restart).size(), 1U);
}

TEST_F(EventBounds, TwoSendersConflictWhereOneComesBackWithinASecond) {
    for (const bool isWithin : {false, true}) {
        SCOPED_TRACE(isWithin);
        poses(1, 1);
        m_at += 500ms;
        pose(1, "127.0.0.1:40002");
        m_at += isWithin ? 400ms : 520ms;
        pose(2);
        EXPECT_EQ(of(EventKind::CharacterConflict).size(), isWithin ? 1U : 0U);
        m_at += 10s;
    }
    const Event conflict = of(EventKind::CharacterConflict).front();
    EXPECT_EQ(conflict.character, 0);
    EXPECT_EQ(conflict.sender, std::min(sender(), sender("127.0.0.1:40002")));
    EXPECT_EQ(conflict.text(), "Two sources send character 0 at the same time.");
}

TEST_F(EventBounds, TwoSendersMaySendDifferentCharactersOrTypes) {
    for (std::uint32_t sample = 1; sample <= 100; ++sample, m_at += 10ms) {
        pose(sample);
        wire::Datagram datagram{{}, wire::CentreOfMass{}, {}};
        datagram.header.sampleCounter = sample;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), m_at, "127.0.0.1:40002");
        datagram = {{}, standingAt(0), {}};
        datagram.header.sampleCounter = sample;
        datagram.header.character = 1;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), m_at, "127.0.0.1:40003");
    }
    EXPECT_TRUE(of(EventKind::CharacterConflict).empty());
}

TEST_F(EventBounds, DropsAreAddedUpInTheirEpisode) {
    wire::Datagram datagram{{}, standingAt(0), {}};
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    for (const std::uint32_t drops : {0U, 3U, 0U, 4U}) {
        log::Arrival arrival;
        arrival.stamp = m_now = m_at += 1s;
        arrival.sender = sender();
        arrival.kernelDropsBefore = drops;
        ++datagram.header.sampleCounter;
        m_log.writer().append(*wire::encode(datagram), arrival);
        m_log.writer().publish();
    }
    const auto dropped = of(EventKind::Dropped);
    ASSERT_EQ(dropped.size(), 1U);
    EXPECT_EQ(dropped[0].count, 2U);
    EXPECT_EQ(dropped[0].samples, 7U);
    EXPECT_EQ(m_session.find(sender())->kernelDrops, 7U);
}

TEST_F(EventBounds, AnotherBodyIsAScaleChangeAndTheSameOneIsNot) {
    const auto nullPoseOf = [](double scale) {
        wire::NullPose body;
        for (const Eigen::Vector3d& origin : referenceOrigins()) {
            body.segments.push_back(
                {"Segment " + std::to_string(body.segments.size()), toFloats(scale * origin)});
        }
        return body;
    };
    send(nullPoseOf(1), 0, m_at);
    send(nullPoseOf(1), 0, m_at + 5s);
    EXPECT_TRUE(of(EventKind::ScaleChange).empty());
    send(nullPoseOf(1.1), 0, m_at + 10s);
    const auto changes = of(EventKind::ScaleChange);
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_EQ(changes[0].character, 0);
    EXPECT_EQ(changes[0].text(), "The null pose changed.");
    EXPECT_EQ(changes[0].severity(), EventSeverity::Info);
}

TEST_F(EventBounds, TroublesAreSortedWorstFirstAndLimitsLastOfTheirLike) {
    poses(1, 1'000);
    m_at += 400ms;
    poses(1'041, 1'100); // a burst, and beyond the limits of gap and loss
    sendBytes(std::as_bytes(std::span("{\"a\":1}")), m_at);
    m_at += 10ms;
    poses(1'101, 1'150);
    follow();
    const auto troubles = m_session.troublesOf(key());
    ASSERT_GE(troubles.size(), 3U);
    EXPECT_EQ(troubles.front()->kind, EventKind::Burst);
    EXPECT_EQ(m_session.conditionOf(key()).event, troubles.front()->number);
    EXPECT_EQ(m_session.conditionOf(key()).reason, troubles.front()->text());
    for (std::size_t i = 1; i < troubles.size(); ++i) {
        EXPECT_GE(troubles[i - 1]->severity(), troubles[i]->severity());
        if (troubles[i - 1]->severity() == troubles[i]->severity()) {
            EXPECT_LE(troubles[i - 1]->group() == EventGroup::Limit,
                      troubles[i]->group() == EventGroup::Limit);
        }
        EXPECT_NE(troubles[i]->severity(), EventSeverity::Info);
    }
    EXPECT_TRUE(std::ranges::any_of(troubles, [](const Event* event) {
        return event->kind == EventKind::Foreign;
    })) << "what is of the sender concerns its characters";
    EXPECT_TRUE(m_session.troublesOf({sender("10.0.0.9:1"), 0}).empty());
}

} // namespace
} // namespace posewire::model
