// SPDX-License-Identifier: MIT
#include "core/performer/motion.h"

#include "core/performer/kinematics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace posewire::performer {
namespace {

using Eigen::Vector3d;
using model::Side;
using namespace model::segment;

constexpr double kStep = 1.0 / 240.0;
constexpr Side kSides[] = {Side::Right, Side::Left};

MotionSettings settingsFor(int character, int count, double stature = 1.75) {
    MotionSettings settings;
    settings.body = model::makeReferenceBody({stature});
    settings.seed = 3;
    settings.character = character;
    settings.characterCount = count;
    return settings;
}

double percentile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values.at(static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

/// Every motion, on bodies from small to tall.
class EveryMotion : public testing::TestWithParam<std::string> {
protected:
    static std::vector<MotionSettings> performances() {
        return {settingsFor(0, 2, 1.60), settingsFor(1, 2, 1.75), settingsFor(2, 4, 1.93)};
    }
};

TEST_P(EveryMotion, KeepsEverySegmentAtItsLength) {
    for (const MotionSettings& settings : performances()) {
        const auto motion = makeMotion(GetParam(), settings);
        for (double t = -1.0; t < 12.0; t += 0.037) {
            const BodyPose pose = motion->sample(t);
            for (int index = 1; index < model::kBodySegmentCount; ++index) {
                const auto place = static_cast<std::size_t>(index);
                const auto parent = static_cast<std::size_t>(model::bodySegments()[place].parent);
                const Vector3d there =
                    pose[parent].position + pose[parent].orientation * settings.body.offset(index);
                EXPECT_LT((pose[place].position - there).norm(), 1e-9);
                EXPECT_NEAR(pose[place].orientation.norm(), 1.0, 1e-9);
            }
        }
    }
}

TEST_P(EveryMotion, KeepsTheFeetAboveTheFloor) {
    for (const MotionSettings& settings : performances()) {
        const auto motion = makeMotion(GetParam(), settings);
        for (double t = 0.0; t < 20.0; t += 0.011) {
            const BodyPose pose = motion->sample(t);
            double lowest = std::numeric_limits<double>::infinity();
            for (const Side side : kSides) {
                for (const Vector3d& point : worldSolePoints(settings.body, side, pose)) {
                    lowest = std::min(lowest, point.z());
                }
            }
            EXPECT_GT(lowest, -0.005) << "at " << t;
            EXPECT_LT(lowest, 0.008) << "somebody must carry the body, at " << t;
        }
    }
}

TEST_P(EveryMotion, NeverJumps) {
    // A jump of a millimetre between frames would be an acceleration of 57 m/s² twice over.
    for (const MotionSettings& settings : performances()) {
        const auto motion = makeMotion(GetParam(), settings);
        BodyPose before = motion->sample(-kStep);
        BodyPose now = motion->sample(0.0);
        for (int frame = 1; frame < 240 * 20; ++frame) {
            const BodyPose after = motion->sample(frame * kStep);
            for (std::size_t index = 0; index < now.size(); ++index) {
                const Vector3d acceleration =
                    (after[index].position - 2.0 * now[index].position + before[index].position) /
                    (kStep * kStep);
                EXPECT_LT(acceleration.norm(), 170.0) << "segment " << index << " at " << frame * kStep;
            }
            before = now;
            now = after;
        }
    }
}

TEST_P(EveryMotion, StaysInsideTheRangeOfAKnee) {
    for (const MotionSettings& settings : performances()) {
        const auto motion = makeMotion(GetParam(), settings);
        for (double t = 0.0; t < 15.0; t += 0.02) {
            const BodyPose pose = motion->sample(t);
            for (const Side side : kSides) {
                const LimbSegments& leg = limbs(side);
                const Eigen::Quaterniond knee =
                    pose[static_cast<std::size_t>(leg.upperLeg)].orientation.conjugate() *
                    pose[static_cast<std::size_t>(leg.lowerLeg)].orientation;
                const double flexion = 2.0 * std::atan2(knee.y(), knee.w()) * model::kDegreesPerRadian;
                EXPECT_GT(flexion, -0.1);
                EXPECT_LT(flexion, 130.0);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, EveryMotion,
                         testing::ValuesIn(std::vector<std::string>(motionNames().begin(),
                                                                    motionNames().end())),
                         [](const auto& motion) { return motion.param; });

TEST(Motion, RefusesUnknownNames) {
    EXPECT_EQ(makeMotion("moonwalk", settingsFor(0, 1)), nullptr);
}

TEST(TPose, IsTheNullPoseThatSwaysByLessThanAMillimetre) {
    const MotionSettings settings = settingsFor(0, 1);
    const BodyPose pose = makeMotion("tpose", settings)->sample(4.2);
    for (std::size_t index = 0; index < pose.size(); ++index) {
        EXPECT_TRUE(pose[index].orientation.isApprox(Eigen::Quaterniond::Identity()));
        EXPECT_LT((pose[index].position - settings.body.origins[index]).norm(), 0.001);
    }
    EXPECT_NE(makeMotion("tpose", settings)->sample(4.21)[0].position, pose[0].position);
}

TEST(Walk, HardlySlips) {
    for (int character = 0; character < 3; ++character) {
        const MotionSettings settings = settingsFor(character, 3, 1.65 + 0.1 * character);
        const auto motion = makeMotion("walk", settings);
        std::vector<double> slips;
        for (double t = 0.0; t < 20.0; t += kStep) {
            const BodyPose before = motion->sample(t - kStep);
            const BodyPose now = motion->sample(t);
            const BodyPose after = motion->sample(t + kStep);
            for (const Side side : kSides) {
                const auto a = worldSolePoints(settings.body, side, before);
                const auto b = worldSolePoints(settings.body, side, now);
                const auto c = worldSolePoints(settings.body, side, after);
                for (std::size_t k = 0; k < b.size(); ++k) {
                    if (b[k].z() < 0.004) {
                        slips.push_back((c[k] - a[k]).head<2>().norm() / (2.0 * kStep));
                    }
                }
            }
        }
        EXPECT_LT(percentile(slips, 0.5), 0.05);
        EXPECT_LT(percentile(slips, 0.9), 0.12);
    }
}

/// Seconds from one strike of the right heel to the next.
double strideTimeOf(const Motion& walk) {
    double longest = 0.0;
    for (double t = 0.0; t < 2.0; t += 0.0005) {
        longest = std::max(longest, walk.sinceHeelStrike(Side::Right, t));
    }
    return longest;
}

TEST(Walk, TakesStepsLikeAPerson) {
    const MotionSettings settings = settingsFor(0, 1);
    const auto walk = makeMotion("walk", settings);
    EXPECT_GT(strideTimeOf(*walk), 0.95);
    EXPECT_LT(strideTimeOf(*walk), 1.25);
    double lowest = 2.0;
    double highest = 0.0;
    for (double t = 0.0; t < 10.0; t += 0.01) {
        const double height = walk->sample(t)[kPelvis].position.z();
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
    EXPECT_GT(highest - lowest, 0.015);
    EXPECT_LT(highest - lowest, 0.060);
    EXPECT_NEAR(highest, 0.9275, 0.03);
}

TEST(Walk, LiftsTheToeClearOfTheFloor) {
    const MotionSettings settings = settingsFor(0, 1);
    const auto walk = makeMotion("walk", settings);
    const double strideTime = strideTimeOf(*walk);
    for (double t = 0.0; t < 20.0; t += 0.004) {
        for (const Side side : kSides) {
            const double phase = walk->sinceHeelStrike(side, t) / strideTime;
            if (phase < 0.72 || phase > 0.90) {
                continue;
            }
            for (const Vector3d& point : worldSolePoints(settings.body, side, walk->sample(t))) {
                EXPECT_GT(point.z(), 0.003) << "phase " << phase;
            }
        }
    }
}

TEST(Walk, FacesWhereItGoes) {
    const auto walk = makeMotion("walk", settingsFor(0, 1));
    for (double t = 0.0; t < 20.0; t += 0.21) {
        const Vector3d way =
            walk->sample(t + 0.55)[kPelvis].position - walk->sample(t - 0.55)[kPelvis].position;
        const Vector3d facing = walk->sample(t)[kPelvis].orientation * Vector3d::UnitX();
        EXPECT_GT(way.normalized().dot(facing), 0.95);
    }
}

TEST(Walk, SwingsTheArmsAgainstTheLegs) {
    const auto walk = makeMotion("walk", settingsFor(0, 1));
    double together = 0.0;
    for (double t = 0.0; t < 10.0; t += 0.01) {
        const BodyPose pose = walk->sample(t);
        const auto ahead = [&](int segment) {
            return (pose[kPelvis].orientation.conjugate() *
                    (pose[static_cast<std::size_t>(segment)].position - pose[kPelvis].position))
                .x();
        };
        together += (ahead(kRightHand) - ahead(kLeftHand)) * (ahead(kRightFoot) - ahead(kLeftFoot));
    }
    EXPECT_LT(together, 0.0);
}

TEST(Walk, NeverBringsTwoCharactersTogether) {
    for (int count = 2; count <= 8; ++count) {
        std::vector<std::unique_ptr<Motion>> motions;
        for (int character = 0; character < count; ++character) {
            motions.push_back(makeMotion("walk", settingsFor(character, count, 1.6 + 0.05 * character)));
        }
        double closest = 10.0;
        for (double t = 0.0; t < 60.0; t += 0.1) {
            std::vector<Eigen::Vector2d> places;
            for (const auto& motion : motions) {
                places.emplace_back(motion->sample(t)[kPelvis].position.head<2>());
            }
            for (std::size_t a = 0; a < places.size(); ++a) {
                for (std::size_t b = 0; b < a; ++b) {
                    closest = std::min(closest, (places[a] - places[b]).norm());
                }
            }
        }
        EXPECT_GT(closest, 1.0) << count << " characters";
    }
}

TEST(Walk, CrossesThePathOfTheOther) {
    const auto first = makeMotion("walk", settingsFor(0, 2));
    const auto second = makeMotion("walk", settingsFor(1, 2));
    const auto closest = [](const Motion& motion) {
        double distance = 10.0;
        for (double t = 0.0; t < 20.0; t += 0.05) {
            distance = std::min(distance, motion.sample(t)[kPelvis].position.head<2>().norm());
        }
        return distance;
    };
    EXPECT_LT(closest(*first), 0.15);
    EXPECT_LT(closest(*second), 0.15);
}

TEST(Walk, GivesEveryCharacterAGaitOfItsOwn) {
    const auto first = makeMotion("walk", settingsFor(0, 2));
    const auto second = makeMotion("walk", settingsFor(1, 2));
    EXPECT_NE(strideTimeOf(*first), strideTimeOf(*second));
    EXPECT_NE(first->sinceHeelStrike(Side::Right, 0.0), second->sinceHeelStrike(Side::Right, 0.0));
}

TEST(Idle, StaysOnItsSpotWithStillFeet) {
    const MotionSettings settings = settingsFor(1, 3);
    const auto motion = makeMotion("idle", settings);
    const BodyPose start = motion->sample(0.0);
    for (double t = 0.0; t < 30.0; t += 0.1) {
        const BodyPose pose = motion->sample(t);
        EXPECT_LT((pose[kRightFoot].position - start[kRightFoot].position).norm(), 0.003);
        EXPECT_LT((pose[kLeftToe].position - start[kLeftToe].position).norm(), 0.003);
        EXPECT_LT((pose[kPelvis].position - start[kPelvis].position).norm(), 0.12);
        EXPECT_LT(pose[kRightHand].position.z(), pose[kPelvis].position.z()) << "arms hang";
    }
}

TEST(Wave, RaisesTheRightHandAboveTheHeadNowAndThen) {
    const auto motion = makeMotion("wave", settingsFor(0, 1));
    bool waved = false;
    bool rested = false;
    for (double t = 0.0; t < 12.0; t += 0.05) {
        const BodyPose pose = motion->sample(t);
        waved |= pose[kRightHand].position.z() > pose[kHead].position.z();
        rested |= pose[kRightHand].position.z() < pose[kPelvis].position.z();
        EXPECT_LT(pose[kLeftHand].position.z(), pose[kPelvis].position.z());
    }
    EXPECT_TRUE(waved);
    EXPECT_TRUE(rested);
}

TEST(Squat, GoesDownAndUpWithTheHeelsOnTheFloor) {
    const MotionSettings settings = settingsFor(0, 1);
    const auto motion = makeMotion("squat", settings);
    double lowest = 2.0;
    for (double t = 0.0; t < 8.0; t += 0.02) {
        const BodyPose pose = motion->sample(t);
        lowest = std::min(lowest, pose[kPelvis].position.z());
        EXPECT_LT(worldSolePoints(settings.body, Side::Left, pose)[0].z(), 0.006);
    }
    EXPECT_LT(lowest, 0.55);
    EXPECT_GT(lowest, 0.40);
}

} // namespace
} // namespace posewire::performer
