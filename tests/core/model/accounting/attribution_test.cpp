// SPDX-License-Identifier: MIT
#include "core/model/session/accounts.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "tests/core/model/accounting/attribution_fixture.h"

#include <algorithm>

namespace posewire::model {
namespace {

TEST_F(AttributionTest, BlamesThisComputerWhereItsCounterRose) {
    frames(1, 50);
    m_at += 8ms;
    put(53, {.drops = 2});
    m_at += 4ms;
    frames(54, 120);
    const Gap& gap = onlyGap();
    EXPECT_EQ(gap.mainCause(), LossCause::ThisComputer);
    EXPECT_EQ(gap.lost, 2U);
    EXPECT_EQ(gap.fromSample, 50U);
    EXPECT_EQ(gap.toSample, 53U);
    EXPECT_EQ(gap.fromPacket, 49U);
    EXPECT_EQ(factOf(gap).kind, words::Kind::DroppedHere);
    EXPECT_EQ(partOf(factOf(gap), "datagrams"), words::counted(words::Kind::Datagrams, 2));
    EXPECT_EQ(numberIn(factOf(gap), "from"), 49);
    EXPECT_EQ(numberIn(factOf(gap), "to"), 50);
    EXPECT_EQ(m_session.roster().streams().front().lostByCause()[0], 2U);
}

TEST_F(AttributionTest, BlamesTheWayForWhatAProbeHadReceived) {
    frames(1, 50, {.probe = "A"});
    m_at += 8ms;
    put(53, {.drops = 2, .probe = "A", .isLostOnWay = true});
    m_at += 4ms;
    frames(54, 120, {.probe = "A"});
    const Gap& gap = onlyGap();
    EXPECT_EQ(gap.mainCause(), LossCause::Transport);
    EXPECT_EQ(gap.of(LossCause::Transport).lost, 2U);
    EXPECT_EQ(factOf(gap).kind, words::Kind::LostOnWay);
    EXPECT_EQ(m_session.roster().senders().front().kernelDrops, 0U);
    EXPECT_EQ(m_session.roster().streams().front().lostByCause(), (LossesByCause{0, 0, 0, 0, 2}));
}

TEST_F(AttributionTest, ExplainsNoLossByWhatAnotherComputerDropped) {
    for (std::uint32_t sample = 1; sample <= 120; ++sample, m_at += 4ms) {
        if (sample != 60) {
            put(sample, {.probe = "A"});
        }
        put(sample, {.drops = sample == 61 ? 1U : 0U, .probe = "B"});
    }
    const Gap& gap = onlyGap();
    ASSERT_EQ(m_session.roster().senders().size(), 2U);
    EXPECT_EQ(gap.stream.sender, m_session.roster().senders().front().id);
    EXPECT_EQ(gap.of(LossCause::ThisComputer).lost, 0U);
}

TEST_F(AttributionTest, BlamesTheNetworkWhereAnotherStreamBroughtTheSample) {
    for (std::uint32_t sample = 1; sample <= 100; ++sample, m_at += 4ms) {
        if (sample != 60) {
            put(sample, {});
        }
        put(sample, {.type = 24});
    }
    const Gap& gap = onlyGap();
    EXPECT_EQ(gap.mainCause(), LossCause::Network);
    EXPECT_EQ(factOf(gap).kind, words::Kind::OtherStream);
    EXPECT_EQ(numberIn(factOf(gap), "sample"), 60);
    EXPECT_EQ(namesIn(factOf(gap), "type"), std::vector<std::string>{"24"});
}

TEST_F(AttributionTest, BlamesNobodyIfThisComputerDoesNotCountItsDrops) {
    for (std::uint32_t sample = 1; sample <= 100; ++sample, m_at += 4ms) {
        if (sample != 60) {
            put(sample, {.dropsUncounted = true});
        }
        put(sample, {.type = 24, .dropsUncounted = true});
    }
    const Gap& gap = onlyGap();
    EXPECT_EQ(gap.causes(), std::vector{LossCause::Unknown});
    EXPECT_EQ(factOf(gap), (words::Fact{words::Kind::DropsUncounted,
                                        {{"samples", words::counted(words::Kind::Samples, 1)}}}));
    EXPECT_TRUE(m_session.accounts().allSenders().hasUncountedDrops);
}

TEST_F(AttributionTest, BlamesTheNetworkWhereTheSampleCameTruncated) {
    frames(1, 50);
    put(51, {.isTruncated = true});
    m_at += 4ms;
    frames(52, 120);
    EXPECT_EQ(onlyGap().mainCause(), LossCause::Network);
    EXPECT_EQ(m_session.roster().senders().front().malformed, 1U);
}

TEST_F(AttributionTest, CountsIncompleteSamplesByCauseToo) {
    frames(1, 50);
    put(51, {.datagramCounter = 0x00}); // its second part does not come
    m_at += 4ms;
    frames(52, 120);
    put(121, {.datagramCounter = 0x00});
    m_at += 4ms;
    put(122, {.drops = 1});
    m_at += 4ms;
    frames(123, 200);
    put(201, {.datagramCounter = 0x00}); // its second part comes late
    m_at += 4ms;
    frames(202, 260);
    follow();
    const Stream& stream = m_session.roster().streams().front();
    EXPECT_EQ(stream.accounting.counts().incomplete, 3U);
    EXPECT_EQ(stream.lostByCause(), (LossesByCause{1, 2, 0, 0}));
    put(201, {.datagramCounter = 0x81});
    m_at += 4ms;
    frames(261, 262);
    follow();
    EXPECT_EQ(stream.accounting.counts().incomplete, 2U);
    EXPECT_EQ(stream.lostByCause(), (LossesByCause{1, 1, 0, 0}));
}

TEST_F(AttributionTest, BlamesThisComputerForTheRestThatItDroppedWhileItWasStopped) {
    frames(1, 50);
    put(51, {.datagramCounter = 0x00});
    m_at += 520ms;
    put(180, {.drops = 129});
    m_at += 4ms;
    frames(181, 300);
    follow();
    EXPECT_EQ(m_session.roster().streams().front().lostByCause(), (LossesByCause{129, 0, 0, 0}));
}

TEST_F(AttributionTest, BlamesTheSenderForWhatIsIncompleteOnTcp) {
    frames(1, 50, {.transport = log::Transport::Tcp});
    put(51, {.transport = log::Transport::Tcp, .datagramCounter = 0x00});
    m_at += 4ms;
    frames(52, 120, {.transport = log::Transport::Tcp});
    follow();
    EXPECT_EQ(m_session.roster().streams().front().lostByCause(), (LossesByCause{0, 0, 1, 0}));
}

TEST_F(AttributionTest, CountsIncompleteMessagesByCauseToo) {
    const auto sendMetadata = [this](std::uint8_t datagramCounter) {
        wire::MetaData message;
        message.text = "name:Jonas\n";
        send(message, 0, m_at += 4ms, datagramCounter);
    };
    sendMetadata(0x00);
    m_at += 1s;
    sendMetadata(0x80);
    follow();
    const Stream& stream = m_session.roster().streams().front();
    EXPECT_EQ(stream.accounting.counts().incomplete, 1U);
    EXPECT_EQ(stream.lostByCause(), (LossesByCause{0, 1, 0, 0}));
}

TEST_F(AttributionTest, TakesAStreamThatEndsForNoLoss) {
    for (std::uint32_t sample = 1; sample <= 400; ++sample, m_at += 4ms) {
        put(sample, {});
        if (sample <= 100) {
            put(sample, {.type = 24});
        }
    }
    follow();
    EXPECT_TRUE(m_session.accounts().attribution().gaps().empty());
    for (const Stream& stream : m_session.roster().streams()) {
        EXPECT_EQ(stream.accounting.counts().lost, 0U);
    }
}

TEST_F(AttributionTest, LosesNothingOfAStreamThatWasNotSentForASecond) {
    for (const auto& [until, lost] : {std::pair{350U, 0U}, {300U, 199U}}) {
        const auto address = "127.0.0.1:" + std::to_string(40'000 + until);
        for (std::uint32_t sample = 1; sample <= 800; ++sample, m_at += 4ms) {
            put(sample, {.address = address.c_str()});
            if (sample <= 100 || sample >= until) {
                put(sample, {.type = 24, .address = address.c_str()});
            }
        }
        follow();
        const StreamCounts counts = m_session.roster().streams().back().accounting.counts();
        EXPECT_EQ(counts.lost, lost);
        EXPECT_EQ(counts.samples, 100 + 801 - until);
        EXPECT_EQ(counts.restarts, 0U);
        EXPECT_EQ(counts.firstSample, 1U);
        EXPECT_EQ(counts.step, 1U);
    }
}

TEST_F(AttributionTest, LosesAFewSamplesOfOneStreamThatComesRarely) {
    for (std::uint32_t sample = 1; sample <= 100; ++sample, m_at += 500ms) {
        put(sample, {});
        if (sample <= 50 || sample > 54) {
            put(sample, {.type = 24});
        }
    }
    follow();
    const StreamCounts counts = m_session.roster().streams().back().accounting.counts();
    EXPECT_EQ(counts.lost, 4U);
    EXPECT_EQ(counts.samples, 96U);
}

TEST_F(AttributionTest, LosesWhatIsMissingOfAPauseHoweverLong) {
    for (std::uint32_t sample = 1; sample <= 1'000; ++sample, m_at += 4ms) {
        for (const std::uint8_t type : std::initializer_list<std::uint8_t>{2, 24, 25}) {
            if (sample <= 200 || sample > 700) {
                put(sample, {.type = type});
            }
        }
        follow();
    }
    for (const Stream& stream : m_session.roster().streams()) {
        EXPECT_EQ(stream.lostByCause()[static_cast<std::size_t>(LossCause::Sender)], 500U);
    }
    EXPECT_EQ(std::ranges::count(m_session.verdicts().incidents().all(), IncidentKind::Step, &Incident::kind),
              0);
}

TEST_F(AttributionTest, JudgesTheSecondSampleAfterARestart) {
    for (std::uint32_t sample = 1; sample <= 800; ++sample, m_at += 4ms) {
        const std::uint32_t counter = sample <= 400 ? 50'000 + sample : sample - 400;
        put(counter, {.type = 24});
        if (counter != 2) {
            put(counter, {});
        }
    }
    follow();
    const Stream& stream = m_session.roster().streams().back();
    EXPECT_EQ(stream.accounting.counts().restarts, 1U);
    EXPECT_EQ(stream.accounting.counts().lost, 1U);
    EXPECT_EQ(stream.lostByCause()[static_cast<std::size_t>(LossCause::Network)], 1U);
}

TEST_F(AttributionTest, BlamesTheSenderOnTcp) {
    frames(1, 50, {.transport = log::Transport::Tcp});
    frames(52, 120, {.transport = log::Transport::Tcp});
    EXPECT_EQ(onlyGap().mainCause(), LossCause::Sender);
}

TEST_F(AttributionTest, BlamesTheSenderThatPausesAllItsStreams) {
    silentInBothStreams({});
    ASSERT_EQ(m_session.accounts().attribution().gaps().size(), 2U);
    for (const Gap& gap : m_session.accounts().attribution().gaps()) {
        EXPECT_EQ(gap.mainCause(), LossCause::Sender);
        EXPECT_EQ(gap.lost, 200U);
        EXPECT_EQ(factOf(gap).kind, words::Kind::Paused);
        EXPECT_EQ(partOf(factOf(gap), "streams"), words::counted(words::Kind::Streams, 2));
        EXPECT_EQ(numberIn(factOf(gap), "lasted"), 804);
    }
}

TEST_F(AttributionTest, BlamesForEachSampleWhatIsKnownOfIt) {
    for (std::uint32_t sample = 1; sample <= 400; ++sample, m_at += 4ms) {
        const bool isSent = sample <= 100 || sample > 300;
        for (const std::uint8_t type : std::initializer_list<std::uint8_t>{2, 24, 25}) {
            const bool isLost = (sample == 100 && type == 24) || (sample == 301 && type == 25);
            if (isSent && !isLost) {
                put(sample, {.type = type});
            }
        }
    }
    follow();
    ASSERT_EQ(m_session.accounts().attribution().gaps().size(), 3U);
    for (const Gap& gap : m_session.accounts().attribution().gaps()) {
        EXPECT_EQ(gap.of(LossCause::Sender).lost, 200U);
        EXPECT_EQ(gap.of(LossCause::Network).lost, gap.stream.type == 2 ? 0U : 1U);
        EXPECT_EQ(gap.of(LossCause::Unknown).lost, 0U);
        EXPECT_EQ(gap.causes().size(), gap.stream.type == 2 ? 1U : 2U);
    }
    for (const Incident& incident : m_session.verdicts().incidents().all()) {
        EXPECT_EQ(incident.samples, incident.kind == IncidentKind::Outage ? 600U
                                    : incident.kind == IncidentKind::Loss ? 2U
                                                                          : 0U);
    }
}

TEST_F(AttributionTest, BlamesThisComputerForNoMoreThanItDropped) {
    for (std::uint32_t sample = 1; sample <= 400; ++sample, m_at += 4ms) {
        if (sample <= 100 || sample > 300) {
            put(sample, sample == 301 ? Sent{.drops = 30} : Sent());
        }
    }
    EXPECT_EQ(onlyGap().of(LossCause::ThisComputer).lost, 30U);
    EXPECT_EQ(onlyGap().of(LossCause::Sender).lost, 170U);
}

TEST_F(AttributionTest, BlamesTheNetworkWhereSeveralHostsAreSilentTogether) {
    for (std::uint32_t sample = 1; sample <= 400; ++sample, m_at += 4ms) {
        if (sample <= 100 || sample > 200) {
            put(sample, {});
            put(sample, {.address = "127.0.0.2:40001"});
        }
        put(sample, {.address = "127.0.0.3:40001"});
    }
    follow();
    ASSERT_EQ(m_session.accounts().attribution().gaps().size(), 2U);
    for (const Gap& gap : m_session.accounts().attribution().gaps()) {
        EXPECT_EQ(gap.of(LossCause::Network).lost, 100U);
        EXPECT_EQ(factOf(gap).kind, words::Kind::HostsSilent);
        EXPECT_EQ(numberIn(factOf(gap), "hosts"), 2);
    }
}

TEST_F(AttributionTest, TakesALateSampleForNoEndOfASilence) {
    for (std::uint32_t sample = 1; sample <= 800; ++sample, m_at += 4ms) {
        if ((sample <= 100 && sample != 95) || sample > 300) {
            put(sample, {});
        } else if (sample == 180) {
            put(95, {});
        }
    }
    follow();
    const auto& gaps = m_session.accounts().attribution().gaps();
    EXPECT_EQ(std::ranges::count_if(gaps, [](const Gap& gap) { return gap.lost != 0; }), 1);
    EXPECT_EQ(gaps.back().of(LossCause::Sender).lost, 200U);
    EXPECT_EQ(
        std::ranges::count(m_session.verdicts().incidents().all(), IncidentKind::Outage, &Incident::kind), 1);
}

TEST_F(AttributionTest, TakesNoSampleForEvidenceThatTheStreamWouldNotHaveSent) {
    for (std::uint32_t sample = 1; sample <= 300; ++sample, m_at += 4ms) {
        if (sample != 151) { // nothing came of it
            put(sample, {});
            if (sample % 3 == 1) {
                put(sample, {.type = 24});
            }
        }
    }
    follow();
    std::uint64_t lost = 0;
    for (const Gap& gap : m_session.accounts().attribution().gaps()) {
        lost += gap.lost;
        EXPECT_EQ(gap.mainCause(), LossCause::Unknown) << factOf(gap);
    }
    EXPECT_EQ(lost, 2U);
}

TEST_F(AttributionTest, BlamesThisComputerForWhatWasSentWhileItsInputWasRemoved) {
    silentInBothStreams({.afterClosed = true});
    ASSERT_EQ(m_session.accounts().attribution().gaps().size(), 2U);
    for (const Gap& gap : m_session.accounts().attribution().gaps()) {
        EXPECT_EQ(gap.mainCause(), LossCause::ThisComputer);
        EXPECT_EQ(gap.lost, 200U);
        EXPECT_EQ(factOf(gap).kind, words::Kind::NotListening);
    }
}

TEST_F(AttributionTest, SaysUnknownWithoutEvidence) {
    frames(1, 50);
    m_at += 4ms;
    frames(52, 120);
    const Gap& gap = onlyGap();
    EXPECT_EQ(gap.mainCause(), LossCause::Unknown);
    EXPECT_TRUE(gap.isJudged);
    EXPECT_EQ(m_session.roster().streams().front().lostByCause()[3], 1U);
}

TEST_F(AttributionTest, DoesNotBlameAnotherPortsDrops) {
    frames(1, 50);
    log::Arrival other;
    other.stamp = m_at;
    other.sender = m_log.senders().intern({"127.0.0.1:40002", log::Transport::Udp, 9764});
    other.kernelDropsBefore = 5;
    m_log.writer().append(std::as_bytes(std::span("hello")), other);
    m_at += 4ms;
    frames(52, 120);
    EXPECT_EQ(onlyGap().mainCause(), LossCause::Unknown);
}

TEST_F(AttributionTest, TakesBackWhatCameLate) {
    frames(1, 50);
    frames(52, 120); // judged meanwhile
    put(51, {});
    m_at += 4ms;
    frames(121, 200);
    const Gap& gap = onlyGap();
    EXPECT_EQ(gap.lost, 0U);
    EXPECT_EQ(m_session.roster().streams().front().lostByCause()[3], 0U);
}

TEST_F(AttributionTest, TakesALateSampleBackFromItsOwnCause) {
    for (std::uint32_t sample = 1; sample <= 600; ++sample, m_at += 4ms) {
        const bool isSent = sample <= 100 || sample > 200;
        if (isSent && sample != 100) {
            put(sample, {});
        }
        if (isSent) {
            put(sample, {.type = 24});
        }
        if (sample == 400) { // judged long ago
            put(100, {});
        }
    }
    follow();
    const LossesByCause lost = m_session.roster().streams().front().lostByCause();
    EXPECT_EQ(lost[static_cast<std::size_t>(LossCause::Sender)], 100U);
    EXPECT_EQ(lost[static_cast<std::size_t>(LossCause::Network)], 0U);
}

TEST_F(AttributionTest, TakesBackWhatAChangeOfStepExplains) {
    frames(1, 100);
    for (std::uint32_t sample = 102; sample <= 400; sample += 2, m_at += 8ms) {
        put(sample, {});
    }
    follow();
    for (const Gap& gap : m_session.accounts().attribution().gaps()) {
        EXPECT_EQ(gap.lost, 0U) << gap.fromSample;
    }
    EXPECT_EQ(m_session.roster().streams().front().accounting.counts().lost, 0U);
}

TEST_F(AttributionTest, ClaimsNoLossWhileAStepChangesAndSamplesOfItAreLost) {
    frames(1, 300);
    std::uint64_t lost = 0;
    std::uint64_t most = 0;
    for (std::uint32_t place = 1; place <= 300; ++place, m_at += 12ms) {
        const bool isLost = place % 9 == 5 || place % 9 == 6;
        lost += isLost ? 1 : 0;
        if (!isLost) {
            put(300 + 3 * place, {});
            follow();
        }
        const auto causes = m_session.roster().streams().front().lostByCause();
        most = std::max(most, m_session.roster().streams().front().attributed[3]);
        ASSERT_LE(m_session.roster().streams().front().attributed[3], lost) << place;
        EXPECT_EQ(causes[0] + causes[1] + causes[2], 0U);
    }
    EXPECT_EQ(m_session.roster().streams().front().accounting.counts().lost, lost);
    EXPECT_GT(most, lost / 2);
}

TEST_F(AttributionTest, BlamesNoPauseForOneSampleOfASlowStream) {
    for (std::uint32_t sample = 1; sample <= 40; ++sample, m_at += 1s) {
        if (sample != 20) {
            put(sample, {});
        }
    }
    EXPECT_EQ(onlyGap().mainCause(), LossCause::Unknown);
}

TEST_F(AttributionTest, IsTheSameInWhateverPortionsTheLogIsRead) {
    std::uint32_t random = 7;
    for (std::uint32_t sample = 1; sample <= 3'000; ++sample, m_at += 4ms) {
        for (const std::uint8_t type : {std::uint8_t{2}, std::uint8_t{24}}) {
            random = random * 1'664'525 + 1'013'904'223;
            const std::uint32_t what = random >> 24;
            if (what > 20 && (sample < 1'000 || sample > 1'200)) {
                put(sample, {.type = type, .drops = what == 21 ? 1U : 0U, .isTruncated = what == 22});
            }
        }
    }
    std::vector<std::string> told[2];
    for (const std::size_t portion : {std::size_t{1}, std::size_t{100'000}}) {
        Session session(m_log);
        while (session.follow(m_now, portion)) {
        }
        for (const Gap& gap : session.accounts().attribution().gaps()) {
            told[portion == 1 ? 0 : 1].push_back(std::to_string(gap.fromSample) + " " +
                                                 std::to_string(gap.lost) + " " +
                                                 say(factOf(gap), words::Form::Sentence));
        }
    }
    EXPECT_GT(told[0].size(), 100U);
    EXPECT_EQ(told[0], told[1]);
}

TEST_F(AttributionTest, LeavesNoGapInTheListOfPacketsWhereAllCameLate) {
    frames(1, 50);
    put(52, {});
    m_at += 4ms;
    put(51, {});
    frames(53, 120);
    follow();
    EXPECT_EQ(m_session.accounts().digests().at(50).gap, 0U);
    EXPECT_EQ(m_session.accounts().digests().nextProblem(0), 51U) << "the one that was reordered";
    EXPECT_EQ(m_session.accounts().digests().nextProblem(51), std::nullopt);
}

TEST_F(AttributionTest, TellsTheListOfPacketsWhatIsMissingStill) {
    frames(1, 50);
    put(54, {});
    m_at += 300ms; // it was lost for good, and comes
    put(52, {});
    frames(55, 120);
    follow();
    EXPECT_EQ(m_session.accounts().attribution().gaps().front().lost, 2U);
    EXPECT_EQ(m_session.accounts().digests().at(50).gap, 2U);
}

TEST_F(AttributionTest, LeavesNoGapInTheListOfPacketsWhereTheStepChanged) {
    frames(1, 200);
    for (std::uint32_t sample = 204; sample <= 800; sample += 4, m_at += 16ms) {
        put(sample, {});
    }
    follow();
    EXPECT_EQ(m_session.roster().streams().front().accounting.counts().lost, 0U);
    EXPECT_EQ(m_session.accounts().digests().nextProblem(0), std::nullopt);
}

} // namespace
} // namespace posewire::model
