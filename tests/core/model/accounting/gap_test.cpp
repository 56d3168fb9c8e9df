// SPDX-License-Identifier: MIT
#include "core/model/session/accounts.h"
#include "core/model/session/roster.h"
#include "tests/core/model/accounting/attribution_fixture.h"

#include <numeric>
#include <string>

/// The bounds of what a gap's cause rests on, and how it is said.
namespace posewire::model {
namespace {

class GapTest : public AttributionTest {
protected:
    std::uint64_t sumOfGaps() {
        follow();
        return std::accumulate(m_session.accounts().attribution().gaps().begin(),
                               m_session.accounts().attribution().gaps().end(), std::uint64_t{0},
                               [](std::uint64_t sum, const Gap& gap) { return sum + gap.lost; });
    }
    std::array<std::uint64_t, kLossCauses> causes() {
        follow();
        return m_session.roster().streams().front().lostByCause();
    }
    /// A stream is silent for so long, and its time code moves by as much and some more.
    LossCause causeOfSilence(log::Duration silence, log::Duration more) {
        log::PacketLog log;
        Session session(log);
        const auto sender = log.senders().intern({"10.0.0.1:1", log::Transport::Udp, 9763});
        log::Stamp stamp = at(10s);
        const auto silent = static_cast<std::uint32_t>(silence / 4ms) - 1;
        for (std::uint32_t sample = 1; sample <= 300 + silent; ++sample, stamp += 4ms) {
            if (sample > 100 && sample <= 100 + silent) {
                continue;
            }
            const log::Duration shown = stamp.time_since_epoch() + (sample > 100 ? more : log::Duration());
            wire::Datagram datagram{{}, wire::CentreOfMass{}, {}};
            datagram.header.sampleCounter = sample;
            datagram.header.timeCode = static_cast<std::uint32_t>(shown / 1ms);
            wire::completeHeader(datagram, wire::HeaderEra::Counted);
            log.writer().append(*wire::encode(datagram), {.stamp = stamp, .sender = sender});
        }
        log.writer().publish();
        session.follow(stamp);
        EXPECT_EQ(session.accounts().attribution().gaps().size(), 1U);
        return session.accounts().attribution().gaps().empty()
                   ? LossCause::ThisComputer
                   : session.accounts().attribution().gaps().front().mainCause();
    }
};

TEST_F(GapTest, IsNotJudgedBeforeLateArrivalsHadTheirTime) {
    frames(1, 50);
    put(52, {});
    const log::Stamp end = m_at;
    m_at = end + Attribution::kPatience - 1ns;
    put(53, {});
    EXPECT_FALSE(onlyGap().isJudged);
    EXPECT_EQ(factOf(onlyGap()).kind, words::Kind::WaitingForLate);
    EXPECT_EQ(causes()[static_cast<std::size_t>(LossCause::Unknown)], 1U) << "not known yet";
    m_at = end + Attribution::kPatience;
    put(54, {});
    EXPECT_TRUE(onlyGap().isJudged);
}

TEST_F(GapTest, HasACauseForEverySampleThatIsLost) {
    std::uint32_t random = 5;
    for (std::uint32_t sample = 1; sample <= 2'000; ++sample, m_at += 4ms) {
        random = random * 1'664'525 + 1'013'904'223;
        const std::uint32_t kind = random >> 24;
        if (kind > 20 || sample == 2'000) {
            put(sample, {.drops = kind < 40 ? 1U : 0U, .isTruncated = kind >= 250});
        }
        if (kind > 10) {
            put(sample, {.type = 24});
        }
    }
    frames(2'001, 2'100);
    const StreamCounts counts = (follow(), m_session.roster().streams().front().accounting.counts());
    const auto byCause = causes();
    EXPECT_GT(counts.lost, 100U);
    EXPECT_EQ(std::accumulate(byCause.begin(), byCause.end(), std::uint64_t{0}),
              counts.lost + counts.incomplete);
    EXPECT_GT(byCause[static_cast<std::size_t>(LossCause::ThisComputer)], 0U);
    EXPECT_GT(byCause[static_cast<std::size_t>(LossCause::Network)], 0U);
}

TEST_F(GapTest, IsTheSameAcrossTheWrapAroundOfTheCounter) {
    frames(0xffffff80U, 0xfffffffeU);
    m_at += 12ms; // 0xffffffff, 0 and 1 are lost; another stream brought one of them
    put(0, {.type = 24});
    frames(2, 100);
    follow();
    ASSERT_FALSE(m_session.accounts().attribution().gaps().empty());
    const Gap& gap = m_session.accounts().attribution().gaps().front();
    EXPECT_EQ(gap.fromSample, 0xfffffffeU);
    EXPECT_EQ(gap.toSample, 2U);
    EXPECT_EQ(gap.lost, 3U);
    EXPECT_EQ(gap.of(LossCause::Unknown).lost, 2U);
    const Gap::Share& brought = gap.of(LossCause::Network);
    EXPECT_EQ(brought.lost, 1U);
    EXPECT_EQ(brought.evidence, Gap::Evidence::OtherStream);
    EXPECT_EQ(brought.figure, 0U);
    EXPECT_EQ(namesIn(gap.evidenceFact(LossCause::Network), "type"), std::vector<std::string>{"24"});
}

TEST_F(GapTest, NamesItsSampleInTheFormThatPeopleRead) {
    Gap gap;
    gap.of(LossCause::Unknown) = {.evidence = Gap::Evidence::Damaged, .figure = 3793};
    EXPECT_EQ(say(gap.evidenceFact(LossCause::Unknown), words::Form::Sentence),
              "Sample 3\u202f793 arrived truncated or damaged.");
}

TEST_F(GapTest, IsAPauseFromFiftyMillisecondsWhateverTheTimeCodeSays) {
    EXPECT_EQ(causeOfSilence(48ms, 0ms), LossCause::Unknown) << "too short for a pause";
    EXPECT_EQ(causeOfSilence(52ms, 0ms), LossCause::Sender);
    EXPECT_EQ(causeOfSilence(400ms, -300ms), LossCause::Sender);
    EXPECT_EQ(causeOfSilence(2s, 5s), LossCause::Sender);
}

TEST_F(GapTest, IsCountedOnceHoweverManyOfItsSamplesComeLate) {
    frames(1, 50);
    m_at += 40ms;
    frames(61, 70);
    EXPECT_EQ(sumOfGaps(), 10U);
    for (const std::uint32_t late : {55U, 51U, 60U, 55U}) {
        put(late, {});
    }
    EXPECT_EQ(sumOfGaps(), 7U);
    frames(71, 200); // it is judged meanwhile
    EXPECT_EQ(sumOfGaps(), 7U);
    put(52, {});
    frames(201, 210);
    EXPECT_EQ(sumOfGaps(), 6U) << "later than anybody waits";
    for (const std::uint32_t late : {53U, 54U, 56U, 57U, 58U, 59U}) {
        put(late, {});
    }
    frames(211, 220);
    EXPECT_EQ(sumOfGaps(), 0U);
    EXPECT_EQ(m_session.roster().streams().front().accounting.counts().lost, 0U);
    const auto byCause = causes();
    EXPECT_EQ(std::accumulate(byCause.begin(), byCause.end(), std::uint64_t{0}), 0U);
}

TEST(GapTexts, SayOneAndMany) {
    Gap gap;
    gap.isJudged = true;
    gap.toStamp = log::Stamp(3s);
    gap.fromStamp = log::Stamp(1s);
    gap.fromPacket = 10;
    gap.toPacket = 12;
    gap.lost = 1;
    using Kind = words::Kind;
    const auto evidence = [&gap](Gap::Evidence which, std::uint64_t figure) {
        gap.of(LossCause::Unknown) = {.lost = gap.lost, .evidence = which, .figure = figure};
        return gap.evidenceFact(LossCause::Unknown);
    };
    EXPECT_EQ(evidence(Gap::Evidence::None, 0).kind, Kind::NoEvidence);
    EXPECT_EQ(numberIn(gap.evidenceFact(LossCause::Unknown), "lasted"), 2000);
    EXPECT_EQ(partOf(gap.evidenceFact(LossCause::Unknown), "samples"), words::counted(Kind::Samples, 1));
    gap.lost = 4;
    EXPECT_EQ(evidence(Gap::Evidence::Reliable, 0),
              (words::Fact{Kind::NotSentByTcp, {{"samples", words::counted(Kind::Samples, 4)}}}));
    const words::Fact dropped = evidence(Gap::Evidence::Dropped, 30);
    EXPECT_EQ(dropped.kind, Kind::DroppedHere);
    EXPECT_EQ(partOf(dropped, "datagrams"), words::counted(Kind::Datagrams, 30));
    EXPECT_EQ(numberIn(dropped, "from"), 10);
    EXPECT_EQ(numberIn(dropped, "to"), 12);
    EXPECT_EQ(evidence(Gap::Evidence::Damaged, 30).kind, Kind::SampleDamaged);
    EXPECT_EQ(numberIn(gap.evidenceFact(LossCause::Unknown), "sample"), 30);
    EXPECT_EQ(evidence(Gap::Evidence::Paused, 2).kind, Kind::Paused);
    EXPECT_EQ(partOf(gap.evidenceFact(LossCause::Unknown), "streams"), words::counted(Kind::Streams, 2));
    EXPECT_EQ(numberIn(gap.evidenceFact(LossCause::Unknown), "lasted"), 2000);
    EXPECT_EQ(nameOf(LossCause::ThisComputer), "this computer");
    EXPECT_EQ(nameOf(LossCause::Unknown), "unknown");
}

} // namespace
} // namespace posewire::model
