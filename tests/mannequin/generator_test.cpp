// SPDX-License-Identifier: MIT
#include "packaging/mannequin/generator.h"

#include "render/mesh/joints.h"

#include <algorithm>
#include <array>
#include <deque>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace posewire::render {
namespace {

std::array<float, kJointCount> spread(const SkinnedMesh& mesh, std::size_t vertex) {
    std::array<float, kJointCount> weights{};
    for (std::size_t i = 0; i < 4; ++i) {
        weights[mesh.joints[vertex][i]] += mesh.weights[vertex][static_cast<int>(i)];
    }
    return weights;
}

/// Vertices that have to be skinned per triangle where the last 24 are remembered.
double missesPerTriangle(const SkinnedMesh& mesh) {
    std::deque<std::uint32_t> cache;
    std::size_t misses = 0;
    for (const std::uint32_t vertex : mesh.indices) {
        if (std::ranges::find(cache, vertex) == cache.end()) {
            ++misses;
            cache.push_back(vertex);
            if (cache.size() > 24) {
                cache.pop_front();
            }
        }
    }
    return static_cast<double>(misses) / static_cast<double>(mesh.triangleCount());
}

/// The committed files.
class Generator : public testing::TestWithParam<Detail> {
protected:
    const SkinnedMesh m_mesh = loadMannequin(GetParam());
};

std::string detailName(const testing::TestParamInfo<Detail>& detail) {
    constexpr std::array<const char*, 3> kNames{"Low", "Medium", "High"};
    return kNames[static_cast<std::size_t>(detail.param)];
}

INSTANTIATE_TEST_SUITE_P(EveryDetail, Generator, testing::Values(Detail::Low, Detail::Medium, Detail::High),
                         detailName);

TEST_P(Generator, BuildsWhatIsCommitted) {
    const SkinnedMesh built = mannequin::generate(GetParam());
    ASSERT_EQ(built.vertexCount(), m_mesh.vertexCount());
    ASSERT_EQ(built.indices, m_mesh.indices);
    for (std::size_t i = 0; i < built.vertexCount(); ++i) {
        ASSERT_LT(glm::distance(built.positions[i], m_mesh.positions[i]), 1e-5F);
        ASSERT_LT(glm::distance(built.normals[i], m_mesh.normals[i]), 1e-3F);
        ASSERT_NEAR(built.occlusion[i], m_mesh.occlusion[i], 1.5F / 255.0F);
        const auto expected = spread(m_mesh, i);
        const auto actual = spread(built, i);
        for (std::size_t joint = 0; joint < kJointCount; ++joint) {
            ASSERT_NEAR(actual[joint], expected[joint], 1e-3F);
        }
    }
}

TEST_P(Generator, OrdersTrianglesSoThatVerticesAreSkinnedAboutOnce) {
    EXPECT_LT(missesPerTriangle(m_mesh), 0.75);
    // Vertices come in the order of their first use.
    std::uint32_t next = 0;
    for (const std::uint32_t vertex : m_mesh.indices) {
        ASSERT_LE(vertex, next);
        next = std::max(next, vertex + 1);
    }
}

} // namespace
} // namespace posewire::render
