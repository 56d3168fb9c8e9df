// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/figure/mannequin_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace posewire::figure {
namespace {

/// Without fingers.
exporting::SegmentPlaces tall(double factor) {
    exporting::SegmentPlaces places;
    places.fill(Eigen::Vector3d::Constant(std::nan("")));
    std::ranges::transform(model::referenceOrigins(), places.begin(), [factor](const Eigen::Vector3d& place) {
        return Eigen::Vector3d(factor * place);
    });
    return places;
}

/// The wrist's own place: the fit moves them to where a hand of that size has them.
exporting::SegmentPlaces withFingers(exporting::SegmentPlaces places) {
    const std::size_t first = model::kBodySegments + model::kMaxPropCount;
    for (std::size_t i = 0; i < model::kFingerSegmentCount; ++i) {
        places[first + i] =
            places[i < model::kHandSegmentCount ? model::segment::kLeftHand : model::segment::kRightHand];
    }
    return places;
}

double heightOf(const exporting::BodyMesh& body) {
    float height = 0;
    for (const auto& position : body.positions) {
        height = std::max(height, position[2]);
    }
    return height;
}

TEST(MannequinBody, IsAWholeSkin) {
    for (const auto& performer : {tall(1), withFingers(tall(1))}) {
        const exporting::BodyMesh body = mannequinBody(performer);
        ASSERT_FALSE(body.positions.empty());
        EXPECT_EQ(body.normals.size(), body.positions.size());
        EXPECT_EQ(body.weights.size(), body.positions.size());
        ASSERT_EQ(body.joints.size(), body.positions.size());
        EXPECT_EQ(body.indices.size() % 3, 0U);
        EXPECT_LT(std::ranges::max(body.indices), body.positions.size());
        std::vector<bool> moves(body.skeleton.size());
        for (std::size_t i = 0; i < body.positions.size(); ++i) {
            for (std::size_t k = 0; k < 4; ++k) {
                ASSERT_LT(body.joints[i][k], body.skeleton.size());
                moves[body.joints[i][k]] = moves[body.joints[i][k]] || body.weights[i][k] > 0;
            }
            const auto& normal = body.normals[i];
            EXPECT_NEAR(std::hypot(normal[0], normal[1], normal[2]), 1, 1e-4);
        }
        EXPECT_EQ(std::ranges::count(moves, false), 0);
    }
}

TEST(MannequinBody, IsMovedByEachFingerThatIsSent) {
    const auto segmentsOf = [](const exporting::SegmentPlaces& performer) {
        return std::ranges::count_if(mannequinBody(performer).skeleton,
                                     [](const exporting::BodyJoint& joint) { return joint.name.empty(); });
    };
    EXPECT_EQ(segmentsOf(tall(1)), model::kBodySegmentCount);
    EXPECT_GE(segmentsOf(withFingers(tall(1))), model::kBodySegmentCount + 2 * 19);
}

/// As glTF demands: it has no vertex that one joint moves twice, and weights add up to the last digit.
TEST(MannequinBody, IsMovedByEachJointOnce) {
    const exporting::BodyMesh body = mannequinBody(withFingers(tall(1)));
    for (std::size_t i = 0; i < body.joints.size(); ++i) {
        std::vector<int> times(body.skeleton.size());
        float sum = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const bool moves = body.weights[i][k] > 0;
            times[body.joints[i][k]] += moves ? 1 : 0;
            EXPECT_TRUE(moves || body.joints[i][k] == 0) << i;
            sum += body.weights[i][k];
        }
        EXPECT_LE(std::ranges::max(times), 1) << i;
        EXPECT_NEAR(sum, 1, 4e-7) << i;
    }
}

TEST(MannequinBody, IsAsTallAsThePerformer) {
    EXPECT_NEAR(heightOf(mannequinBody(tall(1))), 1.75, 0.02);
    EXPECT_NEAR(heightOf(mannequinBody(tall(1.1))), 1.925, 0.02);
}

TEST(MannequinBody, TakesNoOriginThatMakesNoSense) {
    exporting::SegmentPlaces odd = tall(1);
    odd[5] = Eigen::Vector3d::Constant(std::nan(""));
    for (const exporting::BodyJoint& joint : mannequinBody(odd).skeleton) {
        EXPECT_TRUE(joint.origin.allFinite());
    }
}

} // namespace
} // namespace posewire::figure
