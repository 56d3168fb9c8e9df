// SPDX-License-Identifier: MIT
#include "tests/core/model/session/session_fixture.h"

#include "core/model/incidents/thresholds.h"

#include <string>

/// How a character does, in one word and one sentence; and what the session keeps of the wildest input.
namespace posewire::model {
namespace {

class ConditionTest : public SessionTest {
protected:
    void SetUp() override {
        Thresholds none;
        none.lossPercent = none.jitterMs = none.gapMs = none.ageS = none.ratePercent = 0;
        m_session.setThresholds(none);
    }
    /// Poses 10 ms apart, as of a sender whose header is of an era.
    void poses(std::uint32_t first, std::uint32_t count, wire::HeaderEra era = wire::HeaderEra::Counted) {
        for (std::uint32_t i = 0; i < count; ++i, m_at += 10ms) {
            wire::Datagram datagram{{}, standingAt(0), {}};
            datagram.header.sampleCounter = first + i;
            wire::completeHeader(datagram, era);
            sendBytes(*wire::encode(datagram), m_at);
        }
    }
    Condition conditionAfter(log::Duration silence) {
        follow();
        m_session.follow(m_at - 10ms + silence);
        return m_session.conditionOf(key());
    }
    log::Stamp m_at{100s};
};

TEST_F(ConditionTest, IsGoodWhileDataComes) {
    poses(1, 300);
    const Condition condition = conditionAfter(0ms);
    EXPECT_EQ(condition.level, Condition::Level::Good);
    EXPECT_EQ(condition.reason, "");
    EXPECT_EQ(condition.incident, std::nullopt);
}

TEST_F(ConditionTest, WarnsOfAFifthOfASecondOfSilence) {
    poses(1, 300);
    EXPECT_EQ(conditionAfter(200ms).level, Condition::Level::Good);
    const Condition silent = conditionAfter(225ms);
    EXPECT_EQ(silent.level, Condition::Level::Warning);
    EXPECT_EQ(silent.reason, "No data.");
    ASSERT_TRUE(silent.incident.has_value());
    EXPECT_EQ(m_session.incidents().find(*silent.incident)->kind, IncidentKind::Outage);
    EXPECT_EQ(conditionAfter(999ms).level, Condition::Level::Warning);
}

TEST_F(ConditionTest, IsAnErrorAfterASecondOfSilence) {
    poses(1, 300);
    const Condition down = conditionAfter(1'200ms);
    EXPECT_EQ(down.level, Condition::Level::Error);
    EXPECT_EQ(down.reason, "No data.");
    ASSERT_TRUE(down.incident.has_value());
    EXPECT_EQ(m_session.incidents().find(*down.incident)->kind, IncidentKind::Outage);
}

TEST_F(ConditionTest, IsThatOfThePausedMoment) {
    poses(1, 100);
    m_at += 600ms;
    poses(101, 100);
    conditionAfter(5s);
    m_session.setCursor({Cursor::Mode::Paused, 50});
    EXPECT_EQ(m_session.conditionOf(key()).level, Condition::Level::Good);
    m_session.setCursor({});
    EXPECT_EQ(m_session.conditionOf(key()).level, Condition::Level::Error);
}

TEST_F(ConditionTest, WarnsWhereASenderContradictsItself) {
    poses(1, 100);
    m_session.setOverride(sender(), {.revision = Revision::E});
    Condition condition = conditionAfter(0ms);
    EXPECT_EQ(condition.level, Condition::Level::Good) << "nothing was followed when it was declared";
    m_session.setOverride(sender(), {.revision = Revision::E});
    condition = conditionAfter(0ms);
    EXPECT_EQ(condition.level, Condition::Level::Warning);
    EXPECT_EQ(condition.reason, "declared E, but header counts are filled");
    m_session.setOverride(sender(), {.revision = Revision::N});
    EXPECT_EQ(conditionAfter(0ms).level, Condition::Level::Good);
}

TEST_F(ConditionTest, WarnsOfASenderThatChangesItsHeaders) {
    poses(1, 50);
    poses(51, 50, wire::HeaderEra::Reserved);
    const Condition condition = conditionAfter(0ms);
    EXPECT_EQ(condition.level, Condition::Level::Warning);
    EXPECT_NE(condition.reason.find("type 02"), std::string::npos) << condition.reason;
}

TEST_F(ConditionTest, OfAnUnknownCharacterIsGood) {
    poses(1, 10);
    follow();
    EXPECT_EQ(m_session.conditionOf({sender(), 99}).level, Condition::Level::Good);
    EXPECT_TRUE(m_session.troublesOf({sender(), 99}).empty());
}

/// More senders, characters and streams than anybody has.
class CrowdTest : public SessionTest {
protected:
    void sendAs(int senderNumber, std::uint8_t character, wire::Body body) {
        wire::Datagram datagram{{}, std::move(body), {}};
        datagram.header.character = character;
        datagram.header.sampleCounter = ++m_sample;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        log::Arrival arrival;
        arrival.stamp = m_now = at(10s) + m_sample * 1us;
        arrival.sender = m_log.senders().intern(
            {"10.1." + std::to_string(senderNumber / 200) + "." + std::to_string(senderNumber % 200) + ":1"});
        m_log.writer().append(*wire::encode(datagram), arrival);
        ++m_sent;
    }
    std::uint32_t m_sample = 0;
    std::uint64_t m_sent = 0;
};

TEST_F(CrowdTest, OfCharactersIsBoundedAndStillCountedBySender) {
    constexpr int kMostCharacters = 1'024;
    for (int i = 0; i < kMostCharacters + 100; ++i) {
        sendAs(i / 256, static_cast<std::uint8_t>(i % 256), wire::CentreOfMass{});
    }
    m_log.writer().publish();
    follow();
    EXPECT_EQ(m_session.characters().size(), static_cast<std::size_t>(kMostCharacters));
    EXPECT_EQ(m_session.senders().size(), 5U);
    EXPECT_EQ(m_session.senders().back().datagrams, 100U);
    EXPECT_EQ(m_session.digests().end(), m_sent);
    const CharacterKey tooMany{m_session.senders().back().id, 50};
    EXPECT_EQ(m_session.find(tooMany), nullptr);
    EXPECT_EQ(m_session.message(tooMany, 24), nullptr);
    EXPECT_EQ(m_session.displayName(tooMany), "Character 50");
}

TEST_F(CrowdTest, OfStreamsIsBounded) {
    const std::vector<wire::Body> bodies{wire::CentreOfMass{}, wire::TimeCode{}, wire::PoseQuaternion{},
                                         wire::LinearKinematics{}, wire::AngularKinematics{}};
    for (int i = 0; i < 1'000; ++i) {
        for (const wire::Body& body : bodies) {
            sendAs(i / 200, static_cast<std::uint8_t>(i % 200), body);
        }
    }
    m_log.writer().publish();
    follow();
    EXPECT_EQ(m_session.streams().size(), log::StreamIndex::kStreamLimit);
    std::uint64_t datagrams = 0;
    for (const Sender& sender : m_session.senders()) {
        datagrams += sender.datagrams;
        EXPECT_EQ(sender.malformed, 0U);
    }
    EXPECT_EQ(datagrams, m_sent) << "what is not kept apart is counted";
}

} // namespace
} // namespace posewire::model
