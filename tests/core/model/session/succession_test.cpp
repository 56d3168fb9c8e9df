// SPDX-License-Identifier: MIT
#include "tests/core/model/session/session_fixture.h"

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
    EXPECT_EQ(m_session.displayName(newest), "Factory");
    EXPECT_NEAR(m_session.colour(newest).red, 0xe9 / 255.0, 1e-6);
    ASSERT_NE(m_session.pose(newest), nullptr);
    EXPECT_NEAR(m_session.pose(newest)->segments[0].position.x(), 3, 1e-6);
    EXPECT_EQ(m_session.metadata(newest).tags().size(), 2U);
    EXPECT_TRUE(m_session.isSuperseded(keyOf("10.0.0.5:1000")));
    EXPECT_TRUE(m_session.isSuperseded(keyOf("10.0.0.5:1001")));
    EXPECT_FALSE(m_session.isSuperseded(newest));
}

TEST_F(SuccessionTest, KeepsTwoSendersApartThatSendAtTheSameTime) {
    sendFrom("10.0.0.5:1000", wire::MetaData{true, "name:Ana\n"}, at(1s));
    sendFrom("10.0.0.5:1001", standingAt(0), at(2s));
    sendFrom("10.0.0.5:1000", standingAt(1), at(3s));
    follow();
    EXPECT_FALSE(m_session.isSuperseded(keyOf("10.0.0.5:1000")));
    EXPECT_EQ(m_session.displayName(keyOf("10.0.0.5:1001")), "Character 0");
}

TEST_F(SuccessionTest, KeepsHostsAndCharactersApart) {
    sendFrom("10.0.0.5:1000", wire::MetaData{true, "name:Ana\n"}, at(1s));
    sendFrom("10.0.0.6:1000", standingAt(0), at(2s));
    follow();
    EXPECT_FALSE(m_session.isSuperseded(keyOf("10.0.0.5:1000")));
    EXPECT_EQ(m_session.displayName(keyOf("10.0.0.6:1000")), "Character 0");
}

TEST_F(SuccessionTest, ShowsTheOldSenderAgainBeforeItsSuccessorCame) {
    sendFrom("10.0.0.5:1000", standingAt(0), at(1s));
    sendFrom("10.0.0.5:1001", standingAt(1), at(2s));
    follow();
    EXPECT_TRUE(m_session.isSuperseded(keyOf("10.0.0.5:1000")));
    m_session.setCursor({Cursor::Mode::Paused, 0});
    EXPECT_FALSE(m_session.isSuperseded(keyOf("10.0.0.5:1000")));
}

} // namespace
} // namespace posewire::model
