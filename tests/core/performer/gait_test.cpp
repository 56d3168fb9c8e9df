// SPDX-License-Identifier: MIT
#include "core/performer/curves.h"
#include "core/performer/noise.h"
#include "core/performer/walk_clip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace posewire::performer {
namespace {

/// Rows of the published means, in degrees.
struct Row {
    double percent, obliquity, rotation, hip, adduction, knee, ankle;
};
constexpr Row kRows[] = {
    {0, 0.8, 4.4, 35.8, -1.6, 5.6, -2.1},     {12, 3.8, 3.4, 31.1, 4.5, 19.3, -0.2},
    {32, -0.1, 0.5, 9.3, 2.9, 9.0, 9.1},      {52, -1.0, -4.4, -5.8, -0.0, 14.5, 8.4},
    {64, -4.1, -3.6, 6.1, -7.0, 46.3, -19.8}, {72, -2.8, -3.1, 21.4, -5.6, 59.1, -7.9},
    {88, 0.4, 1.1, 36.6, -2.2, 25.5, 1.8},
};

TEST(Gait, FollowsThePublishedMeans) {
    for (const Row& row : kRows) {
        const GaitAngles angles = gaitAngles(row.percent / 100.0);
        EXPECT_NEAR(angles.pelvisObliquity, row.obliquity, 0.2) << row.percent;
        EXPECT_NEAR(angles.pelvisRotation, row.rotation, 0.2) << row.percent;
        EXPECT_NEAR(angles.hipFlexion, row.hip, 0.2) << row.percent;
        EXPECT_NEAR(angles.hipAdduction, row.adduction, 0.2) << row.percent;
        EXPECT_NEAR(angles.kneeFlexion, row.knee, 0.4) << row.percent;
        EXPECT_NEAR(angles.ankleDorsiflexion, row.ankle, 0.7) << row.percent;
    }
}

TEST(Gait, RepeatsAfterOneCycle) {
    EXPECT_NEAR(gaitAngles(0.37).kneeFlexion, gaitAngles(5.37).kneeFlexion, 1e-9);
    EXPECT_NEAR(gaitAngles(-0.63).kneeFlexion, gaitAngles(0.37).kneeFlexion, 1e-9);
}

TEST(PeriodicSpline, PassesThroughItsSamplesAndClosesSmoothly) {
    std::vector<double> samples;
    for (int i = 0; i < 32; ++i) {
        samples.push_back(std::sin(2.0 * std::numbers::pi * i / 32.0) +
                          0.3 * std::cos(4.0 * std::numbers::pi * i / 32.0));
    }
    const PeriodicSpline<double> spline(samples);
    for (int i = 0; i < 32; ++i) {
        EXPECT_NEAR(spline.at(i / 32.0), samples[static_cast<std::size_t>(i)], 1e-12);
    }
    const double h = 1e-4;
    const auto second = [&](double x) {
        return (spline.at(x + h) - 2.0 * spline.at(x) + spline.at(x - h)) / (h * h);
    };
    EXPECT_NEAR(second(1e-3), second(1.0 - 1e-3), 0.7);
    EXPECT_NEAR(spline.at(1.013),
                std::sin(2.0 * std::numbers::pi * 0.013) + 0.3 * std::cos(4.0 * std::numbers::pi * 0.013),
                1e-4);
}

TEST(FigureOfEight, HasTheLengthOfALemniscate) {
    // 2 · 2.62205755… · half width: the lemniscate constant.
    EXPECT_NEAR(FigureOfEight(4.0).length(), 2.0 * 2.622057554 * 4.0, 1e-6);
}

TEST(FigureOfEight, IsWalkedAtEvenSpeedAlongItsHeading) {
    const FigureOfEight path(4.0);
    const double h = 1e-3;
    for (double s = 0.0; s < path.length(); s += 0.13) {
        const Eigen::Vector2d step = (path.at(s + h).position - path.at(s - h).position) / (2.0 * h);
        const PathPlace place = path.at(s);
        EXPECT_NEAR(step.norm(), 1.0, 1e-4);
        EXPECT_LT((step - Eigen::Vector2d(std::cos(place.heading), std::sin(place.heading))).norm(), 1e-3);
        const double turning = (path.at(s + h).heading - path.at(s - h).heading) / (2.0 * h);
        EXPECT_NEAR(turning, place.curvature, 1e-3);
    }
}

TEST(FigureOfEight, CrossesItselfInItsCentre) {
    const FigureOfEight path(4.0, {1.0, 2.0});
    const Eigen::Vector2d centre(1.0, 2.0);
    EXPECT_LT((path.at(0.0).position - centre).norm(), 1e-9);
    EXPECT_LT((path.at(0.5 * path.length()).position - centre).norm(), 1e-6);
    EXPECT_LT((path.at(-path.length()).position - centre).norm(), 1e-9);
}

TEST(Easing, StartsAndEndsAtRest) {
    EXPECT_EQ(smoothStep(1.0, 2.0, 0.5), 0.0);
    EXPECT_EQ(smoothStep(1.0, 2.0, 1.5), 0.5);
    EXPECT_EQ(smoothStep(1.0, 2.0, 2.5), 1.0);
    EXPECT_NEAR(smoothStep(1.0, 2.0, 1.001), 0.0, 1e-8);
}

TEST(KeyedRandom, GivesTheSameFiguresInAnyOrder) {
    const KeyedRandom random(42);
    const double later = random.uniform(9);
    EXPECT_NE(random.uniform(8), later);
    EXPECT_EQ(KeyedRandom(42).uniform(9), later);
    EXPECT_NE(KeyedRandom(43).uniform(9), later);
}

TEST(KeyedRandom, SpreadsNormalFiguresAsItSays) {
    const KeyedRandom random(5);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Vector3d squares = Eigen::Vector3d::Zero();
    constexpr int kCount = 20000;
    for (int key = 0; key < kCount; ++key) {
        const Eigen::Vector3d value = random.normal3(static_cast<std::uint64_t>(key));
        sum += value;
        squares += value.cwiseAbs2();
    }
    EXPECT_LT((sum / kCount).cwiseAbs().maxCoeff(), 0.03);
    EXPECT_LT((squares / kCount - Eigen::Vector3d::Ones()).cwiseAbs().maxCoeff(), 0.03);
}

} // namespace
} // namespace posewire::performer
