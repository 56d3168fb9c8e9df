// SPDX-License-Identifier: MIT
#include "core/model/session/verdict.h"

#include "tests/core/model/session/verdict_fixture.h"

#include <random>
#include <utility>
#include <vector>

/// How much and whose the headline says it is.
namespace posewire::model {
namespace {

using State = TakeVerdict::State;

constexpr const char* kHere = "192.0.2.1:40001";
constexpr const char* kElsewhere = "192.0.2.2:40001";

TEST_F(VerdictTest, SaysOfWhatIsOverOrJustBeganHowMuchOfItsOwnTimeIsLost) {
    for (std::uint32_t sample = 1; sample <= 600; ++sample, m_at += 10ms) {
        if (sample < 300 || sample % 5 != 0) {
            pose(sample);
        }
    }
    EXPECT_EQ(reason().unit, Kind::Share);
    EXPECT_NEAR(reason().amount, 20, 0.5) << "not of ten seconds: " << verdict().said;
    poses(601, 1'540);
    ASSERT_EQ(of(IncidentKind::Loss).size(), 1U);
    EXPECT_EQ(of(IncidentKind::Loss)[0].samples, 61U);
    EXPECT_EQ(reason().unit, Kind::Share);
    EXPECT_NEAR(reason().amount, 20, 0.5) << "as long as it is told: " << verdict().said;
    EXPECT_EQ(reason().who, Names{"Character 0"});
}

TEST_F(VerdictTest, CountsWhatWasLostInAMomentAndIsNoShareOfAnything) {
    for (std::uint32_t sample = 1; sample <= 460; ++sample, m_at += 10ms) {
        if (sample <= 300 || sample > 380 || sample % 4 == 0) {
            pose(sample);
            poseOfOther(sample);
        }
    }
    EXPECT_EQ(reason().unit, Kind::Samples);
    EXPECT_EQ(reason().amount, 120) << verdict().said;
}

TEST_F(VerdictTest, SaysOfWhatIsOverOnlyWhatWasLostSinceTheReset) {
    for (std::uint32_t sample = 1; sample <= 700; ++sample, m_at += 10ms) {
        if (sample == 590) {
            follow();
            m_session.resetForTake();
        }
        if (sample < 300 || sample > 600 || sample % 5 != 0) {
            pose(sample);
        }
    }
    poses(701, 900);
    EXPECT_TRUE(verdict().isOver);
    EXPECT_EQ(reason().unit, Kind::Samples);
    EXPECT_EQ(reason().amount, 3) << verdict().said;
    EXPECT_EQ(reason().who, Names{"Character 0"});
}

TEST_F(VerdictTest, HoldsALossToTheLimitThereIsNowAfterAResetToo) {
    for (std::uint32_t sample = 1; sample <= 700; ++sample, m_at += 10ms) {
        if (sample < 300 || sample % 20 != 0) {
            pose(sample);
        }
    }
    EXPECT_EQ(verdict().state, State::Bad) << verdict().said;
    for (const double percent : {50.0, 0.0}) { // raised, and switched off
        Thresholds limits;
        limits.lossPercent = percent;
        m_session.setThresholds(limits);
        m_session.resetForTake();
        const auto from = static_cast<std::uint32_t>(percent == 0 ? 801 : 701);
        for (std::uint32_t sample = from; sample < from + 100; ++sample, m_at += 10ms) {
            if (sample % 20 != 0) {
                pose(sample);
            }
        }
        EXPECT_EQ(verdict().state, State::Warning) << verdict().said;
    }
}

TEST_F(VerdictTest, SaysOfWhatHappenedOnceThatItIsOverHoweverLongItWas) {
    poses(1, 300);
    posesOfOneTimeCode(301, 600);
    EXPECT_EQ(reason().kind, Kind::TimeCodeFrozen) << verdict().said;
    EXPECT_FALSE(verdict().isOver);
    m_timeCodeOff = {};
    poses(601, 720);
    EXPECT_EQ(reason().kind, Kind::TimeCodeWasFrozen) << verdict().said;
    EXPECT_NEAR(numberIn(reasonOf(verdict()), "lasted").value_or(0), 3, 0.05);
    EXPECT_TRUE(verdict().isOver) << verdict().said;
}

TEST_F(VerdictTest, KeepsToOneAnswerWhileAFewOfManyAreLostAtRandom) {
    constexpr std::uint32_t kOneIn = 200;
    std::minstd_rand random(7);
    std::vector<std::pair<State, bool>> answers;
    for (std::uint32_t sample = 1; sample <= 18'000; ++sample, m_at += 10ms) {
        const bool isFirst = sample < 100; // none is good before there is any
        if (isFirst || random() % kOneIn != 0) {
            pose(sample);
        }
        if (isFirst || random() % kOneIn != 0) {
            poseOfOther(sample);
        }
        const TakeVerdict now = sample % 10 == 0 ? verdict() : TakeVerdict();
        EXPECT_NE(now.state, State::Bad) << "half a percent: " << now.said;
        if (const std::pair answer(now.state, now.isOver);
            now.state == State::Warning && (answers.empty() || answers.back() != answer)) {
            answers.push_back(answer);
        }
    }
    EXPECT_LE(answers.size(), 9U) << "in three minutes of about 180 losses";
}

TEST_F(VerdictTest, ALossThatHoversAboutItsLimitIsBadAgainOnlySeldom) {
    std::minstd_rand random(11);
    State before = State::None;
    int changes = 0;
    for (std::uint32_t sample = 1; sample <= 18'000; ++sample, m_at += 10ms) {
        if (sample < 100 || random() % 100 != 0) {
            pose(sample);
        }
        if (sample % 10 == 0) {
            changes += std::exchange(before, verdict().state) != verdict().state ? 1 : 0;
        }
    }
    EXPECT_LE(changes, 20) << "in three minutes of one in a hundred";
}

TEST_F(VerdictTest, BurstsThatComeAgainAndAgainAreNotOverBetweenTwo) {
    std::uint32_t next = 1;
    for (int burst = 0; burst < 5; ++burst) {
        poses(next, next + 249);
        next += 250;
        for (int lost = 0; lost < 10; ++lost, next += 2) { // every second one
            m_at += 10ms;
            pose(next + 1);
            m_at += 10ms;
        }
    }
    poses(next, next + 240);
    EXPECT_FALSE(verdict().isOver) << "2.4 s after the last of five: " << verdict().said;
    poses(next + 241, next + 740);
    EXPECT_TRUE(verdict().isOver) << verdict().said;
}

TEST_F(VerdictTest, IsBadForTenSecondsOfManyThatWereLostAtOnce) {
    std::uint32_t next = 1;
    const auto sendAllBut = [&](std::uint32_t samples, std::uint32_t lost) {
        for (std::uint32_t place = 0; place < samples + lost; ++place, ++next, m_at += 10ms) {
            send(wire::CentreOfMass{}, next, m_at);
            if (place < samples) {
                pose(next);
            }
        }
    };
    sendAllBut(1'000, 10);
    const auto loseOneIn120 = [&](int times) {
        for (int time = 0; time < times; ++time) {
            sendAllBut(119, 1);
        }
    };
    loseOneIn120(4);
    EXPECT_EQ(verdict().state, State::Bad) << verdict().said;
    loseOneIn120(8);
    EXPECT_EQ(verdict().state, State::Warning) << "fewer than one in a hundred since: " << verdict().said;
    EXPECT_FALSE(verdict().isOver) << verdict().said;
    EXPECT_EQ(of(IncidentKind::Loss)[0].severity(), IncidentSeverity::Error) << "as an incident it was grave";
}

TEST_F(VerdictTest, SaysThatThisComputerIsBehind) {
    poses(1, 300);
    ASSERT_EQ(verdict().state, State::Good) << verdict().said;
    const log::Stamp until = m_at;
    poses(301, 900);
    while (m_session.now() < until + 1s) {
        m_session.follow(m_session.now() + 200ms, 5); // fewer than come
    }
    m_session.follow(m_at, 5);
    const TakeVerdict late = verdictOf(m_session, recentSpan(m_session));
    EXPECT_EQ(late.state, State::Warning);
    EXPECT_EQ(reasonOf(late).kind, Kind::Behind);
    EXPECT_EQ(numberIn(reasonOf(late), "seconds"), 5);
    EXPECT_EQ(verdict().state, State::Good) << "it has caught up: " << verdict().said;
}

TEST_F(VerdictTest, IsAsBadOfAllAsOfTheOneThatItIsAbout) {
    for (std::uint32_t sample = 1; sample <= 840; ++sample, m_at += 10ms) {
        const bool isLost = sample > 500 && sample % (sample < 600 ? 20 : 100) == 0;
        if (!isLost) {
            pose(sample);
        }
        poseOfOther(sample);
    }
    const auto losses = of(IncidentKind::Loss);
    ASSERT_EQ(losses.size(), 1U);
    EXPECT_GT(losses[0].value, losses[0].limit) << "it was above its limit";
    EXPECT_EQ(verdictOn(0).state, State::Warning) << verdictOn(0).said;
    EXPECT_EQ(verdict().state, State::Warning) << verdict().said;
    EXPECT_FALSE(verdict().isOver);
}

TEST_F(VerdictTest, NamesAllWhoWereSilentAtTheSameTime) {
    for (std::uint32_t sample = 1; sample <= 800; ++sample, m_at += 10ms) {
        if (sample < 300 || sample >= 400) {
            pose(sample, kHere);
            poseOfOther(sample, kElsewhere);
        }
    }
    ASSERT_EQ(of(IncidentKind::Outage).size(), 1U);
    EXPECT_EQ(of(IncidentKind::Outage)[0].characters().size(), 2U);
    EXPECT_EQ(reason().kind, Kind::Outage);
    EXPECT_EQ(reason().who, (Names{"Character 0", "Character 1"}));
    EXPECT_TRUE(verdict().isOver);
}

TEST_F(VerdictTest, SaysWhichOfTwoThatSendTheSameIsSilent) {
    for (std::uint32_t sample = 1; sample <= 1'000; ++sample, m_at += 10ms) {
        pose(sample, kHere);
        if (sample <= 300) {
            pose(sample, kElsewhere);
        }
    }
    EXPECT_EQ(verdict().state, State::Bad);
    EXPECT_EQ(reason().kind, Kind::Outage);
    EXPECT_EQ(reason().who, Names{"Character 0 of 192.0.2.2:40001"});
}

TEST_F(VerdictTest, WaitsForTheFirstPoseOfOneThatHasJustBegun) {
    const auto send = [this](wire::Body body) {
        wire::Datagram datagram{{}, std::move(body), {}};
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), m_at, kHere);
    };
    send(wire::TimeCode{});
    EXPECT_EQ(verdict().state, State::None) << verdict().said;
    send(standingAt(0));
    EXPECT_EQ(verdict().state, State::Good) << verdict().said;
}

TEST_F(VerdictTest, NamesThoseWhoLostAboutAsMuchAsTheWorst) {
    std::uint32_t sample = 1;
    const auto lose = [&](std::uint32_t one, std::uint32_t other) {
        for (const std::uint32_t end = sample + 2'000; sample < end; ++sample, m_at += 10ms) {
            if (sample % one != 0) {
                pose(sample);
            }
            if (sample % other != 0) {
                poseOfOther(sample);
            }
        }
    };
    lose(110, 60); // 0.9 % and 1.7 %
    EXPECT_EQ(reason().who, (Names{"Character 0", "Character 1"})) << verdict().said;
    lose(500, 50); // 0.2 % and 2 %
    EXPECT_EQ(reason().who, Names{"Character 1"}) << verdict().said;
    EXPECT_EQ(reason().unit, Kind::Share);
}

TEST_F(VerdictTest, IsNotBadForLessThanItsLimit) {
    for (std::uint32_t sample = 1; sample <= 2'000; ++sample, m_at += 10ms) {
        if (sample % 150 != 0) { // 0.67 %
            pose(sample);
        }
        if (sample % 80 != 0) { // 1.25 %, together less than the limit
            poseOfOther(sample);
        }
    }
    ASSERT_EQ(verdict().state, State::Bad) << verdict().said;
    EXPECT_GT(reason().amount, 1) << verdict().said;
    EXPECT_EQ(reason().who, Names{"Character 1"}) << "whose share it is";
}

/// Types 10 to 13 are in no share of samples, as in the figures beside it.
TEST_F(VerdictTest, CountsNoMessageAsASample) {
    for (std::uint32_t sample = 1; sample <= 2'000; ++sample, m_at += 10ms) {
        poseOfOther(sample); // so that all is lost on the network
        if (sample % 100 == 50) {
            send(wire::ScaleInformation{}, 0, m_at, 0x00); // its second part never comes
        }
        if (sample % 20 != 0) {
            pose(sample);
        }
    }
    follow();
    const Losses losses(m_session, TimeRange{recentSpan(m_session).from, m_now + 1s});
    StreamFigures sum;
    for (const Stream* stream : m_session.roster().find(CharacterKey{sender(), 0})->streams) {
        sum.add(losses.figuresOf(*stream));
    }
    EXPECT_NEAR(reason().amount, sum[Figure::LossShare], 0.05) << verdict().said;
    EXPECT_EQ(sum.count(Figure::LostOnNetwork), sum.count(Figure::Missing));
    const Incident loss = of(IncidentKind::Loss).front();
    EXPECT_EQ(partOf(loss.fact(), "gaps"), words::counted(Kind::Gaps, loss.lost())) << "each is one sample";
    EXPECT_LT(loss.lost(), loss.samples) << "all of it is in the sums of a script";
}

/// Of several streams that lose at random one is always above what all lose together.
TEST_F(VerdictTest, IsBadForWhatACharacterLostAndNotForWhatChanceGaveOneOfItsStreams) {
    const auto send = [this](std::uint32_t sample, wire::Body body) {
        wire::Datagram datagram{{}, std::move(body), {}};
        datagram.header.sampleCounter = sample;
        datagram.header.timeCode = static_cast<std::uint32_t>(m_at.time_since_epoch() / 1ms);
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), m_at, kHere);
    };
    std::uint32_t sample = 1;
    const auto lose = [&](std::uint32_t poses, std::uint32_t centres) {
        for (const std::uint32_t end = sample + 2'000; sample < end; ++sample, m_at += 10ms) {
            if (sample % poses != 0) {
                send(sample, swayingAt(0, sample));
            }
            if (sample % centres != 1) {
                send(sample, wire::CentreOfMass{});
            }
        }
    };
    lose(77, 250); // 1.3 and 0.4 %, together 0.85 %
    EXPECT_EQ(verdict().state, State::Warning) << verdict().said;
    EXPECT_EQ(of(IncidentKind::Loss)[0].severity(), IncidentSeverity::Warning) << "the list agrees";
    lose(2'500, 20);
    EXPECT_EQ(verdict().state, State::Bad) << verdict().said;
    lose(77, 70);
    EXPECT_EQ(verdict().state, State::Bad) << "none of them is by itself beyond chance: " << verdict().said;
}

TEST_F(VerdictTest, ASilenceThatIsOverMakesNoFewSamplesGrave) {
    for (std::uint32_t sample = 1; sample <= 2'000; ++sample, m_at += 10ms) {
        if (sample / 50 == 32 || sample / 50 == 33) {
            continue; // a second without anything
        }
        if (sample % 200 != 0) {
            pose(sample);
        }
        poseOfOther(sample);
    }
    ASSERT_EQ(of(IncidentKind::Outage).size(), 1U);
    EXPECT_EQ(verdict().state, State::Warning) << verdict().said;
    for (const Incident& loss : of(IncidentKind::Loss)) {
        EXPECT_EQ(loss.severity(), IncidentSeverity::Warning) << loss.samples;
    }
}

/// One that announces 40 finger segments.
wire::Datagram withFingers(wire::Body body, std::uint32_t sample) {
    wire::Datagram datagram{{}, std::move(body), {}};
    datagram.header.sampleCounter = sample;
    datagram.header.bodySegments = 23;
    datagram.header.fingerSegments = 40;
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    return datagram;
}

TEST_F(VerdictTest, IsNotGoodWhereLargeDatagramsDoNotGetHereWhole) {
    std::uint32_t sample = 0;
    const auto sendSmall = [&] {
        for (int i = 0; i < 100; ++i, m_at += 10ms) {
            sendBytes(*wire::encode(withFingers(wire::CentreOfMass{}, ++sample)), m_at);
        }
        follow();
    };
    m_session.setKernel({.fragments = 90, .reassembled = 45});
    sendSmall();
    EXPECT_TRUE(of(IncidentKind::Fragments).empty());
    m_session.setKernel({.fragments = 190, .reassembled = 45, .reassemblyFailures = 60});
    sendSmall();
    ASSERT_EQ(of(IncidentKind::Fragments).size(), 1U);
    const Incident incident = of(IncidentKind::Fragments)[0];
    EXPECT_EQ(incident.cause, LossCause::Network);
    EXPECT_TRUE(incident.isCurrent);
    EXPECT_EQ(partOf(incident.detail, "missing"), words::typesFact({1, 2, 21, 22}));
    EXPECT_EQ(verdict().state, TakeVerdict::State::Bad);
    EXPECT_EQ(reason().kind, Kind::FragmentsLost);
    // One of them gets here.
    wire::PoseQuaternion pose = standingAt(0);
    for (std::uint32_t id = 24; id <= 63; ++id) {
        pose.segments.push_back({id, {}, {1, 0, 0, 0}});
    }
    sendBytes(*wire::encode(withFingers(pose, sample)), m_at);
    sendSmall();
    EXPECT_FALSE(of(IncidentKind::Fragments)[0].isCurrent);
}

TEST_F(VerdictTest, DoesNotBlameFragmentsWhereAllDatagramsAreSmall) {
    m_session.setKernel({.fragments = 100, .reassemblyFailures = 60});
    for (std::uint32_t sample = 1; sample <= 100; ++sample, m_at += 10ms) {
        send(wire::CentreOfMass{}, sample, m_at);
    }
    follow();
    EXPECT_TRUE(of(IncidentKind::Fragments).empty());
}

} // namespace
} // namespace posewire::model
