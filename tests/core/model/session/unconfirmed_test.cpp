// SPDX-License-Identifier: MIT
#include "core/model/session/accounts.h"
#include "core/model/session/roster.h"
#include "core/model/session/unconfirmed.h"

#include "tests/core/model/session/verdict_fixture.h"

/// Which characters are believed.
namespace posewire::model {
namespace {

TEST_F(VerdictTest, DoesNotBelieveACharacterOfOneCorruptHeader) {
    poses(1, 200);
    wire::Datagram datagram{{}, standingAt(0), {}};
    datagram.header.sampleCounter = 201;
    datagram.header.character = 66;
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    sendBytes(*wire::encode(datagram), m_at);
    poses(201, 300);
    EXPECT_EQ(verdict().state, TakeVerdict::State::Good);
    EXPECT_EQ(m_session.roster().listed().size(), 1U);
    ASSERT_NE(m_session.roster().find(CharacterKey{sender(), 66}), nullptr) << "it is counted";
    EXPECT_FALSE(m_session.roster().find(CharacterKey{sender(), 66})->isConfirmed);
}

TEST_F(VerdictTest, DoesNotBelieveACharacterOfCorruptHeadersHoweverMany) {
    std::uint32_t random = 7;
    poses(1, 200);
    for (std::uint32_t sample = 201; sample <= 6'000; ++sample, m_at += 10ms) {
        random = random * 1'664'525 + 1'013'904'223;
        (random >> 24) % 20 == 0 ? poseOfOther(sample) : pose(sample);
    }
    follow();
    EXPECT_EQ(m_session.atNow().roster().listed().size(), 1U);
    EXPECT_EQ(m_session.accounts().unproven().characters, 1U);
    EXPECT_GT(m_session.accounts().unproven().datagrams, 200U);
}

TEST_F(VerdictTest, BelievesACharacterWithinATenthOfASecondThatLosesSome) {
    poses(1, 200);
    for (std::uint32_t sample = 201; sample <= 212; ++sample, m_at += 10ms) {
        pose(sample);
        if (sample != 203) {
            poseOfOther(sample);
        }
    }
    follow();
    EXPECT_EQ(m_session.atNow().roster().listed().size(), 2U);
}

TEST_F(VerdictTest, TakesAllOfACharacterOnceItIsBelieved) {
    poses(1, 200);
    for (std::uint32_t sample = 201; sample <= 260; ++sample, m_at += 10ms) {
        pose(sample);
        wire::Datagram datagram{{}, standingAt(0), {}};
        datagram.header.sampleCounter = sample;
        datagram.header.character = 1;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), m_at);
    }
    follow();
    const Stream* stream = m_session.roster().find(log::StreamKey{sender(), 1, 2});
    ASSERT_NE(stream, nullptr);
    EXPECT_EQ(stream->accounting.counts().samples, 60U);
    EXPECT_EQ(m_session.roster().listed().size(), 2U);
}

} // namespace
} // namespace posewire::model
