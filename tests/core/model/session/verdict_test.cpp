// SPDX-License-Identifier: MIT
#include "core/model/session/held_up.h"
#include "core/model/session/listed_incidents.h"
#include "core/model/session/verdict.h"

#include "tests/core/model/session/verdict_fixture.h"

#include <array>
#include <numeric>

/// What an operator is told before a take.
namespace posewire::model {
namespace {

using State = TakeVerdict::State;

TEST_F(VerdictTest, IsNotGoodBeforeAnythingArrived) {
    EXPECT_EQ(verdict().state, State::None);
    EXPECT_EQ(verdict().text, "No data yet");
}

TEST_F(VerdictTest, IsGoodWhileAPoseComesAndNothingIsWrong) {
    poses(1, 200);
    EXPECT_EQ(verdict().state, State::Good);
    EXPECT_EQ(verdict().text, "Good for the take: 1 character");
}

TEST_F(VerdictTest, IsNotGoodWithoutAPoseToDraw) {
    for (std::uint32_t sample = 1; sample <= 100; ++sample, m_at += 10ms) {
        send(wire::CentreOfMass{}, sample, m_at);
        send(wire::LinearKinematics{}, sample, m_at);
    }
    EXPECT_EQ(verdict().state, State::Warning);
    EXPECT_EQ(verdict().text, "Not quite good: no pose to draw of Character 0, which sends types 24 and 21");
}

TEST_F(VerdictTest, NamesAllWithoutAPoseToDraw) {
    for (std::uint32_t sample = 1; sample <= 100; ++sample, m_at += 10ms) {
        for (std::uint8_t character = 0; character < 2; ++character) {
            wire::Datagram datagram{{}, wire::CentreOfMass{}, {}};
            datagram.header.sampleCounter = sample;
            datagram.header.character = character;
            wire::completeHeader(datagram, wire::HeaderEra::Counted);
            sendBytes(*wire::encode(datagram), m_at);
        }
    }
    EXPECT_EQ(verdict().text,
              "Not quite good: no pose to draw of Character 0 and Character 1, which send type 24");
}

TEST_F(VerdictTest, IsNotGoodWhereOnlyThePoseIsNotSentAnyMore) {
    for (std::uint32_t sample = 1; sample <= 2'000; ++sample, m_at += 10ms) {
        if (sample <= 300) {
            pose(sample);
        }
        send(wire::CentreOfMass{}, sample, m_at);
    }
    EXPECT_EQ(verdict().state, State::Warning);
    EXPECT_EQ(verdict().text, "Not quite good: no pose to draw of Character 0, which sends type 24");
    EXPECT_EQ(verdict().brief, "no pose");
}

TEST_F(VerdictTest, CallsNoBodyGoodThatIsPartlyAssumed) {
    wire::PoseQuaternion pose = standingAt(0);
    pose.segments[segment::kHead].orientation[1] = std::numeric_limits<float>::quiet_NaN();
    for (std::uint32_t sample = 1; sample <= 100; ++sample, m_at += 10ms) {
        send(pose, sample, m_at);
    }
    EXPECT_EQ(verdict().state, State::Warning);
    EXPECT_EQ(verdict().text, "Not quite good: Character 0: Not sent, assumed: Head");
    EXPECT_EQ(verdict().brief, "partly assumed");
    m_session.setCursor({Cursor::Mode::Paused, 3});
    EXPECT_EQ(verdict().state, State::Warning) << "it is of now, whatever the cursor";
    m_session.setCursor({});
    for (std::uint32_t sample = 101; sample <= 110; ++sample, m_at += 10ms) {
        send(standingAt(0), sample, m_at);
    }
    EXPECT_EQ(verdict().state, State::Good);
    m_session.setCursor({Cursor::Mode::Paused, 3});
    EXPECT_EQ(verdict().state, State::Good);
}

TEST_F(VerdictTest, SaysAtOnceWhatIsNotHereYetAndThenWhatIsLost) {
    poses(1, 1'000);
    m_at += 120ms;
    poses(1'013, 1'013);
    TakeVerdict now = verdict();
    EXPECT_EQ(now.state, State::Warning);
    EXPECT_TRUE(now.text.starts_with("Not quite good: 12 samples of Character 0 not yet here, since "))
        << now.text;
    EXPECT_TRUE(now.narrow.starts_with("Not quite good, going on: 12 samples of ")) << now.narrow;
    const auto number = now.incident;
    poses(1'014, 1'050);
    now = verdict();
    EXPECT_EQ(now.state, State::Bad);
    EXPECT_TRUE(now.text.starts_with("Not good: 1")) << now.text;
    EXPECT_NE(now.text.find(" lost on Character 0, cause unknown, since "), std::string::npos) << now.text;
    EXPECT_TRUE(now.text.ends_with(", going on")) << now.text;
    EXPECT_EQ(now.incident, number) << "it keeps its number";
}

TEST_F(VerdictTest, NeverTakesANewRateForLossWhileItIsLearnt) {
    poses(1, 500);
    for (std::uint32_t sample = 504; sample <= 1'000; sample += 4, m_at += 40ms) {
        pose(sample);
        const TakeVerdict now = verdict();
        EXPECT_EQ(now.text.find("lost"), std::string::npos) << sample << ": " << now.text;
        EXPECT_NE(now.state, State::Bad) << sample << ": " << now.text;
    }
    EXPECT_EQ(of(IncidentKind::Step).size(), 1U);
    EXPECT_EQ(told(), lost());
}

TEST_F(VerdictTest, IsNotGoodWhileATypeIsMissingThatOthersOfItsCharacterGoOnWithout) {
    const auto both = [&](std::uint32_t first, std::uint32_t last, bool hasCentre) {
        for (std::uint32_t sample = first; sample <= last; ++sample, m_at += 10ms) {
            pose(sample);
            if (hasCentre) {
                send(wire::CentreOfMass{}, sample, m_at);
            }
        }
    };
    both(1, 500, true);
    EXPECT_EQ(verdict().state, State::Good);
    both(501, 525, false);
    TakeVerdict now = verdict();
    EXPECT_EQ(now.state, State::Warning);
    EXPECT_NE(now.text.find("no data of type 24 from Character 0, since "), std::string::npos) << now.text;
    EXPECT_NE(now.text.find(", going on"), std::string::npos) << now.text;
    EXPECT_EQ(now.brief, "no data of type 24");
    EXPECT_TRUE(of(IncidentKind::Step).empty()) << "it may still come";

    both(526, 800, false);
    now = verdict();
    EXPECT_NE(now.text.find("type 24 is not sent any more while others of the character go on"),
              std::string::npos)
        << now.text;
    EXPECT_EQ(now.brief, "type 24 not sent");
    EXPECT_FALSE(now.isOver) << "it is still missing";
    both(801, 2'500, false);
    EXPECT_EQ(verdict().state, State::Good) << "that is how it is sent now";
}

TEST_F(VerdictTest, ATypeThatWasMissingForAMomentWasNotEnded) {
    for (std::uint32_t sample = 1; sample <= 600; ++sample, m_at += 10ms) {
        pose(sample);
        if (sample < 500 || sample > 530) {
            send(wire::CentreOfMass{}, sample, m_at);
        }
    }
    EXPECT_TRUE(of(IncidentKind::Step).empty());
    EXPECT_EQ(of(IncidentKind::Loss).size(), 1U);
    EXPECT_TRUE(unsettledIncidents(m_session).empty());
    EXPECT_EQ(told(), lost());
}

TEST_F(VerdictTest, IsNotGoodBetweenOneRateAndTheNext) {
    poses(1, 500);
    for (std::uint32_t sample = 502; sample <= 640; sample += 2, m_at += 20ms) {
        pose(sample);
        const TakeVerdict now = verdict();
        EXPECT_EQ(now.state, State::Warning) << sample << ": " << now.text;
    }
    ASSERT_EQ(of(IncidentKind::Step).size(), 1U);
    EXPECT_EQ(of(IncidentKind::Step).front().detail, "The step of the sample counter is 2 now; it was 1.");
}

TEST_F(VerdictTest, EvenGapsAreLossOnceTheyAreNotEvenAnyMore) {
    poses(1, 500);
    for (std::uint32_t sample = 504; sample <= 540; sample += 4, m_at += 40ms) {
        pose(sample);
    }
    poses(541, 600);
    EXPECT_EQ(of(IncidentKind::Loss).size(), 1U);
    EXPECT_EQ(told(), lost());
    const auto sums = told();
    EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), std::uint64_t{0}), 30U);
}

TEST_F(VerdictTest, EvenGapsAreLossOfWhoSendsNothingMore) {
    poses(1, 500);
    for (std::uint32_t sample = 504; sample <= 540; sample += 4, m_at += 40ms) {
        pose(sample);
    }
    EXPECT_TRUE(of(IncidentKind::Loss).empty());
    EXPECT_EQ(verdictAfter(5s).state, State::Bad);
    EXPECT_EQ(of(IncidentKind::Loss).size(), 1U);
}

TEST_F(VerdictTest, AMessageWhoseRestDoesNotComeIsLostBeforeTheNextOne) {
    poses(1, 300);
    send(wire::NullPose{}, 0, m_at, 0x00);
    poses(301, 325);
    EXPECT_TRUE(of(IncidentKind::Loss).empty()) << "it may still come";
    poses(326, 400);
    const auto found = of(IncidentKind::Loss);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].cause, LossCause::Network);
    EXPECT_EQ(found[0].samples, 1U);
    EXPECT_TRUE(std::ranges::none_of(listedIncidents(m_session), [](const ListedIncident& one) {
        return one.state == ListedIncident::State::Provisional;
    }));
    send(wire::NullPose{}, 0, m_at, 0x80);
    EXPECT_EQ(of(IncidentKind::Loss)[0].samples, 1U) << "it is told once";
    EXPECT_EQ(told(), lost());
}

TEST_F(VerdictTest, NothingIsInDoubtWhereNothingMoreComes) {
    poses(1, 199);
    poses(201, 500);
    EXPECT_EQ(of(IncidentKind::Loss).size(), 1U);
    pose(200); // from so far back that the counter may have restarted
    follow();
    m_session.settle();
    EXPECT_TRUE(of(IncidentKind::Loss).empty());
    EXPECT_EQ(told(), lost());
}

TEST_F(VerdictTest, LossThatIsJudgedLateStillGoesOn) {
    // What comes more than a second late makes every judgement wait for as long.
    poses(1, 99);
    for (std::uint32_t sample = 101; sample <= 1'500; ++sample, m_at += 10ms) {
        if (sample % 20 != 0) {
            pose(sample);
        }
        if (sample == 280) {
            pose(220);
        }
        if (sample > 700 && sample % 50 == 0) {
            const TakeVerdict now = verdict();
            EXPECT_FALSE(now.isOver) << now.text;
            EXPECT_NE(now.text.find(" lost on "), std::string::npos) << now.text;
        }
    }
}

TEST_F(VerdictTest, WhatIsNotSettledKeepsItsNumberAndItsStreams) {
    poses(1, 1'000);
    EXPECT_TRUE(unsettledIncidents(m_session).empty());
    m_at += 120ms;
    poses(1'013, 1'013);
    follow();
    const auto unsettled = unsettledIncidents(m_session);
    ASSERT_EQ(unsettled.size(), 1U);
    ASSERT_EQ(unsettled[0].incident.parts.size(), 1U);
    EXPECT_EQ(unsettled[0].incident.parts[0].samples, 12U);
    EXPECT_EQ(headlineOf(m_session, unsettled[0]), "12 samples of Character 0 not yet here");
    poses(1'014, 1'050);
    follow();
    EXPECT_TRUE(unsettledIncidents(m_session).empty());
    const Incident* settled = m_session.incidents().find(unsettled[0].incident.number);
    ASSERT_NE(settled, nullptr);
    EXPECT_EQ(settled->text(settled->parts[0]), "12 samples lost, 1 gap");
    EXPECT_EQ(stateOf(m_session, *settled), ListedIncident::State::Ongoing);
}

TEST_F(VerdictTest, DoesNotClaimLossWhereSamplesAreOutOfOrder) {
    poses(1, 1'000);
    for (std::uint32_t sample = 1'001; sample < 2'000; sample += 10) {
        m_at += 10ms;
        for (std::uint32_t next = 1; next < 10; ++next, m_at += 10ms) {
            pose(sample + next);
            if (next == 4) {
                pose(sample);
            }
            EXPECT_EQ(verdict().text.find("lost"), std::string::npos) << verdict().text;
        }
    }
    EXPECT_EQ(verdict().state, State::Warning);
    EXPECT_NE(verdict().text.find("reordered"), std::string::npos) << verdict().text;
    EXPECT_EQ(told(), (std::array<std::uint64_t, kLossCauses>{}));
}

TEST_F(VerdictTest, IsNotGoodWithinAQuarterOfASecondOfSilence) {
    poses(1, 300);
    EXPECT_EQ(verdictAfter(150ms).state, State::Good);
    const TakeVerdict silent = verdictAfter(230ms);
    EXPECT_EQ(silent.state, State::Warning);
    EXPECT_NE(silent.text.find("no data from Character 0"), std::string::npos) << silent.text;
    EXPECT_EQ(verdictAfter(1'100ms).state, State::Bad);
}

TEST_F(VerdictTest, CallsNobodySilentForTheTimeThatThisProgramWasStopped) {
    poses(1, 300);
    follow();
    m_session.setHeldUp(true);
    EXPECT_EQ(verdictAfter(1'500ms).state, State::Good) << "what came meanwhile was not read yet";
    poses(301, 440);
    EXPECT_EQ(verdictAfter(10ms).state, State::Good);
    m_session.setHeldUp(false);
    EXPECT_EQ(verdictAfter(120ms).state, State::Good);
    EXPECT_TRUE(of(IncidentKind::Outage).empty());
    EXPECT_EQ(verdictAfter(1'500ms).state, State::Bad);
}

TEST_F(VerdictTest, IsNotGoodWhereTheLastThatCameIsReadMuchLater) {
    poses(1, 300);
    follow();
    poses(301, 400);
    for (const log::Duration silence : {15s, 16s}) {
        m_session.setHeldUp(silence == 15s);
        m_session.follow(m_at + silence);
    }
    EXPECT_EQ(verdictOf(m_session, recentSpan(m_session)).state, State::Bad);
    ASSERT_EQ(of(IncidentKind::Outage).size(), 1U);
    EXPECT_EQ(of(IncidentKind::Outage)[0].firstStamp, m_at - 10ms);
}

TEST(HeldUp, IsWhoWasNotAskedForLongUntilWhatCameIsRead) {
    HeldUp heldUp;
    EXPECT_FALSE(heldUp.at(log::Stamp(100s)));
    EXPECT_FALSE(heldUp.at(log::Stamp(100s + 200ms)));
    EXPECT_TRUE(heldUp.at(log::Stamp(101s)));
    EXPECT_TRUE(heldUp.at(log::Stamp(101s + 50ms)));
    EXPECT_FALSE(heldUp.at(log::Stamp(101s + 100ms)));
    EXPECT_TRUE(heldUp.at(log::Stamp(101s + 400ms)));
    EXPECT_FALSE(heldUp.at(log::Stamp(101s + 700ms))) << "so that one that is always slow judges too";
}

TEST_F(VerdictTest, TakesBackASilenceThatWhatComesLateToUsShowsToBeNone) {
    for (std::uint32_t sample = 1; sample <= 300; ++sample, m_at += 10ms) {
        pose(sample);
        poseOfOther(sample);
    }
    EXPECT_NE(verdictAfter(1'000ms).state, State::Good) << "nothing was received";
    for (std::uint32_t sample = 301; sample <= 400; ++sample, m_at += 10ms) {
        pose(sample);
        if (sample > 350) {
            poseOfOther(sample);
        }
    }
    const auto outages = of(IncidentKind::Outage);
    ASSERT_EQ(outages.size(), 1U);
    EXPECT_EQ(outages[0].characters(), std::vector<std::uint8_t>{1}) << "the first was never silent";
    EXPECT_EQ(outages[0].lastStamp - outages[0].firstStamp, 510ms) << "not until it was read";
    EXPECT_NE(outages[0].cause, LossCause::Sender) << "the other one shows what is lost";
}

TEST_F(VerdictTest, ForgetsASilenceOfNobody) {
    poses(1, 300);
    EXPECT_EQ(verdictAfter(900ms).state, State::Warning);
    poses(301, 500);
    EXPECT_TRUE(of(IncidentKind::Outage).empty());
    EXPECT_EQ(verdict().state, State::Good);
    m_at += 2s;
    poses(701, 800);
    EXPECT_EQ(of(IncidentKind::Outage).size(), 1U);
}

TEST_F(VerdictTest, MentionsWhatIsOverForTenSecondsAndThenIsGood) {
    poses(1, 300);
    m_at += 1s;
    poses(401, 500);
    TakeVerdict now = verdict();
    EXPECT_EQ(now.state, State::Warning);
    EXPECT_TRUE(now.text.ends_with(", over")) << now.text;
    EXPECT_TRUE(now.narrow.starts_with("Not quite good, over: ")) << now.narrow;
    poses(501, 1'600);
    now = verdict();
    EXPECT_EQ(now.state, State::Good);
    EXPECT_EQ(verdictOf(m_session, {}).state, State::Warning) << "of all there was";
}

TEST_F(VerdictTest, SaysWhenSomethingWasInOneTimeWhereItTookNoSecond) {
    poses(1, 300);
    EXPECT_EQ(verdict().state, State::Good);
    ListedIncident one;
    one.state = ListedIncident::State::Over;
    one.incident.kind = IncidentKind::JitterLimit;
    one.incident.sender = m_session.senders().front().id;
    one.incident.value = 12.8;
    one.incident.limit = 10;
    one.incident.firstStamp = one.incident.lastStamp = m_session.now();
    EXPECT_TRUE(headlineOf(m_session, one).ends_with(": jitter 12.8 ms, limit 10 ms"))
        << headlineOf(m_session, one);
    EXPECT_TRUE(whenOf(m_session, one).starts_with(", at ")) << whenOf(m_session, one);
    one.incident.lastStamp += 2s;
    EXPECT_NE(whenOf(m_session, one).find(" to "), std::string::npos) << whenOf(m_session, one);
}

/// What is spoken again, and what is not.
TEST_F(VerdictTest, SaysTheSameWhileOnlyItsNumbersGrow) {
    poses(1, 300);
    const TakeVerdict good = verdict();
    poses(313, 350);
    const TakeVerdict lost = verdict();
    EXPECT_FALSE(sayTheSame(good, lost));
    poses(363, 400);
    const TakeVerdict more = verdict();
    EXPECT_NE(lost.text, more.text);
    EXPECT_TRUE(sayTheSame(lost, more)) << lost.text << '\n' << more.text;
}

TEST_F(VerdictTest, OneThatLostLittleIsNotAsBadAsOneThatIsAboveItsLimit) {
    for (std::uint32_t sample = 1; sample <= 2'000; ++sample, m_at += 10ms) {
        if (sample != 1'510) {
            pose(sample);
        }
        if (sample % 50 != 0) {
            poseOfOther(sample);
        }
    }
    EXPECT_EQ(verdictOn(0).state, State::Warning) << verdictOn(0).text;
    EXPECT_EQ(verdictOn(1).state, State::Bad) << verdictOn(1).text;
    EXPECT_EQ(verdict().state, State::Bad);
    EXPECT_NE(verdict().text.find("2.0 % lost on Character 1, network, since"), std::string::npos)
        << "and is named alone: " << verdict().text;
    EXPECT_EQ(verdict().character, (CharacterKey{sender(), 1}));
}

TEST_F(VerdictTest, ItsFigureIsOfTheTimeThatItIsOf) {
    for (std::uint32_t sample = 1; sample <= 3'000; ++sample, m_at += 10ms) {
        if (sample < 500 ? sample % 7 > 2 : sample % 20 != 1) {
            pose(sample);
        }
    }
    EXPECT_TRUE(verdict().brief.starts_with("5.0 % lost, ")) << verdict().brief;
    EXPECT_NE(verdict().text.find("5.0 % lost on "), std::string::npos)
        << "as the columns beside it: " << verdict().text;
    const TakeVerdict whole = verdictOf(m_session, {});
    EXPECT_NE(whole.text.find("11 % lost on "), std::string::npos) << "of a report: " << whole.text;
    EXPECT_EQ(of(IncidentKind::Loss).size(), 1U);
    poses(3'001, 9'000);
    follow();
    const TakeVerdict later = verdictOf(m_session, {});
    EXPECT_NE(later.text.find(later.what + " on "), std::string::npos)
        << later.what << " of all the time in the board, but: " << later.text;
}

TEST_F(VerdictTest, IsOfOneCharacterWhereItIsAskedFor) {
    for (std::uint32_t sample = 1; sample <= 500; ++sample, m_at += 10ms) {
        pose(sample);
        if (sample % 20 != 0) {
            poseOfOther(sample);
        }
    }
    follow();
    EXPECT_EQ(verdictOf(m_session, {}, CharacterKey{sender(), 0}).state, State::Good);
    const TakeVerdict bad = verdictOf(m_session, {}, CharacterKey{sender(), 1});
    EXPECT_EQ(bad.state, State::Bad);
    EXPECT_EQ(bad.character, (CharacterKey{sender(), 1}));
}

TEST_F(VerdictTest, OneThatSendsNothingIsWorseOffThanOneThatLosesSome) {
    for (std::uint32_t sample = 1; sample <= 600; ++sample, m_at += 10ms) {
        if (sample <= 300) {
            poseOfOther(sample);
        }
        if (sample % 20 != 0) {
            pose(sample);
        }
    }
    EXPECT_NE(verdictOn(0).brief.find("lost"), std::string::npos) << verdictOn(0).brief;
    EXPECT_EQ(verdict().character, (CharacterKey{sender(), 1})) << verdict().text;
}

TEST_F(VerdictTest, NamesAllWhoAreSilentSinceTheFirstWas) {
    for (std::uint32_t sample = 1; sample <= 900; ++sample, m_at += 10ms) {
        if (sample <= 300) {
            poseOfOther(sample);
        }
        if (sample <= 600) {
            pose(sample);
        }
        pose(sample, "127.0.0.1:40002");
    }
    EXPECT_NE(verdictOn(1).text.find("no data from Character 1"), std::string::npos);
    const TakeVerdict said = verdict();
    EXPECT_NE(said.text.find("no data from "), std::string::npos) << said.text;
    EXPECT_NE(said.text.find(" and Character 1"), std::string::npos) << said.text;
    EXPECT_EQ(said.since, verdictOn(1).since);
}

TEST_F(VerdictTest, OneThatIsSentTwiceIsWorseOffThanOneThatLosesSome) {
    for (std::uint32_t sample = 1; sample <= 300; ++sample, m_at += 10ms) {
        if (sample % 20 != 0) {
            pose(sample);
            pose(sample, "127.0.0.1:40002");
            poseOfOther(sample);
            poseOfOther(sample, "127.0.0.1:40002");
        }
    }
    const TakeVerdict said = verdict();
    EXPECT_EQ(said.state, State::Bad);
    EXPECT_NE(said.text.find("several senders"), std::string::npos) << said.text;
    EXPECT_NE(said.text.find("Character 0 and Character 1 come"), std::string::npos) << said.text;
}

TEST_F(VerdictTest, MentionsTheOutageOfOneThatIsBackWhileAnotherIsStillSilent) {
    for (std::uint32_t sample = 1; sample <= 300; ++sample, m_at += 10ms) {
        pose(sample);
        poseOfOther(sample);
    }
    m_at += 900ms;
    poses(301, 301);
    EXPECT_EQ(verdictOn(0).state, State::Warning);
    EXPECT_TRUE(verdictOn(0).isOver) << verdictOn(0).text;
    EXPECT_FALSE(verdictOn(1).isOver) << verdictOn(1).text;
    poses(302, 1'500);
    EXPECT_EQ(verdictOn(0).state, State::Good) << verdictOn(0).text;
    EXPECT_FALSE(verdictOn(1).isOver) << verdictOn(1).text;
}

TEST_F(VerdictTest, LossThatGoesOnForAnotherIsOverForOneThatHasNoneAnyMore) {
    for (std::uint32_t sample = 1; sample <= 3'000; ++sample, m_at += 10ms) {
        if (sample > 305 || sample < 301) {
            pose(sample);
        }
        if (sample < 200 || sample % 20 != 0) {
            poseOfOther(sample);
        }
        if (sample == 700) {
            EXPECT_TRUE(verdictOn(0).isOver) << verdictOn(0).text;
            EXPECT_FALSE(verdictOn(1).isOver) << verdictOn(1).text;
            EXPECT_EQ(verdict().text.find("2 characters"), std::string::npos) << verdict().text;
        }
    }
    EXPECT_EQ(of(IncidentKind::Loss).size(), 1U) << "it is one incident all the same";
    EXPECT_EQ(verdictOn(0).state, State::Good) << verdictOn(0).text;
    EXPECT_EQ(verdictOn(1).state, State::Bad) << verdictOn(1).text;
}

TEST_F(VerdictTest, LossGoesOnForAllAsLongAsForOne) {
    // Of one character, at times that are close to each other for its two streams together.
    for (std::uint32_t sample = 1; sample <= 1'200; ++sample, m_at += 10ms) {
        if (sample < 400 || sample > 700 || sample % 18 != 0) {
            pose(sample);
        }
        if (sample < 400 || sample > 700 || sample % 18 != 9) {
            m_at += 1ms;
            send(wire::CentreOfMass{}, sample, m_at);
            m_at -= 1ms;
        }
        if (sample > 400) {
            ASSERT_EQ(verdict().isOver, verdictOn(0).isOver) << verdict().text << '\n'
                                                             << verdictOn(0).text << " at " << sample;
            ASSERT_EQ(verdict().state, verdictOn(0).state) << verdict().text << " at " << sample;
        }
    }
}

TEST_F(VerdictTest, SumsOfIncidentsAreTheSumsOfTheStreamsAtEveryMoment) {
    std::uint32_t noise = 12'345;
    const auto chance = [&noise](std::uint32_t in) {
        noise = noise * 1'664'525 + 1'013'904'223;
        return (noise >> 16) % in == 0;
    };
    std::vector<std::uint32_t> held;
    for (std::uint32_t sample = 1; sample <= 3'000; ++sample, m_at += 10ms) {
        if (sample == 1'500) {
            m_at += 700ms;
        }
        if (chance(40)) {
            held.push_back(sample);
        } else if (!chance(30)) {
            pose(sample);
        }
        if (!chance(50)) {
            send(wire::CentreOfMass{}, sample, m_at);
        }
        if (!held.empty() && chance(10)) {
            pose(held.front());
            held.erase(held.begin());
        }
        if (sample % 7 == 0) {
            follow();
            ASSERT_EQ(told(), lost()) << sample;
        }
    }
    m_session.settle();
    EXPECT_EQ(told(), lost());
    const auto sums = lost();
    EXPECT_GT(std::accumulate(sums.begin(), sums.end(), std::uint64_t{0}), 100U);
}

} // namespace
} // namespace posewire::model
