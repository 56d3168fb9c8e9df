// SPDX-License-Identifier: MIT
#include "tests/core/model/session/session_fixture.h"

#include "core/model/session/verdict.h"

#include "core/model/accounting/attribution.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/null_pose_findings.h"
#include "core/model/body/pose_remark.h"
#include "core/model/session/accounts.h"
#include "core/model/session/listed_incidents.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

#include <algorithm>
#include <string>

namespace posewire::model {
namespace {

/// Senders come and go.
class LifecycleTest : public SessionTest {
protected:
    void sendPose(const std::string& address, std::uint32_t sample, std::uint8_t character = 0,
                  std::uint8_t type = 2) {
        wire::Datagram datagram;
        if (type == 2) {
            datagram.body = wire::PoseQuaternion{{{1, {0, 0, 1}, {1, 0, 0, 0}}}};
        } else {
            datagram.body = wire::CentreOfMass{};
        }
        datagram.header.sampleCounter = sample;
        datagram.header.character = character;
        datagram.header.datagramCounter = 0x80;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), m_at, address);
    }
    void sendStrange(const std::string& address) {
        const std::vector<std::byte> bytes(40, std::byte{'x'});
        sendBytes(bytes, m_at, address);
    }
    [[nodiscard]] const Sender* find(const std::string& address) const {
        const auto found = std::ranges::find_if(m_session.roster().senders(), [&](const Sender& sender) {
            return sender.info.address == address;
        });
        return found == m_session.roster().senders().end() ? nullptr : &*found;
    }

    log::Stamp m_at{100s};
};

TEST_F(LifecycleTest, StrangersTakeNoPlaceThatASenderCouldNeed) {
    constexpr std::size_t kStrangers = 20'000;
    for (std::size_t i = 0; i < kStrangers; ++i, m_at += 100us) {
        sendStrange("stranger:" + std::to_string(i));
    }
    sendPose("honest:1", 1);
    follow();
    ASSERT_NE(find("honest:1"), nullptr);
    EXPECT_EQ(m_session.roster().streams().size(), 1U);
    EXPECT_LE(m_session.roster().senders().size(), Roll::kMostStrangers + 1);
    EXPECT_EQ(m_session.accounts().allSenders().foreign, kStrangers) << "none is forgotten";
    EXPECT_EQ(m_session.accounts().allSenders().senders, kStrangers + 1);
}

TEST_F(LifecycleTest, TheLongestSilentMakesRoomAndIsRememberedInSums) {
    constexpr std::size_t kRestarts = 4 * Roll::kMostSenders;
    for (std::size_t i = 0; i < kRestarts; ++i, m_at += 1s) {
        const std::string address = "10.0.0.1:" + std::to_string(i);
        for (std::uint32_t sample = 1; sample <= 10; ++sample) {
            sendPose(address, sample == 5 ? 105 : sample < 5 ? sample : sample + 100); // 100 are lost
        }
        if (i % 100 == 0) {
            follow();
        }
    }
    follow();
    EXPECT_LE(m_session.roster().senders().size(), Roll::kMostSenders + Roll::kMostStrangers);
    EXPECT_LE(m_session.roster().characters().size(), m_session.roster().senders().size());
    EXPECT_LE(m_session.roster().streams().size(), m_session.roster().senders().size());
    EXPECT_NE(find("10.0.0.1:" + std::to_string(kRestarts - 1)), nullptr);
    EXPECT_EQ(find("10.0.0.1:0"), nullptr);
    const RetiredTotals& retired = m_session.accounts().retired();
    std::uint64_t samples = retired.samples;
    std::uint64_t lost = retired.lost;
    for (const Stream& stream : m_session.roster().streams()) {
        samples += stream.accounting.counts().samples;
        lost += stream.accounting.counts().lost;
    }
    EXPECT_EQ(samples, 10 * kRestarts);
    EXPECT_EQ(lost, 100 * kRestarts);
    EXPECT_EQ(m_session.accounts().allSenders().wellFormed(), 10 * kRestarts);
    EXPECT_EQ(m_session.accounts().allSenders().senders, kRestarts);
}

TEST_F(LifecycleTest, WhatARetiredSenderHadLastsNoLonger) {
    sendPose("old:1", 1);
    for (std::size_t i = 0; i <= 2 * Roll::kMostSenders; ++i, m_at += 1s) {
        sendPose("10.0.0.1:" + std::to_string(i), 1);
        sendPose("10.0.0.1:" + std::to_string(i), 2);
    }
    follow();
    ASSERT_EQ(find("old:1"), nullptr);
    for (const Incident* event : m_session.verdicts().incidents().current()) {
        EXPECT_NE(m_session.roster().find(event->sender), nullptr) << event->fact();
    }
    const Incident& first = m_session.verdicts().incidents().all().front();
    EXPECT_EQ(first.kind, IncidentKind::SourceUp);
    EXPECT_EQ(m_session.roster().addressOf(first.sender), "a retired sender");
}

TEST_F(LifecycleTest, WhatIsAskedOfOneThatWasRetiredIsNothing) {
    // A view may draw what it knew before the session went on.
    sendPose("old:1", 1);
    follow();
    const CharacterKey key{sender("old:1"), 0};
    ASSERT_NE(m_session.roster().find(key), nullptr);
    m_at += 10s;
    for (std::size_t i = 0; i <= 2 * Roll::kMostSenders; ++i, m_at += 1s) {
        sendPose("10.0.0.1:" + std::to_string(i), 1);
    }
    follow();
    ASSERT_EQ(m_session.roster().find(key), nullptr);
    EXPECT_TRUE(m_session.messages().metadata(key).tags().empty());
    EXPECT_EQ(m_session.messages().pose(key), nullptr);
    EXPECT_EQ(m_session.messages().nullPose(key), nullptr);
    EXPECT_EQ(m_session.verdicts().of(key).state, TakeVerdict::State::None);
    EXPECT_EQ(m_session.messages().ageSeconds(key), 0);
    EXPECT_TRUE(m_session.roster().lineage(key).empty());
    EXPECT_EQ(m_session.accounts().restartsOf(key), 0U);
    EXPECT_FALSE(m_session.roster().isHidden(key));
    EXPECT_FALSE(m_session.roster().isSuperseded(key));
    EXPECT_EQ(m_session.messages().nullPoseEvidence(key).record.messages, 0U);
    EXPECT_EQ(m_session.roster().colour(key), defaultColour(0));
    EXPECT_EQ(m_session.atNow().messages().pose(key), nullptr);
}

TEST_F(LifecycleTest, WhatWasForgottenKeepsItsNameInWhatIsToldOfIt) {
    wire::MetaData metadata;
    metadata.text = "name:Jonas\n";
    send(metadata, 0, m_at);
    for (std::uint32_t sample = 1; sample <= 200; ++sample, m_at += 10ms) {
        send(swayingAt(0, sample), sample == 100 ? 90 : sample, m_at);
    }
    follow();
    const CharacterKey jonas = key();
    m_session.follow(m_at + 3s);
    ASSERT_TRUE(m_session.forget(jonas.sender));
    EXPECT_EQ(m_session.roster().displayName(jonas), "Jonas");
    EXPECT_EQ(m_session.roster().addressOf(jonas.sender), "127.0.0.1:40001");
    EXPECT_EQ(m_session.roster().displayName({jonas.sender, 7}), "Character 7");
    const TakeVerdict verdict = verdictOf(m_session, recentSpan(m_session));
    EXPECT_EQ(say(verdict.said, words::Form::Headline).find("Character"), std::string::npos) << verdict.said;
    const auto& worst = m_session.accounts().retired().worst;
    const auto gap = std::ranges::find(worst, Figure::SpacingMost, &RetiredTotals::Worst::figure);
    EXPECT_NEAR(gap->value, 20, 1) << "limits of a run hold for it too";
}

TEST_F(LifecycleTest, ASenderThatIsHeardKeepsItsPlaceInAFloodOfForgedOnes) {
    for (std::size_t i = 0; i < 30'000; ++i, m_at += 10us) {
        if (i % 1'000 == 0) {
            sendPose("honest:1", static_cast<std::uint32_t>(i / 1'000 + 1));
        }
        sendPose("forged:" + std::to_string(i), 1);
    }
    follow();
    const Sender* honest = find("honest:1");
    ASSERT_NE(honest, nullptr);
    EXPECT_GE(honest->datagrams, 20U) << "once it was heard a few times, it was never retired";
}

TEST_F(LifecycleTest, ASenderOfEveryCharacterLeavesRoomForOthers) {
    for (int character = 0; character < 256; ++character) {
        for (const std::uint8_t type : std::array<std::uint8_t, 2>{2, 24}) {
            sendPose("junk:1", 1, static_cast<std::uint8_t>(character), type);
        }
    }
    sendPose("honest:1", 1);
    follow();
    EXPECT_NE(m_session.roster().find(log::StreamKey{sender("honest:1"), 0, 2}), nullptr);
    EXPECT_EQ(m_session.accounts().unfollowed(), 0U);
}

TEST_F(LifecycleTest, StreamsOfASenderBeyondTheLimitAreCounted) {
    // Types that nobody knows are streams too.
    std::uint64_t sent = 0;
    for (int character = 0; character < 256; ++character) {
        for (int type = 30; type < 40; ++type, ++sent) {
            wire::Datagram datagram{{}, wire::RawBody{}, {}};
            datagram.header.character = static_cast<std::uint8_t>(character);
            datagram.header.id[4] = static_cast<char>('0' + type / 10);
            datagram.header.id[5] = static_cast<char>('0' + type % 10);
            wire::completeHeader(datagram, wire::HeaderEra::Counted);
            sendBytes(*wire::encode(datagram), m_at, "junk:1");
        }
    }
    follow();
    EXPECT_EQ(m_session.roster().streams().size(), Roll::kMostStreamsOfSender);
    EXPECT_EQ(m_session.accounts().unfollowed(), sent - Roll::kMostStreamsOfSender);
    EXPECT_EQ(m_session.accounts().allSenders().wellFormed(), sent);
}

/// A log that a session is too late for.
class OvertakenTest : public testing::Test {
protected:
    void send(int count, std::uint32_t dropsBefore = 0) {
        for (int i = 0; i < count; ++i, m_stamp += 4ms) {
            m_sample += 1 + dropsBefore;
            wire::Datagram datagram{{}, wire::CentreOfMass{}, {}};
            datagram.header.sampleCounter = m_sample;
            datagram.header.datagramCounter = 0x80;
            wire::completeHeader(datagram, wire::HeaderEra::Counted);
            m_log.writer().append(*wire::encode(datagram), {m_stamp, m_sender, dropsBefore});
        }
        m_log.writer().publish();
    }

    log::PacketLog m_log{{.memoryCap = 1, .chunkSize = std::size_t{256} << 10}};
    Session m_session{m_log};
    log::SenderId m_sender = m_log.senders().intern({"a:1", log::Transport::Udp, 9763});
    log::Stamp m_stamp{100s};
    std::uint32_t m_sample = 0;
};

TEST_F(OvertakenTest, PacketsAreThisComputersLossToTheSample) {
    send(200);
    m_session.follow(m_stamp);
    send(20'000); // more than the log holds
    m_session.follow(m_stamp);
    const Stream& stream = m_session.roster().streams().front();
    const StreamCounts counts = stream.accounting.counts();
    EXPECT_GT(m_session.accounts().overtaken(), 0U);
    EXPECT_EQ(m_session.roster().senders().front().datagrams + m_session.accounts().overtaken(), 20'200U);
    EXPECT_EQ(counts.lost, m_session.accounts().overtaken());
    EXPECT_EQ(counts.samples + counts.lost, 20'200U);
    EXPECT_EQ(stream.lostByCause()[static_cast<std::size_t>(LossCause::ThisComputer)], counts.lost);
    ASSERT_EQ(m_session.accounts().attribution().gaps().size(), 1U);
    EXPECT_EQ(m_session.accounts().attribution().gaps().front().of(LossCause::ThisComputer).evidence,
              Gap::Evidence::Overtaken);
    const auto told =
        std::ranges::find(m_session.verdicts().incidents().all(), IncidentKind::Overtaken, &Incident::kind);
    ASSERT_NE(told, m_session.verdicts().incidents().all().end());
    EXPECT_EQ(static_cast<std::uint64_t>(told->value), m_session.accounts().overtaken());
    EXPECT_EQ(m_session.roster().addressOf(told->sender), "this computer");
}

TEST_F(OvertakenTest, PacketsTakeTheDropsThatTheyTellOfWithThem) {
    send(200);
    m_session.follow(m_stamp);
    send(10'000, 1);
    m_log.writer().append({}, {m_stamp, m_sender, 7, {.skipped = true, .isDropRecord = true}});
    m_sample += 7;
    send(10'000); // more than the log holds
    m_session.follow(m_stamp);
    const StreamCounts counts = m_session.roster().streams().front().accounting.counts();
    EXPECT_EQ(m_session.accounts().dropsUnseen(), 10'007U);
    EXPECT_EQ(m_session.accounts().allSenders().kernelDrops, 10'007U);
    EXPECT_EQ(m_session.accounts().allSenders().datagrams + m_session.accounts().overtaken() +
                  m_session.accounts().allSenders().kernelDrops,
              m_sample);
    EXPECT_EQ(counts.restarts, 0U);
    EXPECT_EQ(counts.lost, m_session.accounts().overtaken() + m_session.accounts().dropsUnseen());
    EXPECT_EQ(counts.samples + counts.lost, m_sample);
    const auto told =
        std::ranges::find(m_session.verdicts().incidents().all(), IncidentKind::Local, &Incident::kind);
    ASSERT_NE(told, m_session.verdicts().incidents().all().end());
    EXPECT_EQ(static_cast<std::uint64_t>(told->value), m_session.accounts().dropsUnseen());
}

TEST(Dropped, PacketsAreThisComputersLossToTheSampleHoweverMany) {
    log::PacketLog log;
    Session session(log);
    const auto sender = log.senders().intern({"a:1", log::Transport::Udp, 9763});
    wire::Datagram datagram{{}, wire::CentreOfMass{}, {}};
    log::Stamp stamp{100s};
    const auto send = [&](std::uint32_t sample, std::uint32_t dropsBefore) {
        datagram.header.sampleCounter = sample;
        datagram.header.datagramCounter = 0x80;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        log.writer().append(*wire::encode(datagram), {stamp, sender, dropsBefore});
        stamp += 10us;
    };
    for (std::uint32_t sample = 1; sample <= 500; ++sample) {
        send(sample, 0);
    }
    for (std::uint32_t sample = 11'061; sample <= 11'561; ++sample) {
        send(sample, sample == 11'061 ? 10'560 : 0);
    }
    stamp += 200ms; // late arrivals have had their time
    send(11'562, 0);
    log.writer().publish();
    session.follow(stamp + 1s);
    const Stream& stream = session.roster().streams().front();
    const StreamCounts counts = stream.accounting.counts();
    EXPECT_EQ(counts.lost, 10'560U);
    EXPECT_EQ(counts.restarts, 0U);
    EXPECT_EQ(stream.lostByCause()[static_cast<std::size_t>(LossCause::ThisComputer)], counts.lost);
    EXPECT_EQ(session.accounts().attribution().gaps().size(), 1U);
}

TEST_F(LifecycleTest, WhatIsFromBeforeARecordingCountsForWhatItSaysAlone) {
    wire::MetaData named;
    named.text = "name:Anna\n";
    m_isFromBefore = true;
    send(named, 1, at(1s));
    m_isFromBefore = false;
    for (std::uint32_t sample = 0; sample < 120; ++sample) {
        send(swayingAt(0, sample), sample, at(3600s + sample * 1s / 60));
    }
    follow();
    m_session.endFile();
    EXPECT_EQ(m_session.firstStamp(), at(3600s));
    EXPECT_EQ(m_session.keptSince(), at(3600s));
    EXPECT_EQ(m_session.messages().metadata(key()).value("name", 100), "Anna");
    EXPECT_EQ(m_session.roster().senders().front().datagrams, 120U);
    for (const ListedIncident& one : listedIncidents(m_session)) {
        EXPECT_TRUE(isNote(one.incident)) << static_cast<int>(one.incident.kind);
    }
    const Stream* messages = m_session.roster().find(log::StreamKey{sender(), 0, 12});
    ASSERT_NE(messages, nullptr);
    EXPECT_EQ(messages->accounting.datagrams(), 0U);
}

} // namespace
} // namespace posewire::model
