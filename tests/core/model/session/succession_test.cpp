// SPDX-License-Identifier: MIT
#include "core/model/session/accounts.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "tests/core/model/incidents/incidents_fixture.h"

namespace posewire::model {
namespace {

/// Datagrams of one character from several ports of one host.
class SuccessionTest : public SessionTest {
protected:
    void sendFrom(const std::string& address, wire::Body body, log::Stamp stamp) {
        wire::Datagram datagram;
        datagram.body = std::move(body);
        datagram.header.sampleCounter = ++m_sample;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        const auto bytes = wire::encode(datagram);
        ASSERT_TRUE(bytes.has_value());
        sendBytes(*bytes, stamp, address);
    }
    CharacterKey keyOf(const std::string& address) { return {sender(address), 0}; }

    std::uint32_t m_sample = 0;
};

TEST_F(SuccessionTest, TakesWhatItHasNotSentFromTheSenderBefore) {
    sendFrom("10.0.0.5:1000", wire::MetaData{true, "name:Factory\ncolor:e96417\n"}, at(1s));
    sendFrom("10.0.0.5:1001", standingAt(3), at(2s));
    sendFrom("10.0.0.5:1002", wire::TimeCode{}, at(3s));
    follow();
    const CharacterKey newest = keyOf("10.0.0.5:1002");
    EXPECT_EQ(m_session.roster().displayName(newest), "Factory");
    EXPECT_NEAR(m_session.roster().colour(newest).red, 0xe9 / 255.0, 1e-6);
    ASSERT_NE(m_session.messages().pose(newest), nullptr);
    EXPECT_NEAR(m_session.messages().pose(newest)->segments[0].position.x(), 3, 1e-6);
    EXPECT_EQ(m_session.messages().metadata(newest).tags().size(), 2U);
    EXPECT_TRUE(m_session.roster().isSuperseded(keyOf("10.0.0.5:1000")));
    EXPECT_TRUE(m_session.roster().isSuperseded(keyOf("10.0.0.5:1001")));
    EXPECT_FALSE(m_session.roster().isSuperseded(newest));
}

TEST_F(SuccessionTest, KeepsTwoSendersApartThatSendAtTheSameTime) {
    sendFrom("10.0.0.5:1000", wire::MetaData{true, "name:Ana\n"}, at(1s));
    sendFrom("10.0.0.5:1001", standingAt(0), at(2s));
    sendFrom("10.0.0.5:1000", standingAt(1), at(3s));
    follow();
    EXPECT_FALSE(m_session.roster().isSuperseded(keyOf("10.0.0.5:1000")));
    EXPECT_EQ(m_session.roster().displayName(keyOf("10.0.0.5:1001")), "Character 0");
}

TEST_F(SuccessionTest, KeepsHostsAndCharactersApart) {
    sendFrom("10.0.0.5:1000", wire::MetaData{true, "name:Ana\n"}, at(1s));
    sendFrom("10.0.0.6:1000", standingAt(0), at(2s));
    follow();
    EXPECT_FALSE(m_session.roster().isSuperseded(keyOf("10.0.0.5:1000")));
    EXPECT_EQ(m_session.roster().displayName(keyOf("10.0.0.6:1000")), "Character 0");
}

TEST_F(SuccessionTest, ShowsTheOldSenderAgainBeforeItsSuccessorCame) {
    sendFrom("10.0.0.5:1000", standingAt(0), at(1s));
    sendFrom("10.0.0.5:1001", standingAt(1), at(2s));
    follow();
    EXPECT_TRUE(m_session.roster().isSuperseded(keyOf("10.0.0.5:1000")));
    m_session.setCursor({Cursor::Mode::Paused, 0});
    EXPECT_FALSE(m_session.roster().isSuperseded(keyOf("10.0.0.5:1000")));
}

/// Poses at 100 Hz from ports that follow each other.
class RestartTest : public IncidentsTest {
protected:
    void posesFrom(const std::string& address, std::uint32_t count, std::uint32_t first = 1) {
        for (std::uint32_t sample = first; sample < first + count; ++sample, m_at += 10ms) {
            pose(sample, address);
        }
        follow();
    }
    /// One after the other, a second apart.
    void posesFromAllPorts() {
        posesFrom(m_first, 100);
        m_at += 1s;
        posesFrom(m_second, 100);
        m_at += 1s;
        posesFrom(m_third, 100);
    }
    CharacterKey keyOf(const std::string& address) { return {sender(address), 0}; }
    std::vector<CharacterKey> shown() {
        std::vector<CharacterKey> keys;
        for (const Character* one : m_session.atNow().roster().listed()) {
            keys.push_back(one->key);
        }
        return keys;
    }
    std::uint32_t m_other = 0;
    const std::string m_first = "10.0.0.5:1000";
    const std::string m_second = "10.0.0.5:1001";
    const std::string m_third = "10.0.0.5:1002";
};

TEST_F(RestartTest, IsOneCharacterThroughPortsWithAHistory) {
    posesFromAllPorts();
    EXPECT_EQ(shown(), std::vector{keyOf(m_third)});
    EXPECT_EQ(m_session.accounts().restartsOf(keyOf(m_third)), 2U);
    EXPECT_EQ(m_session.roster().lineage(keyOf(m_third)).size(), 3U);
    EXPECT_TRUE(m_session.roster().isSame(keyOf(m_first), keyOf(m_third)));
    ASSERT_EQ(m_session.accounts().endedSenders().size(), 2U);
    m_session.setSelection({sender(m_first), keyOf(m_first), -1});
    EXPECT_TRUE(m_session.roster().isSelected(keyOf(m_third)));
    m_session.setHidden(keyOf(m_first), true);
    EXPECT_TRUE(m_session.roster().isHidden(keyOf(m_third)));
    m_session.setHidden(keyOf(m_third), false);
    EXPECT_FALSE(m_session.roster().isHidden(keyOf(m_first)));
}

TEST_F(RestartTest, CountsRestartsOnTheSamePort) {
    posesFrom(m_first, 400, 10'000);
    posesFrom(m_first, 400);
    EXPECT_EQ(m_session.accounts().restartsOf(keyOf(m_first)), 1U);
    EXPECT_TRUE(m_session.accounts().endedSenders().empty());
}

TEST_F(RestartTest, KeepsItsVerdictThroughAnotherPort) {
    posesFrom(m_first, 300);
    posesFrom(m_first, 100, 311); // ten lost
    m_at += 300ms;
    posesFrom(m_second, 200);
    const TakeVerdict verdict = m_session.verdicts().of(keyOf(m_second));
    EXPECT_EQ(verdict.state, TakeVerdict::State::Warning) << "what is said of all is said of somebody";
    EXPECT_EQ(verdict.said, m_session.verdicts().all().all.said);
}

TEST_F(RestartTest, ForgetsTheEndedAndLosesNothing) {
    send(wire::MetaData{true, "name:Ana\n"}, 1, m_at);
    posesFrom("127.0.0.1:40001", 100);
    m_at += 1s;
    posesFrom("127.0.0.1:40002", 100);
    m_at += 1s;
    posesFrom("127.0.0.1:40003", 100);
    const CharacterKey now = keyOf("127.0.0.1:40003");
    const SenderTotals before = m_session.accounts().allSenders();
    m_session.setSelection({sender(), key(), -1});
    m_session.setHidden(key(), true);
    m_session.setLifted(key(), true);
    EXPECT_FALSE(m_session.forget(now.sender)) << "it sends";
    EXPECT_TRUE(m_session.forget(sender("127.0.0.1:40002"))) << "from the middle of the line";
    EXPECT_EQ(shown(), std::vector{now}) << "the first is not back";
    EXPECT_TRUE(m_session.forget(sender()));
    EXPECT_TRUE(m_session.accounts().endedSenders().empty());
    EXPECT_EQ(m_session.roster().senders().size(), 1U);
    EXPECT_EQ(m_session.accounts().restartsOf(now), 2U);
    EXPECT_EQ(m_session.roster().displayName(now), "Ana");
    EXPECT_EQ(m_session.choices().selection.character, now);
    EXPECT_TRUE(m_session.roster().isHidden(now));
    EXPECT_TRUE(m_session.roster().isLifted(now));
    EXPECT_EQ(m_session.accounts().allSenders().datagrams, before.datagrams);
    EXPECT_EQ(m_session.accounts().retired().samples, 200U);
}

TEST_F(RestartTest, ForgetsWhoIsSilentForLong) {
    posesFrom(m_first, 100);
    EXPECT_FALSE(m_session.accounts().isForgettable(sender(m_first)));
    m_session.follow(m_at + 2s);
    EXPECT_TRUE(m_session.forget(sender(m_first)));
    EXPECT_TRUE(shown().empty());
    posesFrom(m_first, 100, 101);
    EXPECT_EQ(shown().size(), 1U) << "it is back";
}

TEST_F(RestartTest, IsForgottenWithAllThatCameBefore) {
    posesFromAllPorts();
    m_session.follow(m_at + 2s);
    EXPECT_TRUE(m_session.forget(sender(m_third)));
    EXPECT_TRUE(shown().empty()) << "what it had taken over does not come back";
    EXPECT_TRUE(m_session.roster().senders().empty());
    m_session.follow(m_at + 20s);
    EXPECT_EQ(m_session.verdicts().all().all.state, TakeVerdict::State::None);
}

TEST_F(RestartTest, IsSilentWhereWhatItHadTakenOverMustStay) {
    const auto posesOfOther = [this](log::Duration time) { // of the first sender, which goes on
        for (const log::Stamp end = m_at + time; m_at < end; m_at += 10ms) {
            wire::Datagram datagram{{}, swayingAt(2, ++m_other), {}};
            datagram.header.sampleCounter = m_other;
            datagram.header.character = 1;
            wire::completeHeader(datagram, wire::HeaderEra::Counted);
            sendBytes(*wire::encode(datagram), m_at, m_first);
        }
    };
    posesFrom(m_first, 100);
    posesOfOther(1s);
    posesFrom(m_second, 100);
    posesOfOther(3s);
    follow();
    EXPECT_TRUE(m_session.forget(sender(m_second)));
    posesOfOther(20s);
    follow();
    EXPECT_EQ(m_session.verdicts().of(keyOf(m_first)).state, TakeVerdict::State::Bad) << "nobody sends it";
    EXPECT_EQ(m_session.verdicts().of({sender(m_first), 1}).state, TakeVerdict::State::Good);
}

TEST_F(RestartTest, IsNoTroubleOfTheSenderThatEnded) {
    posesFrom(m_first, 300);
    posesFrom(m_second, 2'000); // at once, so that nobody was silent
    EXPECT_EQ(m_session.verdicts().of(keyOf(m_second)).state, TakeVerdict::State::Good)
        << m_session.verdicts().of(keyOf(m_second)).said;
    EXPECT_EQ(m_session.verdicts().all().all.state, TakeVerdict::State::Good)
        << m_session.verdicts().all().all.said;
}

TEST_F(RestartTest, EndsWithItsSenderWhatOnlyThatSenderCanEnd) {
    posesFrom(m_first, 300);
    m_session.setOverride(sender(m_first), {.revision = Revision::E});
    ASSERT_EQ(m_session.verdicts().of(keyOf(m_first)).state, TakeVerdict::State::Warning);
    m_session.setOverride(sender(m_first), {.revision = Revision::E});
    posesFrom(m_second, 1'500);
    EXPECT_TRUE(std::ranges::none_of(m_session.verdicts().incidents().all(), [&](const Incident& one) {
        return one.sender == sender(m_first) && one.isCurrent && one.kind == IncidentKind::Scale;
    }));
}

class RenumberedTest : public IncidentsTest {
protected:
    /// Two seconds of a character whose pelvis is near a place; `name`: empty for one without metadata.
    void perform(std::uint8_t character, float x, const std::string& name = {}) {
        for (std::uint32_t i = 0; i < 200; ++i, m_at += 10ms) {
            if (!name.empty() && i % 50 == 0) {
                sendOf(character, 0, wire::MetaData{true, "name:" + name + "\n"});
            }
            sendOf(character, m_sample, swayingAt(x, m_sample));
            ++m_sample;
        }
    }
    void sendOf(std::uint8_t character, std::uint32_t sample, wire::Body body) {
        wire::Datagram datagram{{}, std::move(body), {}};
        datagram.header.sampleCounter = sample;
        datagram.header.character = character;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), m_at);
    }
    /// Rows, and restarts.
    using Told = std::pair<std::size_t, std::size_t>;
    Told told() {
        follow();
        return {m_session.atNow().roster().listed().size(), of(IncidentKind::Restart).size()};
    }
    std::uint32_t m_sample = 1;
};

TEST_F(RenumberedTest, IsWhoHasTheSameName) {
    perform(0, 0, "Ana");
    perform(7, 3, "Ana");
    EXPECT_EQ(told(), Told(1, 1));
    EXPECT_EQ(of(IncidentKind::Restart)[0].detail.kind, words::Kind::OtherId);
}

TEST_F(RenumberedTest, IsNobodyOfAnotherName) {
    perform(0, 0, "Ana");
    perform(7, 0, "Mira");
    EXPECT_EQ(told(), Told(2, 0));
}

TEST_F(RenumberedTest, WithoutNamesIsWhoGoesOnWhereTheOtherWas) {
    perform(0, 0);
    perform(7, 0.1F);
    EXPECT_EQ(told(), Told(1, 1));
    perform(9, 0.6F);
    EXPECT_EQ(told(), Told(2, 1));
}

} // namespace
} // namespace posewire::model
