// SPDX-License-Identifier: MIT
#include "core/model/session/held_up.h"
#include "core/model/session/listed_incidents.h"
#include "core/model/session/roster.h"
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
    EXPECT_EQ(verdict().said.kind, Kind::NoDataYet);
}

TEST_F(VerdictTest, IsGoodWhileAPoseComesAndNothingIsWrong) {
    poses(1, 200);
    EXPECT_EQ(verdict().state, State::Good);
    EXPECT_EQ(verdict().said.kind, Kind::Good);
    EXPECT_EQ(namesIn(verdict().said, "who"), Names{"1 character"});
}

TEST_F(VerdictTest, IsNotGoodWithoutAPoseToDraw) {
    for (std::uint32_t sample = 1; sample <= 100; ++sample, m_at += 10ms) {
        send(wire::CentreOfMass{}, sample, m_at);
        send(wire::LinearKinematics{}, sample, m_at);
    }
    EXPECT_EQ(verdict().state, State::Warning);
    EXPECT_EQ(reason().kind, Kind::NoPose);
    EXPECT_EQ(reason().who, Names{"Character 0"});
    EXPECT_EQ(partOf(reasonOf(verdict()), "types"), words::typesFact({21, 24}));
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
    EXPECT_EQ(reason().kind, Kind::NoPose);
    EXPECT_EQ(reason().who, (Names{"Character 0", "Character 1"}));
    EXPECT_EQ(partOf(reasonOf(verdict()), "types"), words::typesFact({24}));
}

TEST_F(VerdictTest, IsNotGoodWhereOnlyThePoseIsNotSentAnyMore) {
    for (std::uint32_t sample = 1; sample <= 2'000; ++sample, m_at += 10ms) {
        if (sample <= 300) {
            pose(sample);
        }
        send(wire::CentreOfMass{}, sample, m_at);
    }
    EXPECT_EQ(verdict().state, State::Warning);
    EXPECT_EQ(reason().kind, Kind::NoPose);
    EXPECT_EQ(partOf(reasonOf(verdict()), "types"), words::typesFact({24}));
}

TEST_F(VerdictTest, CallsNoBodyGoodThatIsPartlyAssumed) {
    for (std::uint32_t sample = 1; sample <= 100; ++sample, m_at += 10ms) {
        wire::PoseQuaternion pose = swayingAt(0, sample);
        pose.segments.pop_back();
        send(pose, sample, m_at);
    }
    EXPECT_EQ(verdict().state, State::Warning);
    const words::Fact doubt = partOf(reasonOf(verdict()), "doubt");
    EXPECT_EQ(reason().who, Names{"Character 0"});
    EXPECT_EQ(doubt.kind, Kind::SegmentsAssumed);
    EXPECT_EQ(namesIn(doubt, "segments"), Names{"Left Toe"});
    EXPECT_EQ(partOf(reasonOf(verdict()), "brief").kind, Kind::PartlyAssumed);
    m_session.setCursor({Cursor::Mode::Paused, 3});
    EXPECT_EQ(verdict().state, State::Warning) << "it is of now, whatever the cursor";
    m_session.setCursor({});
    for (std::uint32_t sample = 101; sample <= 110; ++sample, m_at += 10ms) {
        send(swayingAt(0, sample), sample, m_at);
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
    EXPECT_EQ(toldBy(now).kind, Kind::NotYetHere) << now.said;
    EXPECT_EQ(toldBy(now).who, Names{"Character 0"});
    EXPECT_EQ(partOf(reasonOf(now), "count"), words::counted(Kind::Samples, 12));
    EXPECT_EQ(partOf(now.said, "when").kind, Kind::Since);
    EXPECT_EQ(partOf(now.said, "lasts").kind, Kind::GoingOn);
    const auto number = now.incident;
    poses(1'014, 1'050);
    now = verdict();
    EXPECT_EQ(now.state, State::Bad);
    EXPECT_EQ(now.said.kind, Kind::NotGood);
    EXPECT_EQ(toldBy(now).kind, Kind::Loss) << now.said;
    EXPECT_EQ(toldBy(now).who, Names{"Character 0"});
    EXPECT_EQ(toldBy(now).cause, Kind::CauseSender);
    EXPECT_EQ(partOf(now.said, "when").kind, Kind::Since);
    EXPECT_EQ(partOf(now.said, "lasts").kind, Kind::GoingOn);
    EXPECT_EQ(now.incident, number) << "it keeps its number";
}

TEST_F(VerdictTest, NeverTakesANewRateForLossWhileItIsLearnt) {
    poses(1, 500);
    for (std::uint32_t sample = 504; sample <= 1'000; sample += 4, m_at += 40ms) {
        pose(sample);
        const TakeVerdict now = verdict();
        EXPECT_FALSE(isOfLoss(now)) << sample << ": " << now.said;
        EXPECT_NE(now.state, State::Bad) << sample << ": " << now.said;
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
    EXPECT_EQ(toldBy(now).kind, Kind::TypesMissing) << now.said;
    EXPECT_EQ(toldBy(now).who, Names{"Character 0"});
    EXPECT_EQ(partOf(reasonOf(now), "missing"), words::typesFact({24}));
    EXPECT_EQ(partOf(now.said, "lasts").kind, Kind::GoingOn);
    EXPECT_TRUE(of(IncidentKind::Step).empty()) << "it may still come";

    both(526, 800, false);
    now = verdict();
    EXPECT_EQ(toldBy(now).kind, Kind::TypesEnded) << now.said;
    EXPECT_EQ(namesIn(reasonOf(now), "types"), Names{"24"});
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
        EXPECT_EQ(now.state, State::Warning) << sample << ": " << now.said;
    }
    ASSERT_EQ(of(IncidentKind::Step).size(), 1U);
    const words::Fact step = of(IncidentKind::Step).front().detail;
    EXPECT_EQ(step.kind, Kind::StepChanged);
    EXPECT_EQ(numberIn(step, "before"), 1);
    EXPECT_EQ(numberIn(step, "step"), 2);
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
            EXPECT_FALSE(now.isOver) << now.said;
            EXPECT_TRUE(isOfLoss(now)) << now.said;
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
    EXPECT_EQ(factOf(m_session, unsettled[0]).kind, Kind::NotYetHere);
    EXPECT_EQ(namesIn(factOf(m_session, unsettled[0]), "who"), Names{"Character 0"});
    poses(1'014, 1'050);
    follow();
    EXPECT_TRUE(unsettledIncidents(m_session).empty());
    const Incident* settled = m_session.verdicts().incidents().find(unsettled[0].incident.number);
    ASSERT_NE(settled, nullptr);
    const words::Fact part = settled->fact(settled->parts[0]);
    EXPECT_EQ(toldIn(part).amount, 12);
    EXPECT_EQ(partOf(part, "gaps"), words::counted(Kind::Gaps, 1));
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
            EXPECT_FALSE(isOfLoss(verdict())) << verdict().said;
        }
    }
    EXPECT_EQ(verdict().state, State::Warning);
    EXPECT_EQ(reason().kind, Kind::Reordered) << verdict().said;
    EXPECT_EQ(told(), (std::array<std::uint64_t, kLossCauses>{}));
}

TEST_F(VerdictTest, IsNotGoodWithinAQuarterOfASecondOfSilence) {
    poses(1, 300);
    EXPECT_EQ(verdictAfter(150ms).state, State::Good);
    const TakeVerdict silent = verdictAfter(230ms);
    EXPECT_EQ(silent.state, State::Warning);
    EXPECT_EQ(toldBy(silent).kind, Kind::Outage) << silent.said;
    EXPECT_EQ(toldBy(silent).who, Names{"Character 0"});
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
    ASSERT_EQ(outages[0].characters().size(), 1U) << "the first was never silent";
    EXPECT_EQ(outages[0].characters()[0].character, 1);
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
    EXPECT_EQ(partOf(now.said, "lasts").kind, Kind::Over) << now.said;
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
    one.incident.sender = m_session.roster().senders().front().id;
    one.incident.value = 12.8;
    one.incident.limit = 10;
    one.incident.firstStamp = one.incident.lastStamp = m_session.now();
    const words::Fact jitter = factOf(m_session, one);
    EXPECT_EQ(jitter.kind, Kind::JitterLimit);
    EXPECT_EQ(numberIn(jitter, "value"), 12.8);
    EXPECT_EQ(numberIn(jitter, "limit"), 10);
    EXPECT_EQ(whenOf(m_session, one).kind, Kind::At) << whenOf(m_session, one);
    one.incident.lastStamp += 2s;
    EXPECT_EQ(whenOf(m_session, one).kind, Kind::FromTo) << whenOf(m_session, one);
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
    EXPECT_NE(lost.said, more.said);
    EXPECT_TRUE(sayTheSame(lost, more)) << lost.said << '\n' << more.said;
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
    EXPECT_EQ(verdictOn(0).state, State::Warning) << verdictOn(0).said;
    EXPECT_EQ(verdictOn(1).state, State::Bad) << verdictOn(1).said;
    EXPECT_EQ(verdict().state, State::Bad);
    EXPECT_EQ(reason().unit, Kind::Share);
    EXPECT_NEAR(reason().amount, 2, 0.05);
    EXPECT_EQ(reason().who, Names{"Character 1"}) << "is named alone: " << verdict().said;
    EXPECT_EQ(reason().cause, Kind::CauseNetwork);
    EXPECT_EQ(verdict().character, (CharacterKey{sender(), 1}));
}

TEST_F(VerdictTest, ItsFigureIsOfTheTimeThatItIsOf) {
    for (std::uint32_t sample = 1; sample <= 3'000; ++sample, m_at += 10ms) {
        if (sample < 500 ? sample % 7 > 2 : sample % 20 != 1) {
            pose(sample);
        }
    }
    EXPECT_EQ(reason().unit, Kind::Share);
    EXPECT_NEAR(reason().amount, 5, 0.05) << "as the columns beside it: " << verdict().said;
    const TakeVerdict whole = verdictOf(m_session, {});
    EXPECT_NEAR(toldBy(whole).amount, 11, 0.5) << "of a report: " << whole.said;
    EXPECT_EQ(of(IncidentKind::Loss).size(), 1U);
    poses(3'001, 9'000);
    follow();
    EXPECT_NEAR(toldBy(verdictOf(m_session, {})).amount, 11, 0.5) << "however long ago it was";
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
    EXPECT_TRUE(isOfLoss(verdictOn(0))) << verdictOn(0).said;
    EXPECT_EQ(verdict().character, (CharacterKey{sender(), 1})) << verdict().said;
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
    EXPECT_EQ(toldBy(verdictOn(1)).kind, Kind::Outage);
    EXPECT_EQ(toldBy(verdictOn(1)).who, Names{"Character 1"});
    EXPECT_EQ(reason().kind, Kind::Outage);
    const std::string said = words::say(verdict().said, words::Form::Headline);
    EXPECT_NE(said.find("no data from Character 0"), std::string::npos) << said;
    EXPECT_NE(said.find(" and Character 1"), std::string::npos) << said;
    EXPECT_EQ(verdict().since, verdictOn(1).since);
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
    EXPECT_EQ(verdict().state, State::Bad);
    EXPECT_EQ(reason().kind, Kind::SentTwice) << verdict().said;
    EXPECT_EQ(reason().who, (Names{"Character 0", "Character 1"}));
}

TEST_F(VerdictTest, MentionsTheOutageOfOneThatIsBackWhileAnotherIsStillSilent) {
    for (std::uint32_t sample = 1; sample <= 300; ++sample, m_at += 10ms) {
        pose(sample);
        poseOfOther(sample);
    }
    m_at += 900ms;
    poses(301, 301);
    EXPECT_EQ(verdictOn(0).state, State::Warning);
    EXPECT_TRUE(verdictOn(0).isOver) << verdictOn(0).said;
    EXPECT_FALSE(verdictOn(1).isOver) << verdictOn(1).said;
    poses(302, 1'500);
    EXPECT_EQ(verdictOn(0).state, State::Good) << verdictOn(0).said;
    EXPECT_FALSE(verdictOn(1).isOver) << verdictOn(1).said;
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
            EXPECT_TRUE(verdictOn(0).isOver) << verdictOn(0).said;
            EXPECT_FALSE(verdictOn(1).isOver) << verdictOn(1).said;
            EXPECT_EQ(reason().who, Names{"Character 1"}) << verdict().said;
        }
    }
    EXPECT_EQ(of(IncidentKind::Loss).size(), 1U) << "it is one incident all the same";
    EXPECT_EQ(verdictOn(0).state, State::Good) << verdictOn(0).said;
    EXPECT_EQ(verdictOn(1).state, State::Bad) << verdictOn(1).said;
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
            ASSERT_EQ(verdict().isOver, verdictOn(0).isOver) << verdict().said << '\n'
                                                             << verdictOn(0).said << " at " << sample;
            ASSERT_EQ(verdict().state, verdictOn(0).state) << verdict().said << " at " << sample;
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
