// SPDX-License-Identifier: MIT
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "tests/core/model/incidents/incidents_fixture.h"

#include <array>
#include <cstddef>
#include <utility>

namespace posewire::model {
namespace {

TEST_F(IncidentsTest, TellThatASenderComesAndGoes) {
    poses(1, 100);
    ASSERT_EQ(of(IncidentKind::SourceUp).size(), 1U);
    m_session.follow(m_at + 3s); // nothing more comes
    auto down = of(IncidentKind::Outage);
    ASSERT_EQ(down.size(), 1U);
    EXPECT_TRUE(down[0].isCurrent);
    EXPECT_EQ(down[0].severity(), IncidentSeverity::Error);
    EXPECT_EQ(m_session.verdicts().of(key()).state, TakeVerdict::State::Bad);
    m_at += 4s;
    poses(101, 200);
    down = of(IncidentKind::Outage);
    ASSERT_EQ(down.size(), 1U);
    EXPECT_FALSE(down[0].isCurrent);
}

TEST_F(IncidentsTest, SayNothingOfSilenceAfterTheEndOfAFile) {
    poses(1, 100);
    while (m_session.followFile(m_at)) {
    }
    m_session.endFile();
    m_session.follow(m_at + 3s);
    EXPECT_TRUE(of(IncidentKind::Outage).empty());
    // Nor where another sender is live.
    pose(1, "127.0.0.1:40002");
    m_session.follow(m_at);
    m_session.follow(m_at + 3s);
    const auto down = of(IncidentKind::Outage);
    ASSERT_EQ(down.size(), 1U);
    EXPECT_EQ(down[0].sender, sender("127.0.0.1:40002"));
    EXPECT_EQ(down[0].fact().kind, words::Kind::Outage);
    EXPECT_EQ(numberIn(down[0].fact(), "lasted"), std::nullopt) << "it lasts";
}

TEST_F(IncidentsTest, TroubleACharacterWhereTheCursorStands) {
    poses(1, 300);
    poses(311, 400); // ten lost
    poses(401, 1'000);
    follow();
    m_session.follow(m_at + 3s); // nothing more comes
    const auto isTroubledAt = [this](std::uint64_t packet) {
        m_session.setCursor({Cursor::Mode::Paused, packet});
        return !m_session.verdicts().troublesOf(key()).empty();
    };
    EXPECT_FALSE(isTroubledAt(200));
    EXPECT_TRUE(isTroubledAt(350));
    EXPECT_FALSE(isTroubledAt(980)) << "before the silence";
    EXPECT_EQ(m_session.verdicts().of(key()).state, TakeVerdict::State::Bad) << "now, whatever the cursor";
}

TEST_F(IncidentsTest, CountTheGapsOfAnIncidentInOne) {
    for (std::uint32_t sample = 1; sample <= 500; ++sample, m_at += 10ms) {
        if (sample % 50 != 0) {
            pose(sample);
        }
    }
    const auto losses = of(IncidentKind::Loss);
    ASSERT_EQ(losses.size(), 1U);
    EXPECT_EQ(losses[0].count, 9U);
    EXPECT_EQ(losses[0].samples, 9U);
    EXPECT_EQ(losses[0].cause, LossCause::Unknown);
    EXPECT_EQ(losses[0].samples, 9U) << losses[0].fact();
    EXPECT_EQ(partOf(losses[0].fact(), "gaps"), words::counted(words::Kind::Gaps, 9));
    EXPECT_EQ(toldIn(losses[0].fact()).cause, words::Kind::CauseUnknown);
    EXPECT_TRUE(losses[0].isCurrent);
    const std::uint64_t version = m_session.verdicts().incidents().version();
    poses(501, 1'200);
    EXPECT_FALSE(of(IncidentKind::Loss)[0].isCurrent);
    EXPECT_GT(m_session.verdicts().incidents().version(), version);
}

TEST_F(IncidentsTest, TellReorderedSamplesAndNoLoss) {
    poses(1, 100);
    m_at += 10ms;
    poses(102, 104);
    pose(101);
    poses(105, 300);
    ASSERT_EQ(of(IncidentKind::Reordered).size(), 1U);
    EXPECT_EQ(of(IncidentKind::Reordered)[0].count, 1U);
    EXPECT_TRUE(of(IncidentKind::Loss).empty());
}

TEST_F(IncidentsTest, TakeALossBackWhereTheSampleComesVeryLate) {
    poses(1, 100);
    m_at += 10ms;
    poses(102, 200);
    ASSERT_EQ(of(IncidentKind::Loss).size(), 1U);
    pose(101);
    EXPECT_TRUE(of(IncidentKind::Loss).empty()) << "it is gone, not over";
    EXPECT_EQ(of(IncidentKind::Reordered).size(), 1U);
    EXPECT_EQ(m_session.roster().find(log::StreamKey{sender(), 0, 2})->attributed, (LossesByCause{}));
}

TEST_F(IncidentsTest, WaitLongerAfterASampleThatCameVeryLate) {
    poses(1, 100);
    m_at += 10ms;
    poses(102, 200);
    pose(101); // one second late
    m_at += 10ms;
    poses(202, 250);
    EXPECT_TRUE(of(IncidentKind::Loss).empty()) << "it may come yet";
    poses(251, 500);
    EXPECT_EQ(of(IncidentKind::Loss).size(), 1U);
}

TEST_F(IncidentsTest, TellAnOutageOfAllStreamsAsOne) {
    const auto all = [this](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t sample = first; sample <= last; ++sample, m_at += 10ms) {
            pose(sample);
            send(wire::CentreOfMass{}, sample, m_at);
        }
    };
    all(1, 300);
    m_at += 1500ms;
    all(451, 600);
    const auto outages = of(IncidentKind::Outage);
    ASSERT_EQ(outages.size(), 1U);
    EXPECT_EQ(outages[0].samples, 300U);
    EXPECT_EQ(outages[0].cause, LossCause::Sender) << "the time code moved with it";
    EXPECT_FALSE(outages[0].isCurrent);
    EXPECT_TRUE(of(IncidentKind::Loss).empty());
    for (const Incident& incident : m_session.verdicts().incidents().all()) {
        EXPECT_NE(incident.group(), IncidentGroup::Limit) << incident.fact();
    }
    EXPECT_NEAR(numberIn(outages[0].fact(), "lasted").value_or(0), 1.51, 0.005) << outages[0].fact();
    EXPECT_EQ(outages[0].samples, 300U);
    EXPECT_EQ(toldIn(outages[0].fact()).cause, words::Kind::CauseSender);
}

TEST_F(IncidentsTest, TellATypeThatEndsAndNotItsLoss) {
    for (std::uint32_t sample = 1; sample <= 800; ++sample, m_at += 10ms) {
        pose(sample);
        if (sample <= 300) {
            send(wire::CentreOfMass{}, sample, m_at);
        }
    }
    const auto steps = of(IncidentKind::Step);
    ASSERT_EQ(steps.size(), 1U);
    EXPECT_EQ(steps[0].type(), wire::CentreOfMass::kType);
    EXPECT_EQ(steps[0].cause, LossCause::Unknown);
    EXPECT_TRUE(of(IncidentKind::Outage).empty());
    EXPECT_TRUE(of(IncidentKind::AgeLimit).empty());
}

TEST_F(IncidentsTest, TellThatTheSenderSendsAnotherShareOfItsSamples) {
    poses(1, 600);
    for (std::uint32_t sample = 602; sample <= 1'600; sample += 2, m_at += 20ms) {
        pose(sample);
    }
    const auto steps = of(IncidentKind::Step);
    ASSERT_EQ(steps.size(), 1U);
    EXPECT_EQ(steps[0].detail.kind, words::Kind::StepChanged);
    EXPECT_EQ(numberIn(steps[0].detail, "step"), 2);
    EXPECT_EQ(numberIn(steps[0].detail, "before"), 1);
    EXPECT_TRUE(of(IncidentKind::RateLimit).empty());
    EXPECT_TRUE(of(IncidentKind::Loss).empty());
}

TEST_F(IncidentsTest, TellThatAStepIsIrregularOnlyWhereThereWasOne) {
    const std::array<std::uint32_t, 4> differences{2, 4, 3, 1}; // as real senders do
    std::uint32_t sample = 1'000;
    const auto send = [&](std::uint32_t difference) {
        sample += difference;
        m_at += difference * 10ms;
        pose(sample);
    };
    for (const std::size_t even : {0U, 300U}) {
        SCOPED_TRACE(even);
        sample += 1'000'000; // another start of its counter
        m_at += 1min;
        for (std::size_t i = 0; i < even; ++i) {
            send(2);
        }
        for (std::size_t i = 0; i < 1'000; ++i) {
            send(differences[i % 4]);
        }
        EXPECT_EQ(of(IncidentKind::Step).size(), even == 0 ? 0U : 1U);
        EXPECT_TRUE(of(IncidentKind::RateLimit).empty());
    }
    EXPECT_EQ(of(IncidentKind::Step)[0].detail.kind, words::Kind::StepIrregular);
    EXPECT_EQ(numberIn(of(IncidentKind::Step)[0].detail, "before"), 2);
}

TEST_F(IncidentsTest, TellATimeCodeThatStandsStill) {
    poses(1, 100);
    posesOfOneTimeCode(101, 400);
    ASSERT_EQ(of(IncidentKind::TimeCode).size(), 1U);
    EXPECT_EQ(of(IncidentKind::TimeCode)[0].detail.kind, words::Kind::TimeCodeFrozen);
    EXPECT_EQ(of(IncidentKind::TimeCode)[0].count, 1U);
}

TEST_F(IncidentsTest, TellWithinAQuarterOfASecondThatATimeCodeStandsStillAndForHowLongItDid) {
    poses(1, 100);
    posesOfOneTimeCode(101, 125);
    ASSERT_EQ(of(IncidentKind::TimeCode).size(), 1U);
    EXPECT_EQ(of(IncidentKind::TimeCode)[0].firstStamp, at(100s + 990ms)) << "when it last changed";
    posesOfOneTimeCode(126, 400);
    m_timeCodeOff = 0s;
    poses(401, 500);
    ASSERT_EQ(of(IncidentKind::TimeCode).size(), 1U) << "that it is right again is no jump";
    EXPECT_EQ(of(IncidentKind::TimeCode)[0].detail.kind, words::Kind::TimeCodeWasFrozen);
    EXPECT_NEAR(numberIn(of(IncidentKind::TimeCode)[0].detail, "lasted").value_or(0), 3, 0.05);
    EXPECT_EQ(of(IncidentKind::TimeCode)[0].count, 1U);
}

TEST_F(IncidentsTest, TakeATimeCodeThatAlwaysMovesInStepsForNoneThatStandsStill) {
    for (std::uint32_t sample = 1; sample <= 600; ++sample, m_at += 10ms) {
        m_timeCodeOff = -(m_at.time_since_epoch() % 250ms);
        pose(sample);
    }
    EXPECT_TRUE(of(IncidentKind::TimeCode).empty());
}

TEST_F(IncidentsTest, TakeATimeCodeThatMovesOnceASecondForOneThatMoves) {
    for (std::uint32_t sample = 1; sample <= 3'000; ++sample, m_at += 10ms) {
        m_timeCodeOff = -(m_at.time_since_epoch() % 1s);
        pose(sample);
    }
    EXPECT_TRUE(of(IncidentKind::TimeCode).empty()) << of(IncidentKind::TimeCode).front().fact();
    m_timeCodeOff += 5s;
    posesOfOneTimeCode(3'001, 3'400);
    EXPECT_EQ(of(IncidentKind::TimeCode).size(), 1U) << "and still tells a jump";
}

TEST_F(IncidentsTest, TellAPauseOfTheSenderWhoseCounterGoesOnWhereItStopped) {
    for (const log::Duration clock :
         {3'000ms, 0ms}) { // a time code that goes on, and one that paused as well
        poses(1, 100);
        m_at += 3s;
        m_timeCodeOff -= 3s - clock;
        poses(101, 200);
        const auto outages = of(IncidentKind::Outage);
        ASSERT_FALSE(outages.empty());
        EXPECT_EQ(outages.back().cause, LossCause::Sender);
        EXPECT_NEAR(numberIn(outages.back().fact(), "lasted").value_or(0), 3.01, 0.005);
        EXPECT_EQ(outages.back().detail.kind, words::Kind::SenderPaused);
        EXPECT_TRUE(of(IncidentKind::TimeCode).empty()) << clock.count();
        m_at += 10s;
        poses(1'000'000, 1'000'100);
        m_at += 10s;
    }
}

TEST_F(IncidentsTest, BlameNoSenderForDatagramsThatWereHeldUpTogether) {
    poses(1, 100);
    const log::Stamp released = m_at + 700ms;
    for (std::uint32_t sample = 101; sample <= 171; ++sample) {
        const log::Stamp due = m_at + (sample - 101) * 10ms;
        m_timeCodeOff = due - released;
        const log::Stamp before = std::exchange(m_at, released);
        pose(sample);
        m_at = before;
    }
    m_timeCodeOff = 0s;
    m_at = released + 10ms;
    poses(172, 300);
    ASSERT_EQ(of(IncidentKind::Outage).size(), 1U);
    EXPECT_FALSE(of(IncidentKind::Outage)[0].cause);
}

TEST_F(IncidentsTest, TellARestartOnAnotherPortOnceTheOldOneIsSilent) {
    poses(1, 50);
    const log::Stamp from = m_at;
    for (std::uint32_t sample = 1; sample <= 15; ++sample, m_at += 10ms) {
        pose(sample, "127.0.0.1:40002");
    }
    EXPECT_TRUE(of(IncidentKind::Restart).empty()) << "both may go on";
    for (std::uint32_t sample = 16; sample <= 50; ++sample, m_at += 10ms) {
        pose(sample, "127.0.0.1:40002");
    }
    const auto restarts = of(IncidentKind::Restart);
    ASSERT_EQ(restarts.size(), 1U);
    EXPECT_EQ(restarts[0].sender, sender("127.0.0.1:40002"));
    EXPECT_EQ(restarts[0].firstStamp, from);
    EXPECT_EQ(restarts[0].detail.kind, words::Kind::OtherPort);
    for (std::uint32_t sample = 1; sample <= 50; ++sample, m_at += 10ms) {
        pose(sample, "127.0.0.1:40003");
        pose(50 + sample, "127.0.0.1:40002"); // goes on
    }
    EXPECT_EQ(of(IncidentKind::Restart).size(), 1U);
}

TEST_F(IncidentsTest, TellAPerformerWhoGoesOnUnderAnotherId) {
    poses(1, 50);
    name("Ada");
    poses(51, 150);
    const log::Stamp from = m_at;
    m_character = 7;
    poses(151, 155);
    name("Ada");
    poses(156, 300);
    EXPECT_TRUE(of(IncidentKind::Outage).empty());
    const auto restarts = of(IncidentKind::Restart);
    ASSERT_EQ(restarts.size(), 1U);
    EXPECT_EQ(restarts[0].firstStamp, from);
    EXPECT_EQ(restarts[0].detail.kind, words::Kind::OtherId);
}

TEST_F(IncidentsTest, TellTwoHostsWithOneCharacterWhateverTypesTheySend) {
    const auto both = [this](const std::string& other) {
        for (std::uint32_t sample = 1; sample <= 50; ++sample, m_at += 10ms) {
            pose(sample);
            wire::Datagram datagram{{}, wire::CentreOfMass{}, {}};
            datagram.header.sampleCounter = sample;
            wire::completeHeader(datagram, wire::HeaderEra::Counted);
            sendBytes(*wire::encode(datagram), m_at, other);
        }
    };
    both("127.0.0.1:40002");
    EXPECT_TRUE(of(IncidentKind::Conflict).empty()) << "one host may send from several ports";
    both("127.0.0.2:40001");
    EXPECT_TRUE(of(IncidentKind::Conflict).empty()) << "they may name different people yet";
    for (int seconds = 0; seconds < 3; ++seconds) {
        both("127.0.0.2:40001");
    }
    const auto conflicts = of(IncidentKind::Conflict);
    ASSERT_EQ(conflicts.size(), 2U);
    EXPECT_EQ(conflicts[0].count, conflicts[1].count);
    EXPECT_LT(conflicts[0].count, 101U) << "each turn is told once";
}

TEST_F(IncidentsTest, TellNoConflictOfHostsThatNameDifferentPeople) {
    const auto conflictsOf = [&](const char* one, const char* other) {
        const std::size_t before = of(IncidentKind::Conflict).size();
        for (std::uint32_t sample = 1; sample <= 300; ++sample, m_at += 10ms) {
            pose(static_cast<std::uint32_t>(m_at.time_since_epoch() / 10ms));
            pose(static_cast<std::uint32_t>(m_at.time_since_epoch() / 10ms), "127.0.0.2:40001");
            if (sample % 100 == 50) {
                name(one, "127.0.0.1:40001");
                name(other, "127.0.0.2:40001");
            }
        }
        return of(IncidentKind::Conflict).size() - before;
    };
    EXPECT_EQ(conflictsOf("Ada", "Bela"), 0U);
    EXPECT_EQ(conflictsOf("Ada", "Ada"), 2U);
}

TEST_F(IncidentsTest, TellRestartsMalformedAndForeignDatagrams) {
    poses(50'000, 50'100);
    poses(1, 50);
    sendBytes(std::as_bytes(std::span("MXTP02")), m_at);
    sendBytes(std::as_bytes(std::span("{\"a\":1}")), m_at);
    sendBytes(std::as_bytes(std::span("{\"a\":2}")), m_at);
    EXPECT_EQ(of(IncidentKind::Restart).size(), 1U);
    EXPECT_EQ(of(IncidentKind::Malformed).size(), 1U);
    ASSERT_EQ(of(IncidentKind::Foreign).size(), 1U);
    EXPECT_EQ(of(IncidentKind::Foreign)[0].count, 2U);
    EXPECT_TRUE(of(IncidentKind::TimeCode).empty());
}

TEST_F(IncidentsTest, CountOneRestartOfAllStreamsOnce) {
    const auto both = [this](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t sample = first; sample <= last; ++sample, m_at += 10ms) {
            pose(sample);
            send(wire::CentreOfMass{}, sample, m_at);
        }
    };
    both(50'000, 50'100);
    both(1, 150);
    ASSERT_EQ(of(IncidentKind::Restart).size(), 1U);
    EXPECT_EQ(of(IncidentKind::Restart)[0].count, 1U);
    both(50'000, 50'100);
    EXPECT_EQ(of(IncidentKind::Restart).back().count + of(IncidentKind::Restart).size(), 3U)
        << "another one is told, as an event of its own or in the same episode";
}

TEST_F(IncidentsTest, TellChangesOfMetadataButNotItsRepetition) {
    poses(1, 10);
    send(wire::MetaData{true, "name:Anna\n"}, 0, m_at);
    send(wire::MetaData{true, "name:Anna\n"}, 0, m_at);
    EXPECT_TRUE(of(IncidentKind::MetadataChange).empty());
    send(wire::MetaData{true, "name:Berta\n"}, 0, m_at);
    ASSERT_EQ(of(IncidentKind::MetadataChange).size(), 1U);
    EXPECT_EQ(namesIn(of(IncidentKind::MetadataChange)[0].detail, "changes"),
              std::vector<std::string>{"name: Anna → Berta"});
}

TEST_F(IncidentsTest, TellAJumpOfTheTimeCode) {
    poses(1, 100);
    m_timeCodeOff = 5s;
    poses(101, 200);
    ASSERT_EQ(of(IncidentKind::TimeCode).size(), 1U);
    EXPECT_EQ(of(IncidentKind::TimeCode)[0].detail.kind, words::Kind::TimeCodeJumped);
    EXPECT_EQ(numberIn(of(IncidentKind::TimeCode)[0].detail, "value"), 5000);
}

TEST_F(IncidentsTest, TakeNoCorruptTimeCodeForAJump) {
    poses(1, 100);
    m_timeCodeOff = 90s;
    pose(101);
    m_timeCodeOff = 0s;
    m_at += 10ms;
    poses(102, 200);
    EXPECT_TRUE(of(IncidentKind::TimeCode).empty());
}

TEST_F(IncidentsTest, TakeNoDatagramsThatWereHeldUpTogetherForAJumpOfTheTimeCode) {
    poses(1, 100);
    const log::Stamp released = m_at + 700ms;
    for (std::uint32_t sample = 101; sample <= 170; ++sample) { // each says when it was due
        const log::Stamp due = m_at + (sample - 101) * 10ms;
        m_timeCodeOff = due - released;
        const log::Stamp before = std::exchange(m_at, released);
        pose(sample);
        m_at = before;
    }
    m_timeCodeOff = 0s;
    m_at = released;
    poses(171, 300);
    EXPECT_TRUE(of(IncidentKind::TimeCode).empty());
}

TEST_F(IncidentsTest, TakeNoDatagramThatComesLateForAJumpOfTheTimeCode) {
    poses(1, 99);
    const log::Stamp due = m_at;
    m_at += 10ms;
    poses(101, 400);
    m_timeCodeOff = due - m_at; // sample 100 was sent when it was due
    pose(100);
    m_timeCodeOff = 0s;
    poses(401, 500);
    EXPECT_TRUE(of(IncidentKind::TimeCode).empty());
    EXPECT_TRUE(of(IncidentKind::Restart).empty());
}

TEST_F(IncidentsTest, TellTwoSendersWithOneCharacterButNotASuccessor) {
    poses(1, 50);
    for (std::uint32_t sample = 1; sample <= 50; ++sample, m_at += 10ms) {
        pose(sample, "127.0.0.1:40002"); // the same person from another port
    }
    EXPECT_TRUE(of(IncidentKind::Conflict).empty());
    for (std::uint32_t sample = 51; sample <= 100; ++sample, m_at += 10ms) {
        pose(sample, "127.0.0.1:40002");
        pose(sample, "127.0.0.1:40003");
    }
    const auto conflicts = of(IncidentKind::Conflict);
    ASSERT_EQ(conflicts.size(), 2U) << "each is told, naming the other";
    EXPECT_EQ(conflicts[0].severity(), IncidentSeverity::Error);
    EXPECT_NE(conflicts[0].sender, conflicts[1].sender);
    EXPECT_NE(conflicts[0].detail, conflicts[1].detail);
}

TEST_F(IncidentsTest, TellEverySenderOfACharacterThatTheyTakeTurnsWith) {
    poses(1, 50);
    for (std::uint32_t sample = 51; sample <= 100; ++sample, m_at += 10ms) {
        pose(sample, "127.0.0.1:4000" + std::to_string(1 + sample % 3));
    }
    const auto conflicts = of(IncidentKind::Conflict);
    ASSERT_EQ(conflicts.size(), 3U);
    EXPECT_EQ(conflicts[0].detail.kind, words::Kind::TwoSenders);
    EXPECT_EQ(namesIn(conflicts[0].detail, "others"),
              (std::vector<std::string>{"127.0.0.1:40002", "127.0.0.1:40003"}));
}

TEST_F(IncidentsTest, CallNoLossAnErrorBecauseOfAFewSamplesOfItsFirstSecond) {
    for (std::uint32_t sample = 1; sample <= 2'000; ++sample, m_at += 10ms) {
        if (sample % (sample < 150 ? 45 : 250) != 0) { // 2 %, then 0.4 %
            pose(sample);
        }
    }
    ASSERT_EQ(of(IncidentKind::Loss).size(), 1U);
    EXPECT_EQ(of(IncidentKind::Loss)[0].severity(), IncidentSeverity::Warning);
}

TEST_F(IncidentsTest, CallALossAboveItsLimitAnError) {
    poses(1, 1'000);
    follow();
    EXPECT_EQ(m_session.verdicts().of(key()).state, TakeVerdict::State::Good);
    for (std::uint32_t sample = 1'001; sample <= 1'400; ++sample, m_at += 10ms) {
        if (sample % 50 != 0) {
            pose(sample);
        }
    }
    const auto losses = of(IncidentKind::Loss);
    ASSERT_EQ(losses.size(), 1U);
    EXPECT_GT(losses[0].value, 1) << "percent";
    EXPECT_EQ(losses[0].severity(), IncidentSeverity::Error);
    EXPECT_TRUE(of(IncidentKind::LossLimit).empty()) << "the loss says it all";
    poses(1'401, 3'000);
    follow();
    EXPECT_EQ(m_session.verdicts().of(key()).state, TakeVerdict::State::Good)
        << m_session.verdicts().of(key()).said;
}

} // namespace
} // namespace posewire::model
