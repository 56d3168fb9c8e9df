// SPDX-License-Identifier: MIT
#include "core/model/body/rigid_fit.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

namespace posewire::model {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

const Vector3d kPlace(1.5, -2.0, 0.9);
const Quaterniond kTurn = Quaterniond(0.3, -0.5, 0.7, 0.2).normalized();

std::vector<MarkerPair> markersAt(const std::vector<Vector3d>& locals) {
    std::vector<MarkerPair> markers;
    for (const Vector3d& local : locals) {
        markers.push_back({local, kPlace + kTurn * local});
    }
    return markers;
}

const std::vector<Vector3d> kFive{
    {0, 0, 0.17}, {-0.01, -0.07, 0.07}, {-0.01, 0.07, 0.07}, {-0.06, 0, 0.06}, {0.08, 0.01, 0.1}};

void expectTruth(const std::optional<RigidFit>& fit) {
    ASSERT_TRUE(fit.has_value());
    EXPECT_LT((fit->position - kPlace).norm(), 1e-9);
    EXPECT_LT(fit->rotation.angularDistance(kTurn), 1e-7);
    EXPECT_LT(fit->worst, 1e-9);
}

TEST(MarkerFits, FindThePoseOfMarkers) {
    expectTruth(fitMarkers(markersAt(kFive), 0.01));
    expectTruth(fitMarkers(markersAt({kFive[0], kFive[1], kFive[2]}), 0.01));
}

TEST(MarkerFits, AreNeverMirrored) {
    std::vector<MarkerPair> markers = markersAt(kFive);
    for (MarkerPair& marker : markers) {
        marker.world.x() = -marker.world.x();
    }
    const auto fit = fitMarkers(markers, 10.0);
    ASSERT_TRUE(fit.has_value());
    EXPECT_GT(fit->rotation.toRotationMatrix().determinant(), 0.99);
}

TEST(MarkerFits, ChangeBackTwoThatChangedPlaces) {
    std::vector<MarkerPair> markers = markersAt(kFive);
    std::swap(markers[1].world, markers[2].world);
    expectTruth(fitMarkers(markers, 0.01));
}

TEST(MarkerFits, LeaveOutThoseOfAnotherBody) {
    std::vector<MarkerPair> markers = markersAt(kFive);
    markers[3].world += Vector3d(0.4, 0, 0);
    markers[0].world += Vector3d(0, -0.3, 0.1);
    expectTruth(fitMarkers(markers, 0.01));
}

TEST(MarkerFits, NeedThreeThatAgreeAndAreOnNoLine) {
    EXPECT_FALSE(fitMarkers(markersAt({kFive[0], kFive[1]}), 0.01));
    EXPECT_FALSE(fitMarkers(markersAt({{0, 0, 0}, {0, 0, 0.1}, {0.001, 0, 0.2}}), 0.01));
    std::vector<MarkerPair> three = markersAt({kFive[0], kFive[1], kFive[2]});
    three[1].world += Vector3d(0.2, 0, 0);
    EXPECT_FALSE(fitMarkers(three, 0.01));
}

TEST(RotationFits, TurnOneVectorTheShortestWayFromThePrior) {
    const Quaterniond prior(Eigen::AngleAxisd(0.4, Vector3d::UnitY()));
    const Vector3d local(0, 0.285, 0);
    const Vector3d world(0.1, 0.2, -0.17);
    const std::vector<VectorPair> one{{local, world}};
    const FittedRotation fitted = fitRotation(one, prior);
    EXPECT_EQ(fitted.rank, RotationRank::Direction);
    EXPECT_LT((fitted.rotation * local.normalized() - world.normalized()).norm(), 1e-3);
    const Quaterniond shortest = Quaterniond::FromTwoVectors(prior * local, world) * prior;
    EXPECT_LT(fitted.rotation.angularDistance(shortest), 2e-3);
}

TEST(RotationFits, KeepThePriorWhereNothingIsKnown) {
    EXPECT_EQ(fitRotation({}, kTurn).rank, RotationRank::Nothing);
    EXPECT_LT(fitRotation({}, kTurn).rotation.angularDistance(kTurn), 1e-9);
    const std::vector<VectorPair> tiny{{{0, 0.001, 0}, {0.001, 0, 0}}};
    EXPECT_EQ(fitRotation(tiny, kTurn).rank, RotationRank::Nothing);
}

TEST(RotationFits, ForgetThePriorWhereAllIsKnown) {
    const std::vector<VectorPair> two{{Vector3d::UnitX(), kTurn * Vector3d::UnitX()},
                                      {Vector3d::UnitY(), kTurn * Vector3d::UnitY()}};
    const FittedRotation fitted = fitRotation(two, Quaterniond(Eigen::AngleAxisd(2.0, Vector3d::UnitZ())));
    EXPECT_EQ(fitted.rank, RotationRank::Whole);
    EXPECT_LT(fitted.rotation.angularDistance(kTurn), 1e-6);
}

} // namespace
} // namespace posewire::model
