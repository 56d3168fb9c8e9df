// SPDX-License-Identifier: MIT
#include "tests/core/model/content/content_fixture.h"

#include "core/model/body/pose_remark.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/performer/sending.h"

#include <bit>
#include <limits>
#include <optional>

/// What is sent broken, each fault alone: found, named, graded, and over when it is.
namespace posewire::model {
namespace {

using State = TakeVerdict::State;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// The same pose again and again, from the first that is seen on.
ContentChange frozen() {
    return [held = std::optional<wire::PoseQuaternion>()](wire::Datagram& datagram) mutable {
        if (auto* pose = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
            held = held.value_or(*pose);
            *pose = *held;
        }
    };
}

TEST_F(ContentTest, AFrozenPoseIsBadSinceItIs) {
    m_settings.motion = "idle";
    perform(2);
    perform(0.9, frozen());
    EXPECT_TRUE(told().empty()) << "it may be a hiccup";
    perform(0.5, frozen());
    EXPECT_TRUE(told().empty()) << "another pose, and another time";
    perform(1.5, frozen());
    const Incident one = only(ContentFault::Frozen);
    EXPECT_EQ(one.detail.kind, words::Kind::PoseFrozen);
    EXPECT_EQ(one.severity(), IncidentSeverity::Error);
    EXPECT_EQ(one.cause, LossCause::Sender);
    EXPECT_EQ(one.character(), verdict().character);
    EXPECT_EQ(one.firstStamp, stampOf(204)) << "when the pose came first";
    EXPECT_EQ(verdict().state, State::Bad);
    EXPECT_EQ(partOf(verdict().said, "reason").kind, words::Kind::PoseFrozen);
    EXPECT_EQ(m_session.verdicts().of(*verdict().character).state, State::Bad);
    perform(0.1);
    EXPECT_FALSE(only(ContentFault::Frozen).isCurrent);
    EXPECT_TRUE(verdict().isOver);
    perform(12);
    EXPECT_EQ(verdict().state, State::Good);
}

TEST_F(ContentTest, WhatIsFrozenOfSeveralPerformersIsToldOfAll) {
    m_settings.characters = 3;
    std::map<std::uint8_t, ContentChange> holds;
    perform(2, [&](wire::Datagram& datagram) {
        if (datagram.header.character != 1) {
            holds.try_emplace(datagram.header.character, frozen()).first->second(datagram);
        }
    });
    EXPECT_EQ(of(ContentFault::Frozen).size(), 2U);
    EXPECT_EQ(namesIn(partOf(verdict().said, "reason"), "who").size(), 2U);
}

TEST_F(ContentTest, OrientationsOfZeroAreNamedAsSent) {
    perform(1, ofEach([](auto& segment) { segment.orientation = {}; }));
    const Incident one = only(ContentFault::Orientation);
    EXPECT_EQ(one.detail.kind, words::Kind::OrientationsZero);
    EXPECT_EQ(partOf(one.detail, "segments"), words::counted(words::Kind::Segments, 23));
    EXPECT_EQ(verdict().state, State::Bad);
    const PoseRemark remark = m_session.messages().poseRemark(m_session.roster().listed().front()->key);
    EXPECT_EQ(remark.reason.kind, words::Kind::SegmentsBroken) << "they were sent";
    EXPECT_EQ(std::ranges::count(remark.lines, words::Kind::SegmentsAssumed, &words::Fact::kind), 0);
}

TEST_F(ContentTest, OrientationsFarFromUnitAreNamed) {
    perform(1, ofSegments([](auto& segments) {
                segments[3].orientation = {3, 0, 0, 0};
                segments[4].orientation = {0.1F, 0, 0, 0.1F};
            }));
    const Incident one = only(ContentFault::Orientation);
    EXPECT_EQ(one.detail.kind, words::Kind::OrientationsFar);
    EXPECT_EQ(partOf(one.detail, "segments"), words::counted(words::Kind::Segments, 2));
}

TEST_F(ContentTest, NumbersThatAreNoneOrAbsurdAreNamed) {
    perform(1, ofEach([](auto& segment) { segment.position[1] = kNaN; }));
    EXPECT_EQ(only(ContentFault::Number).detail.kind, words::Kind::NumbersNotFinite);
    EXPECT_EQ(verdict().state, State::Bad);
    perform(1);
    EXPECT_FALSE(only(ContentFault::Number).isCurrent);
    perform(1, ofSegments([](auto& segments) { segments[7].position[0] = 3e9F; }));
    ASSERT_EQ(of(ContentFault::Number).size(), 2U);
    EXPECT_EQ(of(ContentFault::Number).back().detail.kind, words::Kind::PositionsAbsurd);
}

TEST_F(ContentTest, OneDamagedDatagramIsNoFaultOfTheSender) {
    int sample = 0;
    perform(20, ofEach([&](auto& segment) {
                if (++sample / 23 % 10 == 0) {
                    segment.position[0] = kNaN;
                }
            }));
    EXPECT_TRUE(told().empty()) << testing::PrintToString(told());
}

TEST_F(ContentTest, NumbersWithTheirBytesInTheOtherOrderAreNamed) {
    const auto swap = [](auto& numbers) {
        for (float& number : numbers) {
            number = std::bit_cast<float>(__builtin_bswap32(std::bit_cast<std::uint32_t>(number)));
        }
    };
    perform(1, ofEach([&](auto& segment) {
                swap(segment.position);
                swap(segment.orientation);
            }));
    EXPECT_EQ(only(ContentFault::ByteOrder).detail.kind, words::Kind::NumbersSwapped);
    EXPECT_EQ(verdict().state, State::Bad);
}

TEST_F(ContentTest, WhatTheHeaderAnnouncesAndDoesNotComeIsMissing) {
    perform(1, [](wire::Datagram& datagram) {
        datagram.header.fingerSegments = 40;
        datagram.header.props = 1;
    });
    const Incident one = only(ContentFault::Missing);
    EXPECT_EQ(namesIn(one.detail, "parts"), (std::vector<std::string>{"1 prop", "40 finger segments"}));
    EXPECT_EQ(verdict().state, State::Bad);
}

TEST_F(ContentTest, OneOfAllSegmentsIsNoBody) {
    const auto leaveOne = [](wire::Datagram& datagram) {
        if (auto* pose = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
            pose->segments.resize(1);
            datagram.header.items = 1;
            datagram.header.payloadSize = 32;
        }
    };
    perform(1, leaveOne);
    EXPECT_EQ(namesIn(only(ContentFault::Missing).detail, "parts"),
              (std::vector<std::string>{"22 segments"}));
}

TEST_F(ContentTest, WithoutCountsInTheHeaderWhatCameBeforeIsMissing) {
    m_settings.revision = performer::Revision::K;
    perform(1);
    EXPECT_TRUE(told().empty());
    perform(1, [](wire::Datagram& datagram) {
        if (auto* pose = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
            pose->segments.resize(1);
            datagram.header.items = 1;
        }
    });
    EXPECT_EQ(namesIn(only(ContentFault::Missing).detail, "parts"),
              (std::vector<std::string>{"22 segments"}));
}

TEST_F(ContentTest, MillimetresAreNamedAndReadAsSuch) {
    perform(1, ofEach([](auto& segment) {
                for (float& place : segment.position) {
                    place *= 1000;
                }
            }));
    const Incident one = only(ContentFault::Units);
    EXPECT_EQ(partOf(one.detail, "looks").kind, words::Kind::Millimetres);
    EXPECT_EQ(numberIn(one.detail, "factor"), 1000);
    const CharacterPose* pose = m_session.messages().pose(m_session.roster().listed().front()->key);
    ASSERT_NE(pose, nullptr);
    EXPECT_NEAR(pose->segments.front().position.z(), 0.95, 0.15);
}

TEST_F(ContentTest, IdsThatBeginAtZeroAreReadByPlace) {
    perform(1, ofEach([](auto& segment) { --segment.id; }));
    EXPECT_EQ(only(ContentFault::Ids).detail.kind, words::Kind::IdsFromZero);
    const CharacterKey key = m_session.roster().listed().front()->key;
    const CharacterPose* pose = m_session.messages().pose(key);
    ASSERT_NE(pose, nullptr);
    EXPECT_GT(pose->segments[segment::kHead].position.z(), pose->segments[segment::kNeck].position.z());
    EXPECT_TRUE(m_session.messages().poseRemark(key).isEmpty()) << "all was sent";
}

TEST_F(ContentTest, IdsThatComeTwiceAreNamed) {
    perform(1, ofSegments([](auto& segments) { segments[9].id = segments[10].id = 3; }));
    const auto found = of(ContentFault::Ids);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].detail.kind, words::Kind::IdsRepeat);
    EXPECT_EQ(partOf(found[0].detail, "segments"), words::counted(words::Kind::Segments, 2));
}

TEST_F(ContentTest, AnImpossibleJumpIsToldOnceAndIsOverAtOnce) {
    perform(1);
    perform(1, ofEach([](auto& segment) { segment.position[0] += 3; }));
    const Incident one = only(ContentFault::Jump);
    EXPECT_EQ(one.detail.kind, words::Kind::PelvisJumped);
    EXPECT_NEAR(*numberIn(one.detail, "value"), 3, 0.05);
    EXPECT_EQ(one.severity(), IncidentSeverity::Warning);
    EXPECT_EQ(one.firstStamp, stampOf(60));
    perform(1, ofEach([](auto& segment) { segment.position[0] += 3; }));
    EXPECT_EQ(listedIncidents(m_session).back().state, ListedIncident::State::Over);
    perform(12, ofEach([](auto& segment) { segment.position[0] += 3; }));
    EXPECT_EQ(verdict().state, State::Good);
}

TEST_F(ContentTest, ACounterThatStandsIsNoDuplicate) {
    perform(1, [](wire::Datagram& datagram) { datagram.header.sampleCounter = 4; });
    EXPECT_EQ(only(ContentFault::Counter).cause, LossCause::Sender);
    EXPECT_TRUE(of(IncidentKind::Duplicates).empty());
    EXPECT_EQ(verdict().state, State::Warning);
    EXPECT_NE(m_session.messages().pose(m_session.roster().listed().front()->key), nullptr);
}

TEST_F(ContentTest, APartOfEverySampleThatNeverComesIsOfTheSender) {
    performer::Performer performer(m_settings);
    for (; m_frame < 240; ++m_frame) {
        const bool isWhole = m_frame < 60;
        for (const wire::Datagram& datagram : performer.frame(m_frame)) {
            if (datagram.header.type() != wire::PoseQuaternion::kType) {
                continue;
            }
            auto parts = performer::splitSample(*wire::encode(datagram), 3);
            parts.resize(isWhole ? 3 : 2);
            for (const auto& part : parts) {
                send(part, stampOf(m_frame));
            }
        }
        m_session.follow(m_now);
    }
    const Incident found = only(ContentFault::Framing);
    EXPECT_EQ(found.cause, LossCause::Sender);
    EXPECT_LT(found.firstStamp, stampOf(75));
    const Stream& stream = *m_session.roster().listed().front()->streams.front();
    EXPECT_EQ(stream.accounting.counts().incomplete, 180U);
    EXPECT_LE(stream.lostByCause()[static_cast<std::size_t>(LossCause::Network)], 4U) << "before it is known";
}

TEST_F(ContentTest, ATimeCodeOfAnotherSpeedIsToldWithIt) {
    perform(1.2, [](wire::Datagram& datagram) { datagram.header.timeCode *= 3; });
    const Incident one = only(ContentFault::TimeCode);
    EXPECT_NEAR(*numberIn(one.detail, "value"), 3, 0.1);
    perform(1, [](wire::Datagram& datagram) { datagram.header.timeCode *= 3; });
    EXPECT_TRUE(only(ContentFault::TimeCode).isCurrent);
}

TEST_F(ContentTest, ATimeCodeThatDriftsAgainstItsHeaderIsOfTheClock) {
    m_settings.types = {2, 12, 13, 25};
    perform(1);
    EXPECT_TRUE(of(IncidentKind::TimeCode).empty());
    perform(2, [](wire::Datagram& datagram) {
        datagram.header.timeCode += (datagram.header.timeCode - 1000) / 100; // by 1 %
    });
    ASSERT_EQ(of(IncidentKind::TimeCode).size(), 1U);
    EXPECT_EQ(of(IncidentKind::TimeCode)[0].detail.kind, words::Kind::TimeCodesDrift);
    EXPECT_TRUE(told().empty()) << testing::PrintToString(told());
}

TEST_F(ContentTest, ClocksOfTwoHostsThatAreApartAreToldOnceWithTheDifference) {
    m_settings.types = {2, 25};
    m_settings.startTimeOfDayMs = 100'000; // as the stamps are
    const auto sendBoth = [&](double seconds, int apartMs) {
        performer::Performer performer(m_settings);
        for (const std::uint64_t end = m_frame + static_cast<std::uint64_t>(60 * seconds); m_frame < end;
             ++m_frame) {
            for (wire::Datagram& datagram : performer.frame(m_frame)) {
                send(*wire::encode(datagram), stampOf(m_frame));
                if (auto* message = std::get_if<wire::TimeCode>(&datagram.body)) {
                    const auto second = (message->milliseconds() + apartMs) / 1000 % 60;
                    message->text[6] = static_cast<char>('0' + second / 10);
                    message->text[7] = static_cast<char>('0' + second % 10);
                }
                send(*wire::encode(datagram), stampOf(m_frame), "127.0.0.2:40001");
            }
        }
        m_session.follow(m_now);
    };
    sendBoth(3, 0);
    sendBoth(0.5, 8000);
    sendBoth(3, 0);
    EXPECT_TRUE(of(IncidentKind::TimeCode).empty()) << "damaged, as long as one look sees it";
    sendBoth(3, 3000);
    ASSERT_EQ(of(IncidentKind::TimeCode).size(), 1U);
    EXPECT_EQ(of(IncidentKind::TimeCode)[0].detail.kind, words::Kind::ClocksApart);
    EXPECT_NEAR(*numberIn(of(IncidentKind::TimeCode)[0].detail, "value"), 3, 0.1);
}

TEST_F(ContentTest, AFloorFarFromZeroIsToldWithItsHeight) {
    perform(2, ofEach([](auto& segment) { segment.position[2] += 1; }));
    const Incident one = only(ContentFault::Floor);
    EXPECT_NEAR(*numberIn(one.detail, "value"), 1, 0.15);
    EXPECT_EQ(verdict().state, State::Warning);
    EXPECT_EQ(factsOf(ContentFault::Floor).word, "convention");
}

TEST_F(ContentTest, ANullPoseOfAnotherBodyIsAnIncidentOfItsTime) {
    perform(4);
    const auto larger = [](wire::Datagram& datagram) {
        if (auto* part = std::get_if<wire::NullPose>(&datagram.body)) {
            for (wire::NullPoseSegment& segment : part->segments) {
                for (float& place : segment.position) {
                    place *= 1.3F;
                }
            }
        }
    };
    perform(5, larger); // it is sent each five seconds
    auto found = of(IncidentKind::Scale);
    ASSERT_EQ(found.size(), 1U) << testing::PrintToString(told());
    EXPECT_EQ(partOf(found[0].detail, "what").kind, words::Kind::LongerThanScale);
    EXPECT_NEAR(log::secondsOf(found[0].firstStamp - stampOf(300)), 0, 0.51);
    EXPECT_EQ(verdict().state, State::Warning);
    EXPECT_EQ(verdict().incident, found[0].number);
    perform(2);
    EXPECT_FALSE(of(IncidentKind::Scale).front().isCurrent);
    EXPECT_NEAR(log::secondsOf(of(IncidentKind::Scale).front().lastStamp - stampOf(600)), 0, 0.51);
}

TEST_F(ContentTest, WhatIsNotSentAnyMoreIsOver) {
    perform(2, frozen());
    EXPECT_TRUE(only(ContentFault::Frozen).isCurrent);
    m_frame += 300;
    m_settings.types = {12};
    perform(1);
    EXPECT_FALSE(only(ContentFault::Frozen).isCurrent);
    EXPECT_LT(only(ContentFault::Frozen).lastStamp, stampOf(125));
}

} // namespace
} // namespace posewire::model
