// SPDX-License-Identifier: MIT
#include "core/model/session/detection.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

#include "tests/core/model/session/session_fixture.h"

#include <utility>

namespace posewire::model {
namespace {

/// One segment alone, which says nothing about how far a body reaches.
wire::PoseQuaternion pelvisAt(float height) {
    wire::PoseQuaternion pose;
    pose.segments.push_back({1, {0, 0, height}, {1, 0, 0, 0}});
    return pose;
}

wire::Header headerOf(std::uint8_t type) {
    wire::Header header;
    header.setType(type);
    return header;
}

TEST(Detector, KnowsNothingFromATypeThatAllRevisionsHave) {
    Detector detector;
    detector.addHeader(headerOf(2));
    EXPECT_EQ(detector.result().revision, Revision::Unknown);
}

TEST(Detector, TakesDeprecatedTypesForRevisionE) {
    Detector detector;
    detector.addHeader(headerOf(10));
    EXPECT_EQ(detector.result().revision, Revision::E);
}

TEST(Detector, TakesNewTypesWithReservedHeaderForRevisionJOrK) {
    Detector detector;
    detector.addHeader(headerOf(10));
    detector.addHeader(headerOf(13));
    EXPECT_EQ(detector.result().revision, Revision::JOrK);
}

TEST(Detector, LetsHeaderCountsOutweighTheTypes) {
    Detector detector;
    wire::Header header = headerOf(2);
    header.bodySegments = 23;
    header.payloadSize = 736;
    detector.addHeader(header);
    detector.addHeader(headerOf(10));
    EXPECT_EQ(detector.result().revision, Revision::N);
    EXPECT_FALSE(detector.result().revisionEvidence.isNothing());
}

TEST(Detector, TellsMetresFromCentimetresByThePelvis) {
    Detector metres;
    metres.addBody(pelvisAt(0.0F));
    EXPECT_TRUE(metres.result().unitEvidence.isNothing());
    metres.addBody(pelvisAt(1.05F));
    EXPECT_EQ(metres.result().positionUnit, LengthUnit::Metre);
    EXPECT_EQ(
        metres.result().unitEvidence,
        (words::Fact{words::Kind::PelvisAt, {{"value", words::Number{static_cast<double>(1.05F), 2}}}}));

    Detector centimetres;
    centimetres.addBody(pelvisAt(104.8F));
    EXPECT_EQ(centimetres.result().positionUnit, LengthUnit::Centimetre);
}

using Kind = words::Kind;

wire::Header countedHeader(std::uint8_t type) {
    wire::Header header = headerOf(type);
    header.bodySegments = 23;
    header.payloadSize = 736;
    return header;
}

std::vector<words::Fact> found(const Detector& detector, const SenderOverride& declared = {}) {
    return detector.contradictions(declared);
}

words::Fact only(const Detector& detector, const SenderOverride& declared = {}) {
    const std::vector<words::Fact> all = found(detector, declared);
    EXPECT_EQ(all.size(), 1U);
    return all.empty() ? words::Fact() : all.front();
}

words::NamedValue text(std::string_view name, std::string value) {
    return {name, std::move(value)};
}

words::NamedValue part(std::string_view name, Kind kind) {
    return {name, words::Fact(kind)};
}

words::Fact measured(Kind kind, double value) {
    return {kind, {{"value", words::Number{value, 2}}}};
}

TEST(Contradictions, AreNoneWhereDeclarationAndDatagramsAgree) {
    Detector detector;
    detector.addHeader(countedHeader(2));
    detector.addBody(pelvisAt(1.0F));
    EXPECT_TRUE(found(detector).empty());
    EXPECT_TRUE(found(detector, {Revision::N, LengthUnit::Metre}).empty());
    EXPECT_TRUE(found(Detector(), {Revision::E, LengthUnit::Centimetre}).empty());
}

TEST(Contradictions, TellHeaderCountsThatTheDeclaredRevisionDoesNotHave) {
    Detector detector;
    detector.addHeader(countedHeader(2));
    EXPECT_EQ(only(detector, {.revision = Revision::JOrK}),
              (words::Fact{Kind::SendsCounts, {part("declared", Kind::RevisionJOrK)}}));
}

TEST(Contradictions, TellCountsThatAreMissing) {
    Detector detector;
    detector.addHeader(headerOf(2));
    EXPECT_EQ(only(detector, {.revision = Revision::N}),
              (words::Fact{Kind::SendsNoCounts, {part("declared", Kind::RevisionN)}}));
}

TEST(Contradictions, TellTypesThatCameAfterRevisionE) {
    Detector detector;
    detector.addHeader(headerOf(2));
    detector.addHeader(headerOf(20));
    EXPECT_EQ(only(detector, {.revision = Revision::E}),
              (words::Fact{Kind::SendsTypeSinceJ, {part("declared", Kind::RevisionE), text("type", "20")}}));
}

TEST(Contradictions, TellASenderThatChangesItsHeaders) {
    Detector detector;
    detector.addHeader(countedHeader(2));
    detector.addHeader(headerOf(12));
    EXPECT_TRUE(found(detector).empty()) << "another type may well come without counts";
    detector.addHeader(headerOf(2));
    EXPECT_EQ(only(detector), (words::Fact{Kind::CountsComeAndGo, {text("type", "02")}}));
}

TEST(Contradictions, TellAUnitThatIsNotTheDeclaredOne) {
    Detector detector;
    detector.addBody(pelvisAt(105.2F));
    const words::Fact contradiction = only(detector, {.positionUnit = LengthUnit::Metre});
    EXPECT_EQ(contradiction.kind, Kind::ReadInOtherUnit);
    EXPECT_EQ(partOf(contradiction, "looks").kind, Kind::Centimetres);
    EXPECT_EQ(partOf(contradiction, "read").kind, Kind::Metres);
    EXPECT_EQ(partOf(contradiction, "evidence").kind, Kind::PelvisAt);
    EXPECT_NEAR(*numberIn(partOf(contradiction, "evidence"), "value"), 105.2, 1e-4);
}

TEST(Contradictions, BelieveAnotherUnitOnlyAfterManyPoses) {
    Detector detector;
    detector.addBody(pelvisAt(1.05F));
    for (unsigned i = 1; i < UnitFinder::kPatience; ++i) {
        detector.addBody(pelvisAt(105.0F));
    }
    EXPECT_EQ(detector.result().positionUnit, LengthUnit::Metre);
    EXPECT_TRUE(found(detector).empty());
    detector.addBody(pelvisAt(105.0F));
    EXPECT_EQ(detector.result().positionUnit, LengthUnit::Centimetre);
    EXPECT_EQ(
        only(detector),
        (words::Fact{Kind::UnitChanged,
                     {part("looks", Kind::Centimetres),
                      {"evidence", measured(Kind::PelvisAt, 105)},
                      {"before",
                       words::Fact{Kind::UnitBy,
                                   {part("looks", Kind::Metres),
                                    {"evidence", measured(Kind::PelvisAt, static_cast<double>(1.05F))}}}}}}));
}

TEST(UnitFinder, IsNotMisledBySomebodyWhoSendsCentimetresAndLiesDown) {
    UnitFinder finder(LengthUnit::Metre);
    finder.add(4, 170);
    EXPECT_TRUE(finder.evidence().isNothing()) << "height and reach contradict each other";
    finder.add(0, 170);
    EXPECT_EQ(finder.unit(), LengthUnit::Centimetre);
    EXPECT_EQ(finder.evidence(), measured(Kind::ReachOf, 170));
    for (unsigned i = 0; i < 2 * UnitFinder::kPatience; ++i) {
        finder.add(4, 170);
    }
    EXPECT_EQ(finder.unit(), LengthUnit::Centimetre);
}

wire::PoseQuaternion inCentimetres(wire::PoseQuaternion pose) {
    for (wire::SegmentQuaternion& segment : pose.segments) {
        for (float& coordinate : segment.position) {
            coordinate *= 100;
        }
    }
    return pose;
}

class UnitTest : public SessionTest {
protected:
    LengthUnit unit(std::uint8_t type) { return m_session.roster().find(sender())->positionUnit(type); }
    double poseX() { return m_session.messages().pose(key())->segments[0].position.x(); }
};

TEST_F(UnitTest, IsTheSendersForPosesAsForEverybodyElse) {
    send(standingAt(2), 1, at(1s));
    follow();
    EXPECT_NEAR(poseX(), 2.0, 1e-6);
    // Reaches five metres and more, on a sender whose pelvis says metres.
    wire::PoseQuaternion stretched = standingAt(2);
    stretched.segments[6].position = {2, 0, 9};
    send(stretched, 2, at(2s));
    follow();
    EXPECT_EQ(unit(wire::PoseQuaternion::kType), LengthUnit::Metre);
    EXPECT_NEAR(poseX(), 2.0, 1e-6);
}

TEST_F(UnitTest, ChangesForPosesWhenItChangesForTheSender) {
    send(standingAt(2), 1, at(1s));
    follow();
    for (std::uint32_t i = 1; i <= UnitFinder::kPatience; ++i) {
        send(inCentimetres(standingAt(2)), 1 + i, at((1 + i) * 1s));
        follow();
        const LengthUnit now = unit(wire::PoseQuaternion::kType);
        EXPECT_EQ(now, i < UnitFinder::kPatience ? LengthUnit::Metre : LengthUnit::Centimetre);
        EXPECT_NEAR(poseX(), 200 * metresPer(now), 1e-4);
    }
}

TEST_F(UnitTest, OfTypesWithYUpIsTheirOwn) {
    send(standingAt(0), 1, at(1s));
    follow();
    EXPECT_EQ(unit(wire::PoseEuler::kType), LengthUnit::Centimetre);
    wire::PoseEuler euler;
    for (const wire::SegmentQuaternion& segment : standingAt(0).segments) {
        const auto& [x, y, z] = segment.position;
        euler.segments.push_back({segment.id, {y, z, x}, {0, 0, 0}});
    }
    send(euler, 2, at(2s));
    follow();
    EXPECT_EQ(unit(wire::PoseEuler::kType), LengthUnit::Metre);
    EXPECT_EQ(unit(wire::PointPositions::kType), LengthUnit::Metre);
    EXPECT_NEAR(m_session.messages().pose(key())->segments[0].position.z(), referenceOrigins()[0].z(), 1e-4);
}

class OverrideTest : public SessionTest {};

TEST_F(OverrideTest, ReadsPosesInTheDeclaredUnit) {
    send(standingAt(2), 1, at(1s));
    follow();
    ASSERT_NE(m_session.messages().pose(key()), nullptr);
    EXPECT_NEAR(m_session.messages().pose(key())->segments[0].position.x(), 2.0, 1e-6);
    m_session.setOverride(sender(), {.positionUnit = LengthUnit::Centimetre});
    EXPECT_NEAR(m_session.messages().pose(key())->segments[0].position.x(), 0.02, 1e-6);
    EXPECT_EQ(m_session.roster().senders().front().positionUnit(), LengthUnit::Centimetre);
    ASSERT_EQ(m_session.roster().senders().front().contradictions().size(), 1U);
    m_session.setOverride(sender(), {});
    EXPECT_NEAR(m_session.messages().pose(key())->segments[0].position.x(), 2.0, 1e-6);
    EXPECT_TRUE(m_session.roster().senders().front().contradictions().empty());
}

TEST_F(OverrideTest, HoldsForTheSenderThatComesBackFromAnotherPort) {
    send(standingAt(0), 1, at(1s));
    follow();
    m_session.setOverride(sender(), {.revision = Revision::JOrK});
    wire::Datagram datagram;
    datagram.body = standingAt(0);
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    sendBytes(*wire::encode(datagram), at(2s), "127.0.0.1:40002");
    sendBytes(*wire::encode(datagram), at(2s), "127.0.0.2:40002");
    follow();
    EXPECT_EQ(m_session.roster().find(sender("127.0.0.1:40002"))->revision(), Revision::JOrK);
    EXPECT_EQ(m_session.roster().find(sender("127.0.0.2:40002"))->revision(), Revision::N);
}

TEST_F(OverrideTest, OfAnUnknownSenderIsNothing) {
    m_session.setOverride(log::SenderId{77}, {.revision = Revision::E});
    EXPECT_TRUE(m_session.roster().senders().empty());
}

/// A figure that stands with its pelvis turned, or lies, as sent in a frame.
wire::PoseQuaternion standing(UpAxis up, const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity()) {
    wire::PoseQuaternion pose;
    for (const Eigen::Vector3d& origin : referenceOrigins()) {
        const auto id = static_cast<std::uint32_t>(pose.segments.size() + 1);
        pose.segments.push_back({id, toFloats(Eigen::Vector3d(turn * origin)), toFloats(turn)});
    }
    if (up == UpAxis::Y) {
        turnTo(up, pose);
    }
    return pose;
}

template <class Message>
Detection afterPoses(Detector& detector, const Message& message, int count) {
    for (int i = 0; i < count; ++i) {
        detector.addBody(message);
    }
    return detector.result();
}

TEST(Detector, KnowsYUpByTheBodyAndNotByOneFrame) {
    Detector detector;
    EXPECT_EQ(afterPoses(detector, standing(UpAxis::Y), 5).up, UpAxis::Z);
    EXPECT_TRUE(detector.result().upEvidence.isNothing());
    EXPECT_EQ(afterPoses(detector, standing(UpAxis::Y), 5).up, UpAxis::Y);
    EXPECT_EQ(detector.result().upEvidence, (words::Fact{words::Kind::UprightAlong, {{"axis", "y"}}}));
    EXPECT_EQ(detector.result().positionUnit, LengthUnit::Metre);
}

TEST(Detector, NoPostureChangesTheAxisThatIsUp) {
    for (const UpAxis up : {UpAxis::Z, UpAxis::Y}) {
        Detector detector;
        for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)}) {
            for (const double angle : {-1.6, 1.6, 3.1}) { // lies on each side, stands on the hands
                const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, axis));
                EXPECT_EQ(afterPoses(detector, standing(up, turn), 100).up, up);
            }
        }
        EXPECT_TRUE(found(detector).empty());
    }
}

TEST(Detector, TakesNoMirroredFrameForYUp) {
    wire::PoseQuaternion pose = standing(UpAxis::Y);
    for (wire::SegmentQuaternion& item : pose.segments) {
        item.position[0] = -item.position[0];
    }
    Detector detector;
    EXPECT_TRUE(afterPoses(detector, pose, 100).upEvidence.isNothing());
}

TEST(Detector, KnowsYUpByPositionsOrOrientationsAlone) {
    Detector positions;
    wire::LinearKinematics linear;
    for (const wire::SegmentQuaternion& item : standing(UpAxis::Y).segments) {
        linear.segments.push_back({item.id, item.position, {}, {}});
    }
    EXPECT_EQ(afterPoses(positions, linear, 59).up, UpAxis::Z);
    EXPECT_EQ(afterPoses(positions, linear, 1).up, UpAxis::Y);

    Detector orientations;
    wire::AngularKinematics angular;
    const Eigen::Quaterniond bent(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()));
    for (std::uint32_t id = 1; id <= kBodySegmentCount; ++id) {
        const bool isShank = id == segment::kRightLowerLeg + 1;
        angular.segments.push_back({id, toFloats(isShank ? bent : Eigen::Quaterniond::Identity()), {}, {}});
    }
    turnTo(UpAxis::Y, angular);
    EXPECT_EQ(afterPoses(orientations, angular, 10).up, UpAxis::Y);
}

TEST(Detector, SaysThatTheUpAxisWasSetOtherwise) {
    Detector detector;
    afterPoses(detector, standing(UpAxis::Y), 10);
    EXPECT_EQ(found(detector, {.up = UpAxis::Z}).front().kind, Kind::ReadInOtherUnit);
    EXPECT_TRUE(found(detector, {.up = UpAxis::Y}).empty());
    afterPoses(detector, standing(UpAxis::Z), 40);
    EXPECT_EQ(found(detector).front().kind, Kind::UnitChanged);
}

} // namespace
} // namespace posewire::model
