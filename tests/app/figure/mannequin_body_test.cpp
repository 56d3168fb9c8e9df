// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/figure/mannequin_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace posewire::figure {
namespace {

model::BodyOrigins tall(double factor) {
    model::BodyOrigins body{model::referenceOrigins()};
    for (Eigen::Vector3d& place : body.places) {
        place *= factor;
    }
    return body;
}

double heightOf(const exporting::BodyMesh& body) {
    float height = 0;
    for (const auto& position : body.positions) {
        height = std::max(height, position[2]);
    }
    return height;
}

TEST(MannequinBody, IsAWholeSkinOfBodySegments) {
    const exporting::BodyMesh body = mannequinBody(tall(1));
    ASSERT_FALSE(body.positions.empty());
    EXPECT_EQ(body.normals.size(), body.positions.size());
    EXPECT_EQ(body.weights.size(), body.positions.size());
    ASSERT_EQ(body.segments.size(), body.positions.size());
    EXPECT_EQ(body.indices.size() % 3, 0U);
    EXPECT_LT(std::ranges::max(body.indices), body.positions.size());
    std::array<bool, model::kBodySegmentCount> moves{};
    for (std::size_t i = 0; i < body.positions.size(); ++i) {
        float sum = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            ASSERT_LT(body.segments[i][k], model::kBodySegmentCount);
            moves[body.segments[i][k]] = moves[body.segments[i][k]] || body.weights[i][k] > 0;
            sum += body.weights[i][k];
        }
        EXPECT_NEAR(sum, 1, 1e-4);
        const auto& normal = body.normals[i];
        EXPECT_NEAR(std::hypot(normal[0], normal[1], normal[2]), 1, 1e-4);
    }
    EXPECT_EQ(std::ranges::count(moves, true), model::kBodySegmentCount);
}

/// As glTF demands: it has no vertex that one joint moves twice, and weights add up to the last digit.
TEST(MannequinBody, IsMovedByEachSegmentOnce) {
    const exporting::BodyMesh body = mannequinBody(tall(1));
    for (std::size_t i = 0; i < body.segments.size(); ++i) {
        std::array<int, model::kBodySegmentCount> times{};
        float sum = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const bool moves = body.weights[i][k] > 0;
            times[body.segments[i][k]] += moves ? 1 : 0;
            EXPECT_TRUE(moves || body.segments[i][k] == 0) << i;
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
    model::BodyOrigins odd = tall(1);
    odd.places[5] = Eigen::Vector3d::Constant(std::nan(""));
    for (const Eigen::Vector3d& origin : mannequinBody(odd).origins) {
        EXPECT_TRUE(origin.allFinite());
    }
}

} // namespace
} // namespace posewire::figure
