// SPDX-License-Identifier: MIT
#include "core/performer/trackers.h"

#include "core/performer/performer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace posewire::performer {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

class Trackers : public testing::Test {
protected:
    static Performer performing(const char* motion) {
        PerformerSettings settings;
        settings.characters = 1;
        settings.types = {2, 23};
        settings.motion = motion;
        return Performer(settings);
    }
    static std::vector<wire::Tracker> trackers(Performer& performer, std::uint64_t frame) {
        for (const wire::Datagram& datagram : performer.frame(frame)) {
            if (const auto* message = std::get_if<wire::TrackerKinematics>(&datagram.body)) {
                return message->trackers;
            }
        }
        return {};
    }
};

TEST_F(Trackers, AreTheSeventeenOfAFullBodySuit) {
    Performer performer = performing("idle");
    std::vector<std::uint32_t> ids;
    for (const wire::Tracker& tracker : trackers(performer, 3)) {
        ids.push_back(tracker.id);
    }
    EXPECT_EQ(ids,
              (std::vector<std::uint32_t>{1, 5, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 20, 21, 22}));
}

TEST_F(Trackers, FeelGravityUpwardsAtRest) {
    Performer performer = performing("tpose");
    for (std::uint64_t frame = 0; frame < 500; frame += 7) {
        for (const wire::Tracker& tracker : trackers(performer, frame)) {
            const Vector3d felt = model::toVector(tracker.acceleration);
            EXPECT_NEAR(felt.norm(), 9.81, 0.1);
            const Vector3d world = model::toQuaternion(tracker.orientation) * felt;
            EXPECT_NEAR(world.z(), 9.81, 0.1);
            EXPECT_LT(model::toVector(tracker.freeAcceleration).norm(), 0.15);
            EXPECT_LT(model::toVector(tracker.angularVelocity).norm(), 0.03);
        }
    }
}

TEST_F(Trackers, HoldTheSameFieldInTheWorldWhereNothingDisturbsIt) {
    Performer performer = performing("tpose");
    const auto first = trackers(performer, 0);
    const Vector3d field =
        model::toQuaternion(first[0].orientation) * model::toVector(first[0].magneticField);
    EXPECT_LT(field.z(), -0.6) << "steeply down";
    for (const wire::Tracker& tracker : first) {
        const Vector3d own =
            model::toQuaternion(tracker.orientation) * model::toVector(tracker.magneticField);
        EXPECT_NEAR(own.norm(), 1.0, 0.35);
    }
}

TEST_F(Trackers, AreDisturbedSomewhereOnTheWay) {
    Performer performer = performing("walk");
    double weakest = 10.0;
    double strongest = 0.0;
    for (std::uint64_t frame = 0; frame < 240 * 20; frame += 5) {
        for (const wire::Tracker& tracker : trackers(performer, frame)) {
            const double length = model::toVector(tracker.magneticField).norm();
            weakest = std::min(weakest, length);
            strongest = std::max(strongest, length);
        }
    }
    EXPECT_GT(strongest - weakest, 0.08);
    EXPECT_GT(weakest, 0.6);
    EXPECT_LT(strongest, 1.4);
}

TEST_F(Trackers, TurnAsFastAsTheirOrientationSays) {
    Performer performer = performing("walk");
    auto before = trackers(performer, 0);
    for (std::uint64_t frame = 1; frame < 500; ++frame) {
        const auto now = trackers(performer, frame);
        for (std::size_t index = 0; index < now.size(); ++index) {
            const Quaterniond from = model::toQuaternion(before[index].orientation);
            const Quaterniond to = model::toQuaternion(now[index].orientation);
            const Vector3d turned = from.conjugate() * rotationBetween(from, to) * 240.0;
            const Vector3d mean = 0.5 * (model::toVector(before[index].angularVelocity) +
                                         model::toVector(now[index].angularVelocity));
            EXPECT_LT((turned - mean).norm(), 0.35) << "tracker " << index << " frame " << frame;
        }
        before = now;
    }
}

TEST_F(Trackers, RelateBothAccelerationsByGravity) {
    Performer performer = performing("walk");
    for (std::uint64_t frame = 0; frame < 2000; frame += 13) {
        for (const wire::Tracker& tracker : trackers(performer, frame)) {
            const Vector3d world =
                model::toQuaternion(tracker.orientation) * model::toVector(tracker.acceleration);
            const Vector3d expected = model::toVector(tracker.freeAcceleration) + Vector3d(0.0, 0.0, 9.81);
            EXPECT_LT((world - expected).norm(), 1e-3);
        }
    }
}

TEST_F(Trackers, RingWhenAHeelStrikes) {
    Performer performer = performing("walk");
    const Motion& motion = performer.characters().front().motion();
    double atStrike = 0.0;
    double inMidStance = 0.0;
    for (std::uint64_t frame = 0; frame < 240 * 5; ++frame) {
        const double since = motion.sinceHeelStrike(model::Side::Right, static_cast<double>(frame) / 240.0);
        const auto readings = trackers(performer, frame);
        const double shake = model::toVector(readings[13].freeAcceleration).norm();
        if (since < 0.03) {
            atStrike = std::max(atStrike, shake);
        } else if (since > 0.25 && since < 0.40) {
            inMidStance = std::max(inMidStance, shake);
        }
    }
    EXPECT_GT(atStrike, 10.0);
    EXPECT_LT(inMidStance, 6.0);
}

TEST_F(Trackers, SitALittleCrookedTheSameWayAllTheTime) {
    Performer performer = performing("walk");
    std::vector<Quaterniond> mounts;
    for (const std::uint64_t frame : {std::uint64_t{5}, std::uint64_t{700}}) {
        const auto datagrams = performer.frame(frame);
        const auto& pose = std::get<wire::PoseQuaternion>(datagrams[datagrams.size() - 2].body);
        const auto& message = std::get<wire::TrackerKinematics>(datagrams.back().body);
        for (std::size_t index = 0; index < message.trackers.size(); ++index) {
            const Quaterniond segment =
                model::toQuaternion(pose.segments[message.trackers[index].id - 1].orientation);
            const Quaterniond mount =
                segment.conjugate() * model::toQuaternion(message.trackers[index].orientation);
            if (frame == 5) {
                mounts.push_back(mount);
            } else {
                EXPECT_LT(mounts[index].angularDistance(mount), 1e-5);
            }
        }
    }
    EXPECT_LT(std::abs(mounts[7].x()) + std::abs(mounts[7].y()), 1.0) << "not a random orientation";
}

} // namespace
} // namespace posewire::performer
