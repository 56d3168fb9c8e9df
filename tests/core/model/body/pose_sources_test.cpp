// SPDX-License-Identifier: MIT
#include "core/log/packet_log.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/pose_remark.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/model/session/session.h"
#include "core/performer/performer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>

namespace posewire::model {
namespace {

using Types = std::vector<std::uint8_t>;

/// The greatest distance of a pose from the truth, over all segments that it speaks of.
struct Errors {
    double position = 0; ///< metres
    double angle = 0;    ///< degrees, of orientations whose twist is known
    double swing = 0;    ///< degrees, of the way to the child, of all that are solved
    double spine = 0;    ///< degrees; the performer's spine does not turn as MVN's does
    int assumed = 0;     ///< segments of the last pose
    int twists = 0;      ///< of which the twist is assumed, likewise
};

double degreesBetween(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
    return a.angularDistance(b) * kDegreesPerRadian;
}

double degreesBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegreesPerRadian;
}

/// The one child that gives a segment its direction; −1 for segments with none or several.
int onlyChild(int segment) {
    int child = -1;
    int count = 0;
    for (int i = 0; i < kBodySegmentCount; ++i) {
        if (bodySegments()[static_cast<std::size_t>(i)].parent == segment) {
            child = i;
            ++count;
        }
    }
    return count == 1 ? child : -1;
}

/// What a session makes of a performance that is sent in some types, 240 frames a second.
class Performance {
public:
    Performance(Types types, const std::string& motion) {
        performer::PerformerSettings settings;
        settings.characters = 1;
        settings.types = std::move(types);
        settings.motion = motion;
        m_performer = std::make_unique<performer::Performer>(settings);
    }

    void send(std::uint64_t frame, const std::function<void(wire::Datagram&)>& change = {}) {
        for (wire::Datagram& datagram : m_performer->frame(frame)) {
            if (change) {
                change(datagram);
            }
            log::Arrival arrival;
            arrival.stamp = log::Stamp(std::chrono::seconds(1) + frame * std::chrono::microseconds(4167));
            arrival.sender = m_log.senders().intern({"10.0.0.1:5000", log::Transport::Udp, 9763});
            m_log.writer().append(*wire::encode(datagram), arrival);
            m_now = arrival.stamp;
        }
        m_log.writer().publish();
        m_session.follow(m_now);
    }

    const CharacterPose* pose() { return m_session.messages().pose(key()); }
    CharacterKey key() { return m_session.atNow().roster().listed().front()->key; }
    Session& session() { return m_session; }
    const ReferenceBody& characterBody() const { return m_performer->characters().front().body(); }

    void compare(std::uint64_t frame, Errors& errors) {
        const CharacterPose* pose = this->pose();
        ASSERT_NE(pose, nullptr);
        auto& character = const_cast<performer::Character&>(m_performer->characters().front());
        const auto segments = character.at(frame).segments;
        const Eigen::Vector3d off = pose->isPlaceAssumed
                                        ? segments[0].pose.position - pose->segments[0].position
                                        : Eigen::Vector3d(Eigen::Vector3d::Zero());
        errors.assumed = errors.twists = 0;
        for (std::size_t i = 0; i < kBodySegmentCount; ++i) {
            const SegmentSource& source = pose->sources[i];
            const SegmentPose& is = pose->segments[i];
            const SegmentPose& truth = segments[i].pose;
            errors.assumed += std::min(source.position, source.orientation) == Provenance::Assumed ? 1 : 0;
            errors.twists += source.isTwistAssumed ? 1 : 0;
            const bool isSpine = i >= segment::kL5 && i <= segment::kT12;
            errors.position = std::max(errors.position, (is.position + off - truth.position).norm());
            double& angle = isSpine ? errors.spine : errors.angle;
            if (source.orientation > Provenance::Assumed && !source.isTwistAssumed) {
                angle = std::max(angle, degreesBetween(is.orientation, truth.orientation));
            }
            const int child = onlyChild(static_cast<int>(i));
            if (source.orientation > Provenance::Assumed && child >= 0 && !isSpine) {
                const Eigen::Vector3d bone = character.body().offset(child);
                errors.swing =
                    std::max(errors.swing, degreesBetween(is.orientation * bone, truth.orientation * bone));
            }
        }
    }

private:
    std::unique_ptr<performer::Performer> m_performer;
    log::PacketLog m_log;
    Session m_session{m_log};
    log::Stamp m_now{};
};

Errors errorsOf(Types types, const std::string& motion,
                const std::function<void(wire::Datagram&)>& change = {}) {
    Performance performance(std::move(types), motion);
    Errors errors;
    for (std::uint64_t frame = 0; frame < 240 * 3; ++frame) {
        performance.send(frame, change);
        if (frame % 5 == 0) {
            performance.compare(frame, errors);
        }
    }
    return errors;
}

class PoseSources : public testing::TestWithParam<std::string_view> {
protected:
    static std::string motion() { return std::string(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Motions, PoseSources, testing::ValuesIn(performer::motionNames()),
                         [](const auto& one) { return std::string(one.param); });

TEST_P(PoseSources, ThatAreWholeAreShownAsSent) {
    for (const Types& types :
         {Types{2, 13}, Types{1, 13}, Types{5, 13}, Types{13, 21, 22}, Types{2}, Types{21, 22}}) {
        const Errors errors = errorsOf(types, motion());
        EXPECT_LT(errors.position, 1e-4);
        EXPECT_LT(errors.angle, 0.05);
        EXPECT_LT(errors.spine, 0.05);
        EXPECT_EQ(errors.assumed, 0);
        EXPECT_EQ(errors.twists, 0);
    }
}

TEST_P(PoseSources, OfMarkersAreTheBody) {
    const Errors errors = errorsOf({3, 13}, motion());
    EXPECT_LT(errors.position, 4e-3) << "L5, L3 and T12 have one marker each";
    EXPECT_LT(errors.angle, 1.0);
    EXPECT_LT(errors.spine, 7.0);
    EXPECT_EQ(errors.assumed, 0);
    EXPECT_EQ(errors.twists, 5) << "neck, shoulders and toes have one marker or none";
}

TEST_P(PoseSources, OfPositionsPointWhereTheirJointsAre) {
    const Errors errors = errorsOf({13, 21}, motion());
    EXPECT_LT(errors.position, 1e-5);
    EXPECT_LT(errors.swing, 0.1);
    EXPECT_LT(errors.angle, 0.1) << "pelvis and T8 have joints in all directions";
    EXPECT_EQ(errors.assumed, 5) << "head, hands and toes: nothing tells how they are turned";
    EXPECT_EQ(errors.twists, 13) << "neck and limbs";
}

TEST_P(PoseSources, OfOrientationsStandOnTheFloorWithTheirPlaceAssumed) {
    Performance performance({13, 22}, motion());
    for (std::uint64_t frame = 0; frame < 48; ++frame) {
        performance.send(frame);
    }
    Errors errors;
    performance.compare(47, errors);
    EXPECT_LT(errors.position, 1e-5) << "against the pelvis";
    EXPECT_LT(errors.angle, 0.05);
    EXPECT_EQ(errors.assumed, 1) << "the pelvis alone speaks for the place";
    const CharacterPose& pose = *performance.pose();
    EXPECT_TRUE(pose.isPlaceAssumed);
    double lowest = 1;
    for (const SegmentPose& segment : pose.segments) {
        lowest = std::min(lowest, segment.position.z());
    }
    EXPECT_GT(lowest, 0.0);
    EXPECT_LT(lowest, 0.03);
}

TEST_P(PoseSources, HelpEachOther) {
    const Errors withOrientations = errorsOf({3, 13, 22}, motion());
    EXPECT_LT(withOrientations.position, 1e-4);
    EXPECT_LT(withOrientations.angle, 0.05);
    const Errors withPositions = errorsOf({3, 13, 21}, motion());
    EXPECT_LT(withPositions.position, 1e-4);
    EXPECT_LT(withPositions.angle, 0.3);
    EXPECT_EQ(withPositions.assumed, 0);
}

TEST(PosesOfSeveralTypes, AreOfOneSample) {
    Performance performance({13, 21, 22}, "walk");
    for (std::uint64_t frame = 0; frame < 20; ++frame) {
        performance.send(frame);
    }
    // Type 21 of the next sample is there, its type 22 is not yet.
    performance.send(20, [](wire::Datagram& datagram) {
        if (datagram.header.type() == 22) {
            datagram.header.character = 7;
        }
    });
    const CharacterPose& pose = *performance.pose();
    EXPECT_EQ(pose.types, (Types{21, 22}));
    Errors errors;
    performance.compare(19, errors);
    EXPECT_LT(errors.position, 1e-5);
    EXPECT_LT(errors.angle, 0.05);
}

TEST(PosesOfSeveralTypes, GiveWayToWholeOnes) {
    Performance performance({2, 13, 21, 22, 3}, "walk");
    performance.send(0);
    performance.send(1);
    EXPECT_EQ(performance.pose()->types, (Types{2}));
}

TEST(PosesOfMarkers, BearMarkersThatAreLostOrExchanged) {
    const auto damage = [](wire::Datagram& datagram) {
        auto* message = std::get_if<wire::PointPositions>(&datagram.body);
        if (message == nullptr) {
            return;
        }
        const auto at = [&](int segment, int localId) -> wire::Point& {
            const auto id = encodePointId(PointIdCoding::By256, {segment + 1, localId});
            return *std::ranges::find(message->points, id, &wire::Point::id);
        };
        at(segment::kHead, 2).position = {};                                            // lost
        at(segment::kPelvis, 13).position[0] = std::numeric_limits<float>::quiet_NaN(); // lost
        std::swap(at(segment::kRightUpperLeg, 4).position, at(segment::kRightUpperLeg, 5).position);
        std::swap(at(segment::kLeftFoot, 3).position, at(segment::kRightFoot, 3).position);
        at(segment::kT8, 6).position[1] += 30; // centimetres: a reflection
    };
    const Errors errors = errorsOf({3, 13}, "walk", damage);
    EXPECT_LT(errors.position, 4e-3);
    EXPECT_LT(errors.angle, 1.0);
}

TEST(PosesOfMarkers, TakeTheJointsBesideThemForMarkersThatAreLost) {
    const auto lose = [](wire::Datagram& datagram) {
        auto* message = std::get_if<wire::PointPositions>(&datagram.body);
        if (message == nullptr) {
            return;
        }
        std::erase_if(message->points, [](const wire::Point& point) {
            for (const PointReference& lost : {PointReference{segment::kRightUpperArm + 1, 3},
                                               PointReference{segment::kRightUpperArm + 1, 4},
                                               PointReference{segment::kRightForeArm + 1, 3}}) {
                if (point.id == encodePointId(PointIdCoding::By256, lost)) {
                    return true;
                }
            }
            return false;
        });
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
    };
    const Errors errors = errorsOf({3, 13}, "wave", lose);
    EXPECT_LT(errors.position, 4e-3)
        << "the hand says where the forearm ends, and that where the upper arm does";
    EXPECT_LT(errors.angle, 1.0);
}

/// A fifth of the markers of each sample is lost at random.
TEST_P(PoseSources, OfMarkersBearThatAFifthIsLost) {
    Performance performance({3, 13}, motion());
    std::uint32_t dice = 1;
    const auto lose = [&dice](wire::Datagram& datagram) {
        if (auto* message = std::get_if<wire::PointPositions>(&datagram.body)) {
            for (wire::Point& point : message->points) {
                dice = dice * 1664525U + 1013904223U;
                if ((dice >> 16U) % 5 == 0) {
                    point.position = {};
                }
            }
        }
    };
    for (std::uint64_t frame = 0; frame < 240 * 3; frame += 4) {
        performance.send(frame, lose);
        Errors errors;
        performance.compare(frame, errors);
        if (frame > 8) {
            EXPECT_LT(errors.position, 0.03) << frame;
            EXPECT_LT(errors.angle, 15.0) << frame;
        }
    }
}

TEST(PosesWithHoles, AreSolvedFromWhatIsLeft) {
    const auto damage = [](wire::Datagram& datagram) {
        if (auto* message = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
            for (const int segment : {segment::kRightForeArm, segment::kLeftHand, segment::kT12}) {
                auto& item = message->segments[static_cast<std::size_t>(segment)];
                item.position[1] = std::numeric_limits<float>::quiet_NaN();
                item.orientation[2] = std::numeric_limits<float>::quiet_NaN();
            }
        }
    };
    Performance performance({2, 13}, "walk");
    Errors errors;
    for (std::uint64_t frame = 0; frame < 240; ++frame) {
        performance.send(frame, damage);
        performance.compare(frame, errors);
    }
    const CharacterPose& pose = *performance.pose();
    EXPECT_EQ(pose.sources[segment::kRightForeArm].orientation, Provenance::Solved);
    EXPECT_EQ(pose.sources[segment::kRightForeArm].weaker(), Provenance::Assumed) << "its twist";
    EXPECT_EQ(pose.sources[segment::kLeftHand].orientation, Provenance::Assumed);
    EXPECT_EQ(pose.sources[segment::kLeftHand].position, Provenance::Solved);
    EXPECT_EQ(pose.sources[segment::kT12].weaker(), Provenance::Solved);
    EXPECT_EQ(pose.sources[segment::kHead].weaker(), Provenance::Sent);
    EXPECT_LT(errors.position, 2e-3);
    EXPECT_LT(errors.swing, 1.0);
}

TEST(PosesWithHoles, KeepTheirSegmentsWhereOneIsLeftOutOrSentTwice) {
    for (const bool isTwice : {false, true}) {
        const auto damage = [=](wire::Datagram& datagram) {
            if (auto* message = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
                auto& items = message->segments;
                if (isTwice) {
                    items[segment::kLeftHand] = items[segment::kLeftForeArm];
                } else {
                    items.erase(items.begin() + segment::kLeftHand);
                }
                wire::completeHeader(datagram, wire::HeaderEra::Counted);
                datagram.header.bodySegments = static_cast<std::uint8_t>(items.size());
            }
        };
        Performance performance({2, 13}, "walk");
        for (std::uint64_t frame = 0; frame < 10; ++frame) {
            performance.send(frame, damage);
        }
        Errors errors;
        performance.compare(9, errors);
        const CharacterPose& pose = *performance.pose();
        EXPECT_FALSE(pose.isObjects);
        EXPECT_EQ(pose.layout.body, 23);
        EXPECT_EQ(errors.assumed, 1);
        EXPECT_EQ(pose.sources[segment::kLeftHand].orientation, Provenance::Assumed);
        EXPECT_EQ(pose.sources[segment::kLeftToe].weaker(), Provenance::Sent);
        EXPECT_LT(errors.position, 1e-5);
    }
}

TEST(BodiesBelowTheFloor, ArePutOnItWhereTheOperatorSaysSo) {
    Performance performance({2, 13}, "tpose");
    performance.send(0, [](wire::Datagram& datagram) {
        if (auto* message = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
            const float pelvis = message->segments.front().position[2];
            for (auto& item : message->segments) {
                item.position[2] -= pelvis;
            }
        }
    });
    EXPECT_TRUE(isBelowFloor(*performance.pose()));
    EXPECT_FALSE(performance.session().messages().poseRemark(performance.key()).isEmpty());
    performance.session().setLifted(performance.key(), true);
    const CharacterPose& pose = *performance.pose();
    EXPECT_TRUE(pose.isLifted);
    EXPECT_FALSE(isBelowFloor(pose));
    EXPECT_NEAR(pose.segments[segment::kRightToe].position.z(), 0.015, 0.004);
    performance.session().setLifted(performance.key(), false);
    EXPECT_TRUE(isBelowFloor(*performance.pose()));
}

TEST(TrackedObjects, AreNoBody) {
    for (const bool isCounted : {true, false}) {
        const auto objects = [=](wire::Datagram& datagram) {
            if (auto* message = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
                message->segments.resize(3);
                wire::completeHeader(datagram,
                                     isCounted ? wire::HeaderEra::Counted : wire::HeaderEra::Reserved);
                datagram.header.bodySegments = isCounted ? 3 : 0;
            }
        };
        Performance performance({2}, "walk");
        performance.send(0, objects);
        const CharacterPose& pose = *performance.pose();
        EXPECT_TRUE(pose.isObjects);
        EXPECT_EQ(pose.segments.size(), 3U);
        EXPECT_TRUE(pose.isPresent(2));
    }
}

TEST(BodiesWithoutScaleMessage, AreMeasuredOnPoses) {
    for (const Types& types : {Types{2}, Types{1}, Types{5}, Types{21}, Types{3}, Types{21, 22}}) {
        Performance performance(types, "squat");
        for (std::uint64_t frame = 0; frame < 40; ++frame) {
            performance.send(frame);
        }
        const BodyOrigins& body = performance.session().messages().bodyOrigins(performance.key());
        EXPECT_EQ(body.source, BodySource::Poses);
        EXPECT_EQ(body.floor, 0);
        const double tolerance = types.front() == 3 ? 0.05 : 0.002;
        for (std::size_t i = 0; i < kBodySegmentCount; ++i) {
            EXPECT_LT((body.places[i] - performance.characterBody().origins[i]).norm(), tolerance)
                << i << " of type " << int(types.front());
        }
    }
    Performance turnsAlone({22}, "squat");
    turnsAlone.send(0);
    EXPECT_EQ(turnsAlone.session().messages().bodyOrigins(turnsAlone.key()).source, BodySource::Reference);
    Performance withScale({2, 13}, "squat");
    withScale.send(0);
    EXPECT_EQ(withScale.session().messages().bodyOrigins(withScale.key()).source, BodySource::NullPose);
}

} // namespace
} // namespace posewire::model
