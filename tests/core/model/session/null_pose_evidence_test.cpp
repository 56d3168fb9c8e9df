// SPDX-License-Identifier: MIT
#include "tests/core/model/session/session_fixture.h"
#include "tests/support/facts.h"

#include "core/model/body/null_pose_findings.h"
#include "core/model/body/points.h"
#include "core/model/session/messages.h"
#include "core/model/session/verdict.h"

#include <limits>
#include <string>
#include <vector>

/// What the scale messages of a character are judged by, at the cursor.
namespace posewire::model {
namespace {

class EvidenceTest : public SessionTest {
protected:
    /// The reference body, `scale` times as large, with a name for each segment.
    static wire::NullPose bodyOf(double scale) {
        wire::NullPose body;
        const ReferenceBody reference = makeReferenceBody();
        for (int i = 0; i < kBodySegmentCount; ++i) {
            body.segments.push_back({std::string(bodySegments()[static_cast<std::size_t>(i)].name),
                                     toFloats(scale * reference.nullPoseOrigin(i))});
        }
        return body;
    }
    static wire::NullPose pointsOf(std::uint16_t segment) {
        wire::NullPose points;
        points.points.push_back({segment, 1, std::string(findPoint(segment - 1, 1)->name), 0, {}});
        return points;
    }
    static wire::ScaleInformation scaleOf(std::size_t count) {
        wire::ScaleInformation scale;
        for (std::uint32_t id = 1; id <= count; ++id) {
            scale.segments.push_back({id, {}, {1, 0, 0, 0, 1, 0, 0, 0, 1}});
        }
        return scale;
    }
    void sendFrom(const std::string& address, wire::Body body, std::uint32_t sample, log::Stamp stamp,
                  std::uint8_t datagramCounter = 0x80) {
        wire::Datagram datagram{{}, std::move(body), {}};
        datagram.header.sampleCounter = sample;
        datagram.header.datagramCounter = datagramCounter;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), stamp, address);
    }
    NullPoseEvidence evidence() {
        follow();
        return m_session.messages().nullPoseEvidence(key());
    }
    NullPoseEvidence evidenceAt(std::uint64_t packet) {
        follow();
        m_session.setCursor({Cursor::Mode::Paused, packet});
        return m_session.messages().nullPoseEvidence(key());
    }
};

TEST_F(EvidenceTest, IsNothingOfAnUnknownCharacter) {
    m_session.follow(at(7s));
    const NullPoseEvidence none = m_session.messages().nullPoseEvidence(key());
    EXPECT_EQ(none.record.pose, nullptr);
    EXPECT_EQ(none.record.messages, 0U);
    EXPECT_EQ(none.scale, nullptr);
    EXPECT_FALSE(none.layout.has_value());
    EXPECT_EQ(none.poseSeconds, 0);
    EXPECT_EQ(none.now, at(7s));
}

TEST_F(EvidenceTest, CountsForHowLongPosesHaveCome) {
    for (std::uint32_t i = 0; i <= 1'200; ++i) {
        send(swayingAt(0, i), i, at(5s) + i * 10ms);
    }
    EXPECT_DOUBLE_EQ(evidence().poseSeconds, 12);
    ASSERT_TRUE(evidence().layout.has_value());
    EXPECT_EQ(*evidence().layout, SegmentLayout{});
    const auto findings = findContradictions(evidence());
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].fact.kind, words::Kind::NoScaleMessage);
    EXPECT_DOUBLE_EQ(evidenceAt(500).poseSeconds, 5);
    EXPECT_TRUE(findContradictions(evidenceAt(500)).empty()) << "not overdue yet";
}

TEST_F(EvidenceTest, IsThatOfTheCursor) {
    send(standingAt(0), 1, at(1s));
    send(bodyOf(1), 0, at(2s));
    send(bodyOf(1), 0, at(7s));
    send(bodyOf(1.1), 0, at(12s));
    EXPECT_EQ(evidence().record.messages, 3U);
    EXPECT_NE(evidence().record.before, nullptr);
    EXPECT_EQ(evidence().record.changed, at(12s));
    EXPECT_EQ(evidence().record.repetition, 5s);
    EXPECT_EQ(evidenceAt(2).record.messages, 2U);
    EXPECT_EQ(evidenceAt(2).record.before, nullptr);
    EXPECT_EQ(evidenceAt(2).now, at(7s));
    EXPECT_EQ(evidenceAt(1).record.messages, 1U);
    EXPECT_EQ(evidenceAt(0).record.pose, nullptr);
    EXPECT_EQ(evidenceAt(99).record.messages, 3U) << "beyond the newest packet is the newest";
}

TEST_F(EvidenceTest, ComesFromTheSenderBeforeWhereThisOneHasSentNone) {
    sendFrom("127.0.0.1:40000", bodyOf(1.05), 0, at(1s));
    send(standingAt(0), 1, at(2s));
    EXPECT_EQ(evidence().record.messages, 1U);
    ASSERT_NE(evidence().record.pose, nullptr);
    EXPECT_EQ(evidence().record.pose->segments.size(), 23U);
    send(bodyOf(0.95), 0, at(3s));
    EXPECT_EQ(evidence().record.pose->packet, 2U) << "its own counts from when it has come";
    EXPECT_EQ(evidence().record.before, nullptr) << "and is no change: another body began";
}

TEST_F(EvidenceTest, KnowsThePartsThatAreMissing) {
    send(bodyOf(1), 0, at(1s), 0x00);
    send(pointsOf(2), 0, at(1s), 0x82);
    ASSERT_NE(evidence().record.newest, nullptr);
    EXPECT_EQ(evidence().record.newest->missingParts, (std::vector<unsigned>{1}));
    m_session.follow(at(1s) + 500ms);
    EXPECT_TRUE(findContradictions(m_session.messages().nullPoseEvidence(key())).empty())
        << "it may still come";
    m_session.follow(at(3s));
    const auto findings = findContradictions(m_session.messages().nullPoseEvidence(key()));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].fact.kind, words::Kind::PartsMissing);
    send(pointsOf(1), 0, at(4s), 0x01);
    EXPECT_TRUE(evidence().record.newest->isComplete());
    EXPECT_TRUE(findContradictions(evidence()).empty());
}

TEST_F(EvidenceTest, HasTheNewestScaleOfTheDeprecatedType) {
    send(scaleOf(23), 0, at(1s));
    send(standingAt(0), 1, at(2s));
    ASSERT_NE(evidence().scale, nullptr);
    EXPECT_EQ(evidence().scale->segments.size(), 23U);
    send(scaleOf(7), 0, at(3s));
    EXPECT_EQ(evidence().scale->segments.size(), 7U);
    EXPECT_EQ(evidenceAt(1).scale->segments.size(), 23U);
}

/// Findings about type 10, as they are read from the wire.
class ScaleFindings : public EvidenceTest {
protected:
    std::vector<NullPoseFinding> findings() {
        const NullPoseEvidence all = evidence();
        return findContradictions(all);
    }
};

TEST_F(ScaleFindings, AreNoneWhereBothTypesAgree) {
    wire::ScaleInformation scale = scaleOf(23);
    const wire::NullPose body = bodyOf(1.08);
    const wire::NullPose start = bodyOf(1);
    for (std::size_t i = 0; i < 23; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            scale.segments[i].offset[axis] =
                body.segments[i].position[axis] - start.segments[i].position[axis];
        }
    }
    send(body, 0, at(1s));
    send(scale, 0, at(2s));
    EXPECT_TRUE(findings().empty()) << findings()[0].fact;
}

TEST_F(ScaleFindings, NameSegmentsWhoseMatrixCannotBeUsed) {
    for (const float diagonal :
         {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        SCOPED_TRACE(diagonal);
        wire::ScaleInformation scale = scaleOf(23);
        scale.segments[4].matrix[8] = diagonal;
        send(scale, 0, m_now + 1s);
        const auto found = findings();
        ASSERT_EQ(found.size(), 2U) << "and that no other type was sent";
        EXPECT_EQ(found[0].fact.kind, words::Kind::MatricesUnusable);
        EXPECT_EQ(found[0].severity(), Severity::Warning);
        EXPECT_EQ(namesIn(found[0].fact, "segments"), std::vector<std::string>{"5"});
    }
}

TEST_F(ScaleFindings, ListNoMoreThanAFewOfManyBadMatrices) {
    wire::ScaleInformation scale = scaleOf(23);
    for (wire::SegmentScale& segment : scale.segments) {
        segment.offset = {std::numeric_limits<float>::quiet_NaN(), 0, 0};
    }
    send(scale, 0, at(1s));
    const auto found = findings();
    ASSERT_EQ(found.size(), 2U) << "and that no other type was sent";
    EXPECT_EQ(namesIn(found[0].fact, "segments").size(), 23U);
    EXPECT_NE(say(found[0].fact, words::Form::Sentence).find("segments 1, 2, 3 and 20 more:"),
              std::string::npos);
}

TEST_F(ScaleFindings, NoteThatTheTypesHaveDifferentNumbersOfSegments) {
    send(bodyOf(1), 0, at(1s));
    send(scaleOf(22), 0, at(2s));
    const auto found = findings();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].severity(), Severity::Note);
    EXPECT_EQ(partOf(found[0].fact, "count"), counted(words::Kind::Segments, 22));
    EXPECT_EQ(numberIn(found[0].fact, "all"), 23);
}

TEST_F(ScaleFindings, SayThatOnlyTheDeprecatedTypeWasSent) {
    send(scaleOf(23), 0, at(1s));
    send(swayingAt(0, 1), 1, at(1s));
    const auto found = findings();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].fact.kind, words::Kind::DeprecatedScaleAlone);
    EXPECT_TRUE(m_session.messages().bodyOrigins({sender(), 0}).hasMeshScale);
    EXPECT_EQ(found[0].severity(), Severity::Note) << "a warning where nothing was sent at all";
}

TEST_F(EvidenceTest, IsAnIncidentOfItsCharacterWhereItContradictsItself) {
    wire::NullPose wrong = bodyOf(1);
    wrong.segments[17].name = "Pelvis";
    const auto poses = [this](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t sample = first; sample <= last; ++sample) {
            sendFrom("127.0.0.1:40001", swayingAt(0, sample), sample, at(1s + sample * 10ms));
        }
        follow();
    };
    sendFrom("127.0.0.1:40001", wrong, 0, at(1s));
    poses(1, 300);
    const Incident& incident = m_session.verdicts().incidents().all().back();
    EXPECT_EQ(incident.kind, IncidentKind::Scale);
    EXPECT_EQ(incident.character()->character, 0);
    EXPECT_EQ(say(incident.fact(), words::Form::Sentence),
              say(findContradictions(evidence()).front().fact, words::Form::Sentence))
        << "as the dock has it";
    EXPECT_EQ(m_session.verdicts().of(key()).state, TakeVerdict::State::Warning);
    sendFrom("127.0.0.1:40001", bodyOf(1), 0, at(4s + 5ms));
    poses(301, 320);
    EXPECT_TRUE(m_session.verdicts().of(key()).isOver) << m_session.verdicts().of(key()).said;
    poses(321, 2'000);
    EXPECT_EQ(m_session.verdicts().of(key()).state, TakeVerdict::State::Good)
        << m_session.verdicts().of(key()).said;
}

} // namespace
} // namespace posewire::model
