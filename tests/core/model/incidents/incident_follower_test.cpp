// SPDX-License-Identifier: MIT
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "tests/core/model/incidents/incidents_fixture.h"

/// At which bounds what comes, and what does not, becomes an event.
namespace posewire::model {
namespace {

class IncidentBounds : public IncidentsTest {
protected:
    /// Nothing more comes: time passes by this much after the newest packet.
    void waitFor(log::Duration time) {
        follow();
        m_session.follow(m_now + time);
    }
    /// Another character of the same sender.
    void poseOfOther(std::uint32_t sample, std::uint8_t character = 1) {
        wire::Datagram datagram{{}, swayingAt(0, sample), {}};
        datagram.header.sampleCounter = sample;
        datagram.header.character = character;
        datagram.header.timeCode = static_cast<std::uint32_t>(m_at.time_since_epoch() / 1ms);
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), m_at);
    }
};

TEST_F(IncidentBounds, ADatagramWithoutAReadableTypeIsOfItsCharacterAlone) {
    for (std::uint32_t sample = 1; sample <= 100; ++sample, m_at += 10ms) {
        pose(sample);
        poseOfOther(sample);
    }
    wire::Datagram datagram{{}, standingAt(0), {}};
    datagram.header.character = 1;
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    auto bytes = *wire::encode(datagram);
    bytes[5] = std::byte{0xff}; // "MXTP0?"
    sendBytes(bytes, m_at);
    ASSERT_EQ(of(IncidentKind::Malformed).size(), 1U);
    EXPECT_EQ(of(IncidentKind::Malformed)[0].characters().at(0).character, 1);
    sendBytes(std::span(bytes).first(20), m_at);
    EXPECT_FALSE(of(IncidentKind::Malformed)[0].character()) << "too short to say whose it is";
}

TEST_F(IncidentBounds, ASenderIsSilentAfterAFifthOfASecond) {
    poses(1, 100);
    const log::Stamp last = m_at - 10ms;
    waitFor(200ms);
    EXPECT_TRUE(of(IncidentKind::Outage).empty());
    waitFor(225ms);
    auto outages = of(IncidentKind::Outage);
    ASSERT_EQ(outages.size(), 1U);
    EXPECT_EQ(outages[0].firstStamp, last) << "not when it was found out";
    EXPECT_EQ(outages[0].severity(), IncidentSeverity::Warning);
    waitFor(1s + 25ms);
    outages = of(IncidentKind::Outage);
    ASSERT_EQ(outages.size(), 1U);
    EXPECT_EQ(outages[0].severity(), IncidentSeverity::Error);
}

TEST_F(IncidentBounds, EverySilenceCountsWhoeverLooked) {
    constexpr std::uint64_t silences = 12;
    std::uint32_t sample = 1;
    for (std::uint64_t i = 0; i < silences; ++i, sample += 40) {
        poses(sample, sample + 39);
        m_at += 193ms + i * 1ms; // of 203 to 214 ms, at any place between two looks
    }
    poses(sample, sample + 39);
    follow();
    std::uint64_t count = 0;
    for (const auto& outage : of(IncidentKind::Outage)) {
        count += outage.count;
    }
    EXPECT_EQ(count, silences);
}

TEST_F(IncidentBounds, BurstsInWhichNothingIsLostAreOneIncident) {
    std::uint32_t sample = 1;
    for (int burst = 0; burst < 20; ++burst, m_at += 300ms) {
        for (int i = 0; i < 30; ++i, m_at += 100us) {
            pose(sample++);
        }
    }
    const auto outages = of(IncidentKind::Outage);
    ASSERT_EQ(outages.size(), 1U);
    EXPECT_EQ(outages[0].fact().kind, words::Kind::InBursts);
    EXPECT_EQ(outages[0].samples, 0U);
    m_at += 5s;
    pose(sample + 450);
    EXPECT_EQ(of(IncidentKind::Outage).back().severity(), IncidentSeverity::Error) << "that is none";
}

TEST_F(IncidentBounds, ASlowSenderHasThreeOfItsSamples) {
    for (std::uint32_t sample = 1; sample <= 20; ++sample, m_at += 500ms) {
        pose(sample);
    }
    m_at -= 500ms;
    waitFor(1'500ms);
    EXPECT_TRUE(of(IncidentKind::Outage).empty());
    waitFor(1'525ms);
    EXPECT_EQ(of(IncidentKind::Outage).size(), 1U);
}

TEST_F(IncidentBounds, TheSecondSampleOfASlowSenderMayBeLate) {
    pose(1);
    m_at += 1'900ms;
    pose(61);
    EXPECT_TRUE(of(IncidentKind::Outage).empty());
    pose(1, "127.0.0.1:40002"); // and another one that sends no second
    waitFor(2'525ms);
    EXPECT_EQ(of(IncidentKind::Outage).size(), 1U);
}

TEST_F(IncidentBounds, ASenderThatOnlyRepeatsItsNamesIsSilent) {
    poses(1, 100);
    for (int i = 0; i < 30; ++i, m_at += 100ms) {
        send(wire::MetaData{true, "name:Ana\n"}, 0, m_at);
    }
    EXPECT_EQ(of(IncidentKind::Outage).size(), 1U);
}

TEST_F(IncidentBounds, ACharacterIsSilentWhileItsSenderSendsAnother) {
    for (std::uint32_t sample = 1; sample <= 100; ++sample, m_at += 10ms) {
        pose(sample);
        poseOfOther(sample);
    }
    const log::Stamp last = m_at - 10ms;
    poses(101, 400);
    auto outages = of(IncidentKind::Outage);
    ASSERT_EQ(outages.size(), 1U);
    ASSERT_EQ(outages[0].characters().size(), 1U);
    EXPECT_EQ(outages[0].characters()[0].character, 1);
    EXPECT_EQ(outages[0].firstStamp, last);
    EXPECT_TRUE(outages[0].isCurrent);
    EXPECT_EQ(m_session.verdicts().of({sender(), 1}).state, TakeVerdict::State::Bad);
    EXPECT_EQ(m_session.verdicts().of(key()).state, TakeVerdict::State::Good);
    for (std::uint32_t sample = 401; sample <= 500; ++sample, m_at += 10ms) {
        pose(sample);
        poseOfOther(sample);
    }
    outages = of(IncidentKind::Outage);
    ASSERT_EQ(outages.size(), 1U);
    EXPECT_FALSE(outages[0].isCurrent);
}

TEST_F(IncidentBounds, TenSamplesOfAStreamAreGrave) {
    poses(1, 2'000);
    m_at += 90ms;
    poses(2'010, 2'200); // nine
    auto losses = of(IncidentKind::Loss);
    ASSERT_EQ(losses.size(), 1U);
    EXPECT_EQ(losses[0].parts.front().samples, 9U);
    poses(2'201, 2'900);
    m_at += 100ms;
    poses(2'911, 3'000); // ten
    losses = of(IncidentKind::Loss);
    ASSERT_EQ(losses.size(), 2U);
    EXPECT_EQ(losses[1].samples, 10U);
    EXPECT_EQ(losses[1].severity(), IncidentSeverity::Error);
}

TEST_F(IncidentBounds, AGapThatIsFilledInTimeIsNone) {
    poses(1, 100);
    m_at += 10ms;
    pose(102);
    pose(101);
    m_at += 10ms;
    poses(103, 300);
    EXPECT_TRUE(of(IncidentKind::Loss).empty());
}

TEST_F(IncidentBounds, ATimeCodeJumpsByMoreThanHalfASecond) {
    for (const auto& [off, jumps] :
         {std::pair<log::Duration, bool>{500ms, false}, {501ms, true}, {-500ms, false}, {-501ms, true}}) {
        SCOPED_TRACE(off.count());
        log::PacketLog log;
        Session session(log);
        const log::SenderId sender = log.senders().intern({"10.0.0.1:1", log::Transport::Udp, 9763});
        for (std::uint32_t i = 0; i < 200; ++i) {
            const log::Stamp stamp = at(100s + i * 10ms);
            wire::Datagram datagram{{}, swayingAt(0, i), {}};
            datagram.header.sampleCounter = i;
            const log::Duration shown = stamp.time_since_epoch() + (i >= 100 ? off : log::Duration());
            datagram.header.timeCode = static_cast<std::uint32_t>(shown / 1ms);
            wire::completeHeader(datagram, wire::HeaderEra::Counted);
            log.writer().append(*wire::encode(datagram), {.stamp = stamp, .sender = sender});
        }
        log.writer().publish();
        session.follow(at(102s));
        const auto count =
            std::ranges::count(session.verdicts().incidents().all(), IncidentKind::TimeCode, &Incident::kind);
        EXPECT_EQ(count, jumps ? 1 : 0);
    }
}

TEST_F(IncidentBounds, AFrozenTimeCodeIsNoJump) {
    for (std::uint32_t sample = 1; sample <= 300; ++sample, m_at += 10ms) {
        m_timeCodeOff = 100s - m_at.time_since_epoch(); // always the same
        pose(sample);
    }
    EXPECT_TRUE(of(IncidentKind::TimeCode).empty());
}

TEST_F(IncidentBounds, ATimeCodeMayJumpWhereTheCounterRestarts) {
    poses(50'000, 50'100);
    m_timeCodeOff = -3'600s;
    m_at += 3'600s;
    poses(1, 200);
    EXPECT_TRUE(of(IncidentKind::TimeCode).empty());
    EXPECT_EQ(of(IncidentKind::Restart).size(), 1U);
}

TEST_F(IncidentBounds, TwoSendersConflictWhereOneComesBackWithinASecond) {
    for (const bool isWithin : {false, true}) {
        SCOPED_TRACE(isWithin);
        poses(1, 1);
        m_at += 500ms;
        pose(1, "127.0.0.1:40002");
        m_at += isWithin ? 400ms : 520ms;
        pose(2);
        EXPECT_EQ(of(IncidentKind::Conflict).size(), isWithin ? 2U : 0U);
        m_at += 10s;
    }
    const Incident conflict = of(IncidentKind::Conflict).front();
    EXPECT_EQ(conflict.character()->character, 0);
    EXPECT_EQ(conflict.sender, sender());
    EXPECT_EQ(conflict.detail.kind, words::Kind::TwoSenders);
    EXPECT_EQ(numberIn(conflict.detail, "id"), 0);
    EXPECT_EQ(namesIn(conflict.detail, "others"), std::vector<std::string>{"127.0.0.1:40002"});
}

TEST_F(IncidentBounds, OneSenderWithTwoNetworkCardsIsKnownByItsBytes) {
    for (std::uint32_t sample = 1; sample <= 400; ++sample, m_at += 10ms) {
        pose(sample);
        pose(sample, "127.0.0.2:40001");
    }
    const auto conflicts = of(IncidentKind::Conflict);
    ASSERT_EQ(conflicts.size(), 2U);
    for (const Incident& one : conflicts) {
        EXPECT_EQ(one.detail.kind, words::Kind::SentTwice);
    }
}

TEST_F(IncidentBounds, TwoSendersMaySendDifferentCharactersOrTypes) {
    for (std::uint32_t sample = 1; sample <= 100; ++sample, m_at += 10ms) {
        pose(sample);
        wire::Datagram datagram{{}, wire::CentreOfMass{}, {}};
        datagram.header.sampleCounter = sample;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), m_at, "127.0.0.1:40002");
        datagram = {{}, swayingAt(0, sample), {}};
        datagram.header.sampleCounter = sample;
        datagram.header.character = 1;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), m_at, "127.0.0.1:40003");
    }
    EXPECT_TRUE(of(IncidentKind::Conflict).empty());
}

TEST_F(IncidentBounds, DropsAreAddedUpInOneIncident) {
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
    const auto dropped = of(IncidentKind::Local);
    ASSERT_EQ(dropped.size(), 1U);
    EXPECT_EQ(dropped[0].value, 7);
    EXPECT_EQ(m_session.roster().find(sender())->kernelDrops, 7U);
}

TEST_F(IncidentBounds, AnotherBodyIsAScaleChangeAndTheSameOneIsNot) {
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
    EXPECT_TRUE(of(IncidentKind::ScaleChange).empty());
    send(nullPoseOf(1.1), 0, m_at + 10s);
    const auto changes = of(IncidentKind::ScaleChange);
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_EQ(changes[0].character()->character, 0);
    EXPECT_EQ(changes[0].fact().kind, words::Kind::NullPoseChanged);
    EXPECT_EQ(changes[0].severity(), IncidentSeverity::Info);
}

TEST_F(IncidentBounds, TroublesAreSortedWorstFirstAndLimitsLastOfTheirLike) {
    poses(1, 1'000);
    m_at += 100ms;
    poses(1'011, 1'100); // ten samples lost
    sendBytes(std::as_bytes(std::span("{\"a\":1}")), m_at);
    m_at += 10ms;
    poses(1'101, 1'150);
    follow();
    const auto troubles = m_session.verdicts().troublesOf(key());
    ASSERT_GE(troubles.size(), 2U);
    EXPECT_TRUE(troubles.front()->kind == IncidentKind::Foreign ||
                troubles.front()->kind == IncidentKind::Loss)
        << nameOf(troubles.front()->kind);
    for (std::size_t i = 1; i < troubles.size(); ++i) {
        EXPECT_GE(troubles[i - 1]->severity(), troubles[i]->severity());
        if (troubles[i - 1]->severity() == troubles[i]->severity()) {
            EXPECT_LE(troubles[i - 1]->group() == IncidentGroup::Limit,
                      troubles[i]->group() == IncidentGroup::Limit);
        }
        EXPECT_NE(troubles[i]->severity(), IncidentSeverity::Info);
    }
    EXPECT_TRUE(std::ranges::any_of(troubles, [](const Incident* event) {
        return event->kind == IncidentKind::Foreign;
    })) << "what is of the sender concerns its characters";
    EXPECT_TRUE(m_session.verdicts().troublesOf({sender("10.0.0.9:1"), 0}).empty());
}

} // namespace
} // namespace posewire::model
