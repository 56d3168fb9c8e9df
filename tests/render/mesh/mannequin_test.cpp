// SPDX-License-Identifier: MIT
#include "render/mesh/joints.h"
#include "render/mesh/mannequin.h"
#include "tests/render/mesh/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace posewire::render {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// How often each edge is walked in each direction.
std::map<Edge, int> directedEdges(const SkinnedMesh& mesh) {
    std::map<Edge, int> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++edges[{mesh.indices[i + k], mesh.indices[i + (k + 1) % 3]}];
        }
    }
    return edges;
}

double volumeOf(const SkinnedMesh& mesh) {
    double volume = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]);
        const glm::dvec3 b(mesh.positions[mesh.indices[i + 1]]);
        const glm::dvec3 c(mesh.positions[mesh.indices[i + 2]]);
        volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return volume;
}

std::uint8_t otherSide(std::uint8_t joint) {
    std::string name(kJointNames[joint]);
    if (name.starts_with("Left")) {
        name.replace(0, 4, "Right");
    } else if (name.starts_with("Right")) {
        name.replace(0, 5, "Left");
    }
    const auto found = std::find(kJointNames.begin(), kJointNames.end(), name);
    return static_cast<std::uint8_t>(found - kJointNames.begin());
}

using Place = std::tuple<float, float, float>;

Place placeOf(const glm::vec3& p) {
    return {p.x, p.y, p.z};
}

/// A vertex's index by its place, and the index of its mirror image.
class Mirror {
public:
    explicit Mirror(const SkinnedMesh& mesh) : m_mesh(mesh) {
        for (std::uint32_t i = 0; i < mesh.vertexCount(); ++i) {
            m_vertexAt[placeOf(mesh.positions[i])] = i;
        }
    }

    std::size_t distinctPlaces() const { return m_vertexAt.size(); }

    /// The mesh's vertex count where there is none.
    std::size_t imageOf(std::uint32_t vertex) const {
        const glm::vec3& p = m_mesh.positions[vertex];
        const auto found = m_vertexAt.find({p.x, p.y == 0.0F ? p.y : -p.y, p.z});
        return found == m_vertexAt.end() ? m_mesh.vertexCount() : found->second;
    }

private:
    const SkinnedMesh& m_mesh;
    std::map<Place, std::uint32_t> m_vertexAt;
};

std::array<float, kJointCount> spread(const SkinnedMesh& mesh, std::size_t vertex) {
    std::array<float, kJointCount> weights{};
    for (std::size_t i = 0; i < 4; ++i) {
        weights[mesh.joints[vertex][i]] += mesh.weights[vertex][static_cast<int>(i)];
    }
    return weights;
}

/// Vertices to skin per triangle if the last 24 are remembered.
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

class MannequinTest : public testing::TestWithParam<Detail> {
protected:
    const SkinnedMesh m_mesh = loadMannequin(GetParam());
};

std::string detailName(const testing::TestParamInfo<Detail>& detail) {
    constexpr std::array<const char*, 3> kNames{"Low", "Medium", "High"};
    return kNames[static_cast<std::size_t>(detail.param)];
}

INSTANTIATE_TEST_SUITE_P(EveryDetail, MannequinTest,
                         testing::Values(Detail::Low, Detail::Medium, Detail::High), detailName);

TEST_P(MannequinTest, IsFitToDraw) {
    EXPECT_TRUE(m_mesh.validate(kJointCount));
}

TEST_P(MannequinTest, IsClosedWithTwoConsistentlyOrientedFacesAtEachEdge) {
    const auto edges = directedEdges(m_mesh);
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        ASSERT_TRUE(edges.contains({edge.second, edge.first}));
    }
}

TEST_P(MannequinTest, IsASphereInTopology) {
    const auto edges = static_cast<long>(directedEdges(m_mesh).size() / 2);
    EXPECT_EQ(static_cast<long>(m_mesh.vertexCount()) - edges + static_cast<long>(m_mesh.triangleCount()), 2);
    std::vector<bool> isUsed(m_mesh.vertexCount(), false);
    for (const std::uint32_t index : m_mesh.indices) {
        isUsed[index] = true;
    }
    EXPECT_EQ(std::count(isUsed.begin(), isUsed.end(), false), 0);
}

TEST_P(MannequinTest, HasUpToFourFallingWeightsThatSumToOne) {
    for (const glm::vec4& weights : m_mesh.weights) {
        ASSERT_NEAR(static_cast<double>(weights.x) + weights.y + weights.z + weights.w, 1.0, 1e-6);
        ASSERT_GE(weights.w, 0.0F);
        ASSERT_GE(weights.x, weights.y);
        ASSERT_GE(weights.y, weights.z);
        ASSERT_GE(weights.z, weights.w);
    }
}

TEST_P(MannequinTest, GivesEveryJointSomeVertices) {
    std::array<float, kJointCount> most{};
    for (std::size_t i = 0; i < m_mesh.vertexCount(); ++i) {
        const auto weights = spread(m_mesh, i);
        for (std::size_t joint = 0; joint < kJointCount; ++joint) {
            most[joint] = std::max(most[joint], weights[joint]);
        }
    }
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
        EXPECT_GT(most[joint], 0.4F) << kJointNames[joint];
    }
}

TEST_P(MannequinTest, IsItsOwnMirrorImageExactly) {
    const Mirror mirror(m_mesh);
    ASSERT_EQ(mirror.distinctPlaces(), m_mesh.vertexCount());
    for (std::uint32_t i = 0; i < m_mesh.vertexCount(); ++i) {
        const std::size_t image = mirror.imageOf(i);
        ASSERT_LT(image, m_mesh.vertexCount());
        ASSERT_EQ(m_mesh.occlusion[i], m_mesh.occlusion[image]);
        ASSERT_EQ(m_mesh.normals[i].x, m_mesh.normals[image].x);
        ASSERT_EQ(m_mesh.normals[i].y, -m_mesh.normals[image].y);
        ASSERT_EQ(m_mesh.normals[i].z, m_mesh.normals[image].z);
        const auto here = spread(m_mesh, i);
        const auto there = spread(m_mesh, image);
        for (std::uint8_t joint = 0; joint < kJointCount; ++joint) {
            ASSERT_EQ(here[joint], there[otherSide(joint)]) << kJointNames[joint] << " at vertex " << i;
        }
    }
}

TEST_P(MannequinTest, HasMirroredTriangles) {
    const Mirror mirror(m_mesh);
    const auto edges = directedEdges(m_mesh);
    for (const auto& [edge, count] : edges) {
        const auto from = static_cast<std::uint32_t>(mirror.imageOf(edge.first));
        const auto to = static_cast<std::uint32_t>(mirror.imageOf(edge.second));
        ASSERT_TRUE(edges.contains({to, from}));
    }
}

TEST_P(MannequinTest, HasUnitNormalsThatPointOutwards) {
    std::vector<glm::vec3> byArea(m_mesh.vertexCount());
    computeNormals(m_mesh.positions, m_mesh.indices, byArea);
    for (std::size_t i = 0; i < m_mesh.vertexCount(); ++i) {
        ASSERT_NEAR(glm::length(m_mesh.normals[i]), 1.0F, 1e-5F);
        ASSERT_GT(glm::dot(m_mesh.normals[i], byArea[i]), 0.0F) << "vertex " << i;
    }
    EXPECT_GT(volumeOf(m_mesh), 0.0);
}

TEST_P(MannequinTest, IsAPersonOf175CentimetresAndSome65Litres) {
    glm::vec3 low = m_mesh.positions.front();
    glm::vec3 high = low;
    for (const glm::vec3& position : m_mesh.positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    EXPECT_NEAR(high.z, 1.75F, 0.005F);
    EXPECT_NEAR(low.z, 0.0F, 0.005F);
    EXPECT_NEAR(high.y - low.y, 1.735F, 0.02F);
    EXPECT_GT(low.x, -0.14F);
    EXPECT_LT(high.x, 0.23F);
    EXPECT_GT(volumeOf(m_mesh), 0.060);
    EXPECT_LT(volumeOf(m_mesh), 0.070);
}

TEST_P(MannequinTest, HasWholeShoesWithTheirSolesOnTheFloor) {
    float toe = 0;
    float heel = 0;
    double sole = 0; // square metres, of both
    for (std::size_t i = 0; i + 2 < m_mesh.indices.size(); i += 3) {
        const glm::vec3& a = m_mesh.positions[m_mesh.indices[i]];
        const glm::vec3& b = m_mesh.positions[m_mesh.indices[i + 1]];
        const glm::vec3& c = m_mesh.positions[m_mesh.indices[i + 2]];
        toe = std::max({toe, a.x, b.x, c.x});
        heel = std::min(heel, a.z < 0.03F ? a.x : 0.0F);
        const glm::vec3 face = 0.5F * glm::cross(b - a, c - a);
        const bool isSole = std::max({a.z, b.z, c.z}) < 0.012F && face.z < -0.8F * glm::length(face);
        sole += isSole ? static_cast<double>(-face.z) : 0.0;
    }
    EXPECT_NEAR(toe, 0.220F, 0.004F);
    EXPECT_NEAR(heel, -0.069F, 0.004F);
    EXPECT_GT(sole, 2 * 0.0150);
}

TEST_P(MannequinTest, HasItsSegmentsWhereTheReferenceNullPosePutsThem) {
    // Each vertex lies near the bone that moves it most: a wrong joint order would put it far away.
    for (std::size_t i = 0; i < m_mesh.vertexCount(); ++i) {
        const glm::vec3& origin = kReferenceNullPose[jointSegment(m_mesh.joints[i][0])];
        ASSERT_LT(glm::distance(m_mesh.positions[i], origin), 0.55F);
        if (std::abs(origin.y) > 0.1F) {
            ASSERT_GT(origin.y * m_mesh.positions[i].y, 0.0F);
        }
    }
}

TEST_P(MannequinTest, OrdersTrianglesSoThatVerticesAreSkinnedAboutOnce) {
    EXPECT_LT(missesPerTriangle(m_mesh), 0.75);
    // Vertices come in the order of their first use.
    std::uint32_t next = 0;
    for (const std::uint32_t vertex : m_mesh.indices) {
        ASSERT_LE(vertex, next);
        next = std::max(next, vertex + 1);
    }
}

TEST(MannequinDetails, HaveTheSizesTheyWereMadeFor) {
    const std::size_t low = loadMannequin(Detail::Low).triangleCount();
    const std::size_t medium = loadMannequin(Detail::Medium).triangleCount();
    const std::size_t high = loadMannequin(Detail::High).triangleCount();
    EXPECT_GE(low, 2000U);
    EXPECT_LE(low, 5000U);
    EXPECT_NEAR(static_cast<double>(medium), 19600.0, 2000.0);
    EXPECT_GE(high, 46000U);
}

TEST(MannequinDetails, DifferByLessThanAStepOfTheLattice) {
    // Volumes agree when no limb is lost or fused in a coarser one.
    const double high = volumeOf(loadMannequin(Detail::High));
    EXPECT_NEAR(volumeOf(loadMannequin(Detail::Medium)), high, 0.01 * high);
    EXPECT_NEAR(volumeOf(loadMannequin(Detail::Low)), high, 0.02 * high);
}

} // namespace
} // namespace posewire::render
