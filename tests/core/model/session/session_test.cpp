// SPDX-License-Identifier: MIT
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "tests/core/model/session/session_fixture.h"

#include <gmock/gmock.h>

#include <array>

namespace posewire::model {
namespace {

constexpr std::array<std::byte, 5> kForeign{std::byte{'{'}, std::byte{'"'}, std::byte{'a'}, std::byte{'"'},
                                            std::byte{'}'}};

TEST_F(SessionTest, ListsSenderCharacterAndStreamInOrderOfAppearance) {
    send(wire::MetaData{true, "name:Factory\n"}, 0, at(1s));
    send(standingAt(0), 1, at(2s));
    follow();
    ASSERT_EQ(m_session.roster().senders().size(), 1U);
    EXPECT_EQ(m_session.roster().senders()[0].info.address, "127.0.0.1:40001");
    ASSERT_EQ(m_session.roster().streams().size(), 2U);
    EXPECT_EQ(m_session.roster().streams()[0].key.type, 12);
    EXPECT_EQ(m_session.roster().streams()[1].key.type, 2);
    EXPECT_EQ(m_session.roster().displayName(key()), "Factory");
}

TEST_F(SessionTest, CountsForeignMalformedAndSkippedApart) {
    sendBytes(kForeign, at(1ns));
    const std::array<std::byte, 6> cut{std::byte{'M'}, std::byte{'X'}, std::byte{'T'},
                                       std::byte{'P'}, std::byte{'0'}, std::byte{'2'}};
    sendBytes(cut, at(2ns));
    log::Arrival skipped;
    skipped.sender = sender();
    skipped.flags.skipped = true;
    m_log.writer().append(kForeign, skipped);
    m_log.writer().publish();
    follow();
    const Sender& sender = m_session.roster().senders().front();
    EXPECT_EQ(sender.foreign, 1U);
    EXPECT_EQ(sender.malformed, 1U);
    EXPECT_EQ(sender.skippedBytes, kForeign.size());
    EXPECT_THAT(sender.foreignHead, testing::ElementsAreArray(kForeign));
    EXPECT_EQ(sender.foreignText(), "7b 22 61 22 7d");
}

TEST_F(SessionTest, HandsOnTheNewestMessageAsItWasDecodedWhenItCame) {
    log::PacketLog log;
    Ingest ingest(log);
    for (std::uint32_t sample = 1; sample <= 3; ++sample) {
        wire::Datagram datagram{{}, standingAt(static_cast<float>(sample)), {}};
        datagram.header.sampleCounter = sample;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        log.writer().append(*wire::encode(datagram),
                            {.stamp = at(sample * 1s), .sender = log.senders().intern({"a:1"})});
        log.writer().publish();
        ingest.follow(at(sample * 1s), 100);
        const Stream* stream =
            ingest.roll().streams().find({log::SenderId{0}, 0, wire::PoseQuaternion::kType});
        ASSERT_NE(stream, nullptr);
        EXPECT_EQ(stream->newest.datagram.header.sampleCounter, sample);
        EXPECT_EQ(stream->newest.packet, sample - 1);
    }
}

TEST_F(SessionTest, ReadsTheMessageBeforeAMalformedOneFromTheLog) {
    send(standingAt(1), 1, at(1s));
    send(standingAt(2), 2, at(2s));
    wire::Datagram datagram{{}, standingAt(3), {}};
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    const auto bytes = *wire::encode(datagram);
    sendBytes(wire::Bytes(bytes).first(100), at(3s));
    follow();
    EXPECT_EQ(m_session.roster().senders().front().malformed, 1U);
    EXPECT_EQ(m_session.roster().streams().front().accounting.malformed(), 1U);
    const Message* message = m_session.messages().message(key(), wire::PoseQuaternion::kType);
    ASSERT_NE(message, nullptr);
    EXPECT_EQ(message->datagram.header.sampleCounter, 2U);
    EXPECT_EQ(message->packet, 1U);
    EXPECT_FLOAT_EQ(static_cast<float>(m_session.messages().pose(key())->segments[0].position.x()), 2.0F);
}

TEST_F(SessionTest, GivesTheNewestPoseAndFreezesItWhenPaused) {
    send(standingAt(0), 1, at(1s));
    send(standingAt(1), 2, at(2s));
    follow();
    ASSERT_NE(m_session.messages().pose(key()), nullptr);
    EXPECT_FLOAT_EQ(static_cast<float>(m_session.messages().pose(key())->segments[0].position.x()), 1.0F);

    m_session.setCursor({Cursor::Mode::Paused, 0});
    EXPECT_FLOAT_EQ(static_cast<float>(m_session.messages().pose(key())->segments[0].position.x()), 0.0F);
    EXPECT_EQ(m_session.cursorStamp(), at(1s));

    send(standingAt(2), 3, at(3s));
    follow();
    EXPECT_FLOAT_EQ(static_cast<float>(m_session.messages().pose(key())->segments[0].position.x()), 0.0F);
    EXPECT_EQ(m_session.end(), 3U);

    m_session.setCursor({});
    EXPECT_FLOAT_EQ(static_cast<float>(m_session.messages().pose(key())->segments[0].position.x()), 2.0F);
}

TEST_F(SessionTest, PosesOfTypes01And02And05AgreeInTheOneFrame) {
    const wire::PoseQuaternion quaternion = standingAt(0.5F);
    wire::PoseEuler euler;
    wire::PoseUnity unity;
    unity.segments.resize(kBodySegmentCount);
    for (std::size_t i = 0; i < quaternion.segments.size(); ++i) {
        const auto& item = quaternion.segments[i];
        const SegmentPose pose = poseFromQuaternion(item);
        const wire::SegmentEuler e = eulerFromPose(pose);
        euler.segments.push_back({item.id, e.position, e.rotation});
        const wire::SegmentQuaternion u = unityFromPose(pose);
        const auto place = static_cast<std::size_t>(unityPlaces()[i]);
        unity.segments[place] = {static_cast<std::uint32_t>(place + 1), u.position, u.orientation};
    }
    const std::array<wire::Body, 3> bodies{quaternion, euler, unity};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        // A second apart, so that the newest type is the one that counts.
        send(bodies[i], static_cast<std::uint32_t>(i), at(std::chrono::seconds(i + 1)));
        follow();
        const CharacterPose* pose = m_session.messages().pose(key());
        ASSERT_NE(pose, nullptr);
        EXPECT_EQ(pose->segments.size(), 23U);
        for (std::size_t s = 0; s < 23; ++s) {
            const Eigen::Vector3d expected = toVector(quaternion.segments[s].position);
            EXPECT_NEAR((pose->segments[s].position - expected).norm(), 0, 2e-6)
                << "type " << int{pose->type} << " segment " << s;
            EXPECT_NEAR(pose->segments[s].orientation.angularDistance(Eigen::Quaterniond::Identity()), 0,
                        1e-6);
        }
    }
}

TEST_F(SessionTest, PrefersTheQuaternionPoseAmongTypesSentTogether) {
    wire::PoseEuler euler;
    euler.segments.push_back({1, {0, 104, 0}, {}});
    send(standingAt(0), 7, at(1s));
    send(euler, 7, at(1'001ms));
    follow();
    EXPECT_EQ(m_session.messages().pose(key())->type, 2);
}

TEST_F(SessionTest, JoinsAPoseThatCameInSeveralDatagramsOnceAllAreThere) {
    const wire::PoseQuaternion whole = standingAt(0);
    wire::PoseQuaternion first;
    wire::PoseQuaternion second;
    first.segments.assign(whole.segments.begin(), whole.segments.begin() + 12);
    second.segments.assign(whole.segments.begin() + 12, whole.segments.end());
    send(first, 5, at(1s), 0);
    follow();
    EXPECT_EQ(m_session.messages().message(key(), 2), nullptr);
    send(second, 5, at(1s), 0x81);
    follow();
    const Message* message = m_session.messages().message(key(), 2);
    ASSERT_NE(message, nullptr);
    EXPECT_EQ(std::get<wire::PoseQuaternion>(message->datagram.body), whole);

    // The first half of the next sample must not hide the last complete one.
    send(first, 6, at(2s), 0);
    follow();
    EXPECT_EQ(m_session.messages().message(key(), 2)->datagram.header.sampleCounter, 5U);
}

TEST_F(SessionTest, ComputesTheOriginsOfABodyOncePerScaleMessage) {
    send(standingAt(0), 1, at(1s));
    follow();
    EXPECT_LT(
        (m_session.messages().bodyOrigins(key()).places[segment::kHead] - referenceOrigins()[segment::kHead])
            .norm(),
        1e-6);
    wire::NullPose nullPose;
    for (const Eigen::Vector3d& origin : referenceOrigins()) {
        nullPose.segments.push_back(
            {"Segment " + std::to_string(nullPose.segments.size()), toFloats(1.1 * origin)});
    }
    send(nullPose, 0, at(2s));
    follow();
    const BodyOrigins* origins = &m_session.messages().bodyOrigins(key());
    const Eigen::Vector3d head = origins->places[segment::kHead];
    EXPECT_GT(head.z(), referenceOrigins()[segment::kHead].z());
    EXPECT_EQ(&m_session.messages().bodyOrigins(key()), origins);
    m_session.setCursor({Cursor::Mode::Paused, 0});
    EXPECT_LT(
        (m_session.messages().bodyOrigins(key()).places[segment::kHead] - referenceOrigins()[segment::kHead])
            .norm(),
        1e-6);
    m_session.setCursor({});
    EXPECT_EQ(m_session.messages().bodyOrigins(key()).places[segment::kHead], head);
}

TEST_F(SessionTest, NamesACharacterByItsIdWhereNoNameWasSentAndWhereItIsUnknown) {
    send(standingAt(0), 1, at(1s));
    follow();
    EXPECT_EQ(m_session.roster().displayName(key()), "Character 0");
    EXPECT_EQ(m_session.roster().displayName({sender(), 3}), "Character 3");
    EXPECT_EQ(m_session.roster().displayName({log::SenderId{77}, 3}), "Character 3");
}

TEST_F(SessionTest, KeepsWhatIsHiddenWithTheChoices) {
    m_session.setHidden({sender(), 1}, true);
    EXPECT_TRUE(m_session.roster().isHidden({sender(), 1}));
    EXPECT_FALSE(m_session.roster().isHidden({sender(), 0}));
    m_session.setHidden({sender(), 1}, false);
    EXPECT_FALSE(m_session.roster().isHidden({sender(), 1}));
    EXPECT_FALSE(m_session.choices().isGhostShown);
    m_session.setGhostShown(true);
    EXPECT_TRUE(m_session.choices().isGhostShown);
}

TEST_F(SessionTest, VisitsMessagesOldestFirstUpToTheCursor) {
    for (std::uint32_t sample = 0; sample < 10; ++sample) {
        send(swayingAt(0, sample), sample, at(sample * 1s));
    }
    follow();
    m_session.setCursor({Cursor::Mode::Paused, 7});
    std::vector<std::uint32_t> samples;
    const auto visited =
        m_session.messages().visit({sender(), 0, 2}, at(3s), 100, [&](const Message& message) {
            samples.push_back(message.datagram.header.sampleCounter);
        });
    EXPECT_EQ(visited, 5U);
    EXPECT_EQ(samples, (std::vector<std::uint32_t>{3, 4, 5, 6, 7}));
    EXPECT_EQ(m_session.messages().visit({sender(), 0, 2}, at(0s), 2, [](const auto&) {}), 2U);
}

TEST_F(SessionTest, FindsThePacketOfATime) {
    EXPECT_EQ(m_session.packetAt(at(1s)), 0U) << "there is none";
    for (std::uint32_t sample = 0; sample < 100; ++sample) {
        send(swayingAt(0, sample), sample, at(1s + sample * 10ms));
    }
    follow();
    EXPECT_EQ(m_session.packetAt(at(0s)), 0U);
    EXPECT_EQ(m_session.packetAt(at(1'095ms)), 9U);
    EXPECT_EQ(m_session.packetAt(at(1'100ms)), 10U);
    EXPECT_EQ(m_session.packetAt(at(100s)), 99U);
    EXPECT_EQ(m_session.packetFrom(at(0s)), 0U);
    EXPECT_EQ(m_session.packetFrom(at(1'095ms)), 10U);
    EXPECT_EQ(m_session.packetFrom(at(1'100ms)), 10U);
    EXPECT_EQ(m_session.packetFrom(at(100s)), 100U);
}

TEST_F(SessionTest, TellsTheAgeOfACharacterAgainstTheGivenTime) {
    send(standingAt(0), 1, at(1s));
    m_session.follow(at(3'200ms));
    EXPECT_NEAR(m_session.messages().ageSeconds(key()), 2.2, 1e-9);
}

TEST_F(SessionTest, FallsBackToDefaultNameAndColour) {
    send(standingAt(0), 1, at(1s));
    follow();
    EXPECT_EQ(m_session.roster().displayName(key()), "Character 0");
    EXPECT_EQ(m_session.roster().colour(key()), defaultColour(0));
    send(wire::MetaData{true, "color:e96417\n"}, 0, at(2s));
    follow();
    EXPECT_NEAR(m_session.roster().colour(key()).red, 0xe9 / 255.0, 1e-6);
}

TEST_F(SessionTest, ForgetsWhatTheLogForgetsWithoutLosingItsPlace) {
    log::PacketLog small({.memoryCap = 1, .chunkSize = std::size_t{256} << 10});
    Session session(small);
    log::Arrival arrival;
    arrival.sender = small.senders().intern({"a:1", log::Transport::Udp, 9763});
    wire::Datagram datagram;
    datagram.body = standingAt(0);
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    const auto bytes = wire::encode(datagram);
    for (int i = 0; i < 60'000; ++i) {
        small.writer().append(*bytes, arrival);
        small.writer().publish();
        if (i % 5'000 == 0) {
            session.follow({});
        }
    }
    session.follow({});
    EXPECT_EQ(session.end(), 60'000U);
    EXPECT_GT(session.begin(), 0U);
    EXPECT_NE(session.messages().message({arrival.sender, 0}, 2), nullptr);
}

} // namespace
} // namespace posewire::model
