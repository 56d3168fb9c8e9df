// SPDX-License-Identifier: MIT
#include "tests/core/model/session/session_fixture.h"

#include "core/model/incidents/thresholds.h"
#include "core/model/session/accounts.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"

#include <algorithm>
#include <map>
#include <string>

/// How a character does, in one word and one sentence; and what the session keeps of the wildest input.
namespace posewire::model {
namespace {

using State = TakeVerdict::State;

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
            wire::Datagram datagram{{}, swayingAt(0, i), {}};
            datagram.header.sampleCounter = first + i;
            wire::completeHeader(datagram, era);
            sendBytes(*wire::encode(datagram), m_at);
        }
    }
    TakeVerdict verdictAfter(log::Duration silence) {
        follow();
        m_session.follow(m_at - 10ms + silence);
        return m_session.verdicts().of(key());
    }
    static double silence(const TakeVerdict& verdict, std::string_view name) {
        return numberIn(partOf(verdict.said, "reason"), name).value_or(0);
    }
    log::Stamp m_at{100s};
};

TEST_F(ConditionTest, IsGoodWhileDataComes) {
    poses(1, 300);
    const TakeVerdict verdict = verdictAfter(0ms);
    EXPECT_EQ(verdict.state, State::Good);
    EXPECT_EQ(verdict.said.kind, words::Kind::Good);
    EXPECT_EQ(verdict.incident, std::nullopt);
}

TEST_F(ConditionTest, HasTheRateOfItsSamplesWhateverComesTwice) {
    for (std::uint32_t sample = 1; sample <= 300; sample += 2) {
        poses(sample, 2);
        m_at -= 10ms;
        poses(sample + 1, 1);
    }
    follow();
    EXPECT_NEAR(m_session.roster().streams().front().statistics.rateHz(), 100, 1);
}

TEST_F(ConditionTest, WarnsOfAFifthOfASecondOfSilence) {
    poses(1, 300);
    EXPECT_EQ(verdictAfter(200ms).state, State::Good);
    const TakeVerdict silent = verdictAfter(225ms);
    EXPECT_EQ(silent.state, State::Warning);
    EXPECT_EQ(partOf(silent.said, "reason").kind, words::Kind::Outage);
    EXPECT_NEAR(silence(silent, "silence"), 0.225, 0.02);
    ASSERT_TRUE(silent.incident.has_value());
    EXPECT_EQ(m_session.verdicts().incidents().find(*silent.incident)->kind, IncidentKind::Outage);
    EXPECT_EQ(verdictAfter(999ms).state, State::Warning);
}

TEST_F(ConditionTest, IsAnErrorAfterASecondOfSilence) {
    poses(1, 300);
    const TakeVerdict down = verdictAfter(1'200ms);
    EXPECT_EQ(down.state, State::Bad);
    EXPECT_NEAR(silence(down, "silence"), 1.2, 0.02);
}

TEST_F(ConditionTest, IsThatOfNowWhilePaused) {
    poses(1, 100);
    follow();
    m_session.setCursor({Cursor::Mode::Paused, 50});
    EXPECT_EQ(verdictAfter(0ms).state, State::Good);
    EXPECT_EQ(verdictAfter(5s).state, State::Bad) << "the sender died meanwhile";
    m_session.setCursor({});
    EXPECT_EQ(m_session.verdicts().of(key()).state, State::Bad);
}

TEST_F(ConditionTest, IsTheSameAsTheVerdictThatScriptsGet) {
    poses(1, 100);
    poses(111, 200);
    const TakeVerdict mine = verdictAfter(0ms);
    EXPECT_EQ(mine, verdictOf(m_session, recentSpan(m_session), key()));
    EXPECT_EQ(m_session.verdicts().all().all, verdictOf(m_session, recentSpan(m_session)));
}

TEST_F(ConditionTest, OfARecordingIsThatOfAllOfIt) {
    poses(1, 100);
    poses(111, 3'000);
    while (m_session.followFile(m_at + 100h)) {
    }
    m_session.endFile();
    m_session.setCursor({Cursor::Mode::Paused, 50});
    EXPECT_TRUE(m_session.isRecording());
    EXPECT_EQ(m_session.verdicts().of(key()).state, State::Warning);
    const words::Fact said = m_session.verdicts().of(key()).said;
    EXPECT_EQ(partOf(said, "reason").kind, words::Kind::Loss) << said;
    EXPECT_EQ(toldIn(partOf(said, "reason")).cause, words::Kind::CauseUnknown);
    EXPECT_EQ(partOf(said, "lasts").kind, words::Kind::Over);
}

TEST_F(ConditionTest, OfARecordingCountsSilenceToItsEndWheneverItIsRead) {
    poses(1, 300);
    m_at += 2s;
    wire::Datagram other{{}, standingAt(0), {}};
    other.header.character = 1;
    wire::completeHeader(other, wire::HeaderEra::Counted);
    sendBytes(*wire::encode(other), m_at);
    while (m_session.followFile(m_at + 10'000h)) {
    }
    m_session.endFile();
    EXPECT_NEAR(silence(m_session.verdicts().of(key()), "left"), 2, 0.05);
}

TEST_F(ConditionTest, OfARecordingLooksNotBeyondItsEnd) {
    poses(1, 100);
    wire::Datagram datagram{{}, wire::MetaData{true, "name:Mira\n"}, {}}; // goes on without poses
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    for (int i = 0; i < 20; ++i, m_at += 100ms) {
        sendBytes(*wire::encode(datagram), m_at);
    }
    while (m_session.followFile(m_at + 100h)) {
    }
    m_session.endFile();
    EXPECT_NEAR(silence(m_session.verdicts().of(key()), "left"), 1.9, 0.05);
}

TEST_F(ConditionTest, OfARecordingKnowsOfNoSilenceAfterIt) {
    poses(1, 100);
    while (m_session.followFile(m_at + 100h)) {
    }
    m_session.endFile();
    EXPECT_EQ(m_session.verdicts().of(key()).state, State::Good);
}

TEST_F(ConditionTest, OfARangeIsThatOfTheRangeAlone) {
    poses(1, 300);   // 100 s to 103 s
    m_at += 2s;      // to 105 s
    poses(501, 300); // to 108 s
    poses(831, 300); // to 111 s, after 30 samples were lost at 108 s
    while (m_session.followFile(m_at)) {
    }
    m_session.endFile();
    const auto of = [&](log::Duration from, log::Duration to) {
        return verdictOf(m_session, {at(from), at(to)});
    };
    EXPECT_EQ(of(100s, 103s).state, State::Good);
    EXPECT_EQ(of(105500ms, 107s).state, State::Good);
    EXPECT_EQ(of(105500ms, 107s).since, at(105500ms));
    EXPECT_EQ(of(90s, 99s).state, State::None);
    const TakeVerdict begun = of(101s, 104s);
    EXPECT_EQ(begun.state, State::Bad);
    EXPECT_NEAR(silence(begun, "left"), 1, 0.05);
    EXPECT_EQ(partOf(begun.said, "when").kind, words::Kind::ToTheEnd);
    const TakeVerdict over = of(104s, 106s);
    EXPECT_EQ(over.since, at(104s));
    EXPECT_NEAR(silence(over, "silence"), 1, 0.05);
    EXPECT_EQ(partOf(over.said, "lasts").kind, words::Kind::Over);
    const TakeVerdict lost = of(107s, 110s);
    EXPECT_EQ(partOf(lost.said, "reason").kind, words::Kind::Loss);
    EXPECT_EQ(partOf(lost.said, "lasts").kind, words::Kind::Over);
    EXPECT_GE(lost.since, at(107s));
}

TEST_F(ConditionTest, OfARangeNamesWhatTookMostOfItAndIsNotBetterForIt) {
    Thresholds limits;
    limits.jitterMs = limits.gapMs = limits.ageS = limits.ratePercent = 0;
    m_session.setThresholds(limits);
    const auto lossy = [this](std::uint32_t first) { // 20 %
        for (std::uint32_t sample = first; sample < first + 500; sample += 10, m_at += 20ms) {
            poses(sample, 8);
        }
    };
    lossy(1);   // 100 s to 105 s
    m_at += 2s; // to 107 s
    lossy(701); // to 112 s
    while (m_session.followFile(m_at)) {
    }
    m_session.endFile();
    const TakeVerdict all = verdictOf(m_session, {at(101s), at(111s)});
    EXPECT_NEAR(silence(all, "silence"), 2, 0.05);
    EXPECT_EQ(all.state, State::Bad) << "as it loses to the end: " << all.said;
    EXPECT_FALSE(all.isOver);
    const TakeVerdict after = verdictOf(m_session, {at(108s), at(111s)});
    EXPECT_EQ(partOf(after.said, "reason").kind, words::Kind::Loss);
    EXPECT_EQ(after.state, State::Bad) << after.said;
}

TEST_F(ConditionTest, FindsAContradictionAtTheSamePacketHoweverMuchIsFollowedAtOnce) {
    poses(1, 100);
    poses(101, 100, wire::HeaderEra::Reserved);
    Session along(m_log);
    while (along.follow(m_now, 3)) {
    }
    follow();
    const auto contradictionOf = [](const Session& session) {
        const auto& all = session.verdicts().incidents().all();
        const auto found = std::ranges::find(all, IncidentKind::Scale, &Incident::kind);
        return found == all.end() ? log::Stamp() : found->firstStamp;
    };
    EXPECT_GE(contradictionOf(along), at(101s));
    EXPECT_EQ(contradictionOf(m_session), contradictionOf(along));
}

TEST_F(ConditionTest, WarnsWhereASenderContradictsItself) {
    poses(1, 100);
    m_session.setOverride(sender(), {.revision = Revision::E});
    EXPECT_EQ(verdictAfter(0ms).state, State::Good) << "nothing was followed when it was declared";
    m_session.setOverride(sender(), {.revision = Revision::E});
    const TakeVerdict verdict = verdictAfter(0ms);
    EXPECT_EQ(verdict.state, State::Warning);
    const words::Fact what = partOf(partOf(verdict.said, "reason"), "what");
    EXPECT_EQ(what.kind, words::Kind::SendsCounts) << verdict.said;
    EXPECT_EQ(namesIn(what, "declared"), std::vector<std::string>{"E"});
    m_session.setOverride(sender(), {.revision = Revision::N});
    EXPECT_EQ(partOf(verdictAfter(0ms).said, "lasts").kind, words::Kind::Over);
}

TEST_F(ConditionTest, NumbersWhatHappenedAlikeHoweverOftenSilenceIsLookedAt) {
    Session along(m_log);
    for (std::uint32_t sample = 1; sample < 156; ++sample) {
        sample = sample == 101 ? 105 : sample; // four are lost just before a silence
        poses(sample, 1);
        for (const log::Stamp end = m_at + (sample == 105 ? 600ms : 0ms); m_at < end; m_at += 7ms) {
            along.follow(m_at);
        }
        along.follow(m_now);
    }
    follow();
    const auto numbersOf = [](const Session& session) {
        std::map<std::uint64_t, IncidentKind> numbers;
        for (const Incident& incident : session.verdicts().incidents().all()) {
            numbers[incident.number] = incident.kind;
        }
        return numbers;
    };
    EXPECT_GT(numbersOf(along).size(), 1U);
    EXPECT_EQ(numbersOf(m_session), numbersOf(along));
}

TEST_F(ConditionTest, WarnsOfASenderThatChangesItsHeaders) {
    poses(1, 50);
    poses(51, 50, wire::HeaderEra::Reserved);
    const TakeVerdict verdict = verdictAfter(0ms);
    EXPECT_EQ(verdict.state, State::Warning);
    const words::Fact what = partOf(partOf(verdict.said, "reason"), "what");
    EXPECT_EQ(what.kind, words::Kind::CountsComeAndGo) << verdict.said;
    EXPECT_EQ(namesIn(what, "type"), std::vector<std::string>{"02"});
}

TEST_F(ConditionTest, OfAnUnknownCharacterIsNone) {
    poses(1, 10);
    follow();
    EXPECT_EQ(m_session.verdicts().of({sender(), 99}).state, State::None);
    EXPECT_TRUE(m_session.verdicts().troublesOf({sender(), 99}).empty());
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
    EXPECT_EQ(m_session.roster().characters().size(), static_cast<std::size_t>(kMostCharacters));
    EXPECT_EQ(m_session.roster().senders().size(), 5U);
    EXPECT_EQ(m_session.roster().senders().back().datagrams, 100U);
    EXPECT_EQ(m_session.accounts().digests().end(), m_sent);
    const CharacterKey tooMany{m_session.roster().senders().back().id, 50};
    EXPECT_EQ(m_session.roster().find(tooMany), nullptr);
    EXPECT_EQ(m_session.messages().message(tooMany, 24), nullptr);
    EXPECT_EQ(m_session.roster().displayName(tooMany), "Character 50");
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
    EXPECT_EQ(m_session.roster().streams().size(), log::StreamIndex::kStreamLimit);
    std::uint64_t datagrams = 0;
    for (const Sender& sender : m_session.roster().senders()) {
        datagrams += sender.datagrams;
        EXPECT_EQ(sender.malformed, 0U);
    }
    EXPECT_EQ(datagrams, m_sent) << "what is not kept apart is counted";
}

} // namespace
} // namespace posewire::model
