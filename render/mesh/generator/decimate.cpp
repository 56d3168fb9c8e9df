// SPDX-License-Identifier: MIT
#include "render/mesh/generator/decimate.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace posewire::render::mannequin {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Weighted squared distances to planes: xᵀ A x + 2 b·x + c.
struct Quadric {
    glm::dmat3 a{0.0};
    glm::dvec3 b{0.0};
    double c = 0.0;

    void addPlane(const glm::dvec3& normal, double offset, double weight) {
        a += weight * glm::outerProduct(normal, normal);
        b += weight * offset * normal;
        c += weight * offset * offset;
    }

    double error(const glm::dvec3& x) const { return glm::dot(x, a * x) + 2.0 * glm::dot(b, x) + c; }
};

Quadric operator+(const Quadric& p, const Quadric& q) {
    return {p.a + q.a, p.b + q.b, p.c + q.c};
}

/// Keeps flat regions evenly meshed: a small pull of each point to where it was.
constexpr double kAnchor = 2e-3;
constexpr double kSmallestTurn = 0.3;
constexpr double kWorstShape = 0.12;

glm::dvec3 areaOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return glm::cross(b - a, c - a);
}

/// 1 for an equilateral triangle, 0 for a needle.
double shapeOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 bc = c - b;
    const glm::dvec3 ca = a - c;
    const double edges = glm::dot(ab, ab) + glm::dot(bc, bc) + glm::dot(ca, ca);
    return 2.0 * std::sqrt(3.0) * glm::length(areaOf(a, b, c)) / std::max(edges, 1e-12);
}

struct Collapse {
    double cost;
    std::uint32_t kept;
    std::uint32_t gone;
    std::uint32_t stamp;
    glm::dvec3 place;

    bool operator<(const Collapse& other) const { return cost > other.cost; }
};

class Decimation {
public:
    Decimation(const TriangleSurface& surface, const DecimationTarget& target)
        : m_points(surface.points),
          m_faces(surface.faces),
          m_facesOf(surface.points.size()),
          m_quadrics(surface.points.size()),
          m_stamps(surface.points.size(), 0),
          m_target(target),
          m_alive(surface.faces.size()) {
        for (std::uint32_t f = 0; f < m_faces.size(); ++f) {
            addQuadric(m_faces[f]);
            for (const std::uint32_t vertex : m_faces[f]) {
                m_facesOf[vertex].push_back(f);
            }
        }
        for (std::uint32_t vertex = 0; vertex < m_points.size(); ++vertex) {
            for (const std::uint32_t neighbour : neighboursOf(vertex)) {
                if (vertex < neighbour) {
                    propose(vertex, neighbour);
                }
            }
        }
    }

    void run() {
        while (m_alive > m_target.faceCount && !m_queue.empty()) {
            const Collapse next = m_queue.top();
            m_queue.pop();
            if (next.stamp == m_stamps[next.kept] + m_stamps[next.gone] && isAllowed(next)) {
                carryOut(next);
            }
        }
    }

    TriangleSurface result() const {
        TriangleSurface surface;
        std::vector<std::uint32_t> newIndex(m_points.size());
        for (std::size_t i = 0; i < m_points.size(); ++i) {
            newIndex[i] = static_cast<std::uint32_t>(surface.points.size());
            if (!m_facesOf[i].empty()) {
                surface.points.push_back(m_points[i]);
            }
        }
        for (const auto& [a, b, c] : m_faces) {
            if (a != b) {
                surface.faces.push_back({newIndex[a], newIndex[b], newIndex[c]});
            }
        }
        return surface;
    }

private:
    void addQuadric(const Triangle& face) {
        const auto& p = m_points;
        const glm::dvec3 area = areaOf(p[face[0]], p[face[1]], p[face[2]]);
        const double size = glm::length(area);
        const double weight = size * m_target.importance(p[face[0]]);
        const glm::dvec3 normal = area / std::max(size, 1e-15);
        for (const std::uint32_t vertex : face) {
            Quadric& quadric = m_quadrics[vertex];
            quadric.addPlane(normal, -glm::dot(normal, p[face[0]]), weight);
            if (isOnMirrorPlane(p[vertex])) {
                const glm::dvec3 mirrored(normal.x, -normal.y, normal.z);
                quadric.addPlane(mirrored, -glm::dot(normal, p[face[0]]), weight);
            }
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 direction(0.0);
                direction[axis] = 1.0;
                quadric.addPlane(direction, -p[vertex][axis], weight * kAnchor);
            }
        }
    }

    std::vector<std::uint32_t> neighboursOf(std::uint32_t vertex) const {
        std::vector<std::uint32_t> neighbours;
        for (const std::uint32_t f : m_facesOf[vertex]) {
            for (const std::uint32_t other : m_faces[f]) {
                if (other != vertex) {
                    neighbours.push_back(other);
                }
            }
        }
        std::sort(neighbours.begin(), neighbours.end());
        neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
        return neighbours;
    }

    std::size_t sharedFaces(std::uint32_t a, std::uint32_t b) const {
        return static_cast<std::size_t>(
            std::count_if(m_facesOf[a].begin(), m_facesOf[a].end(), [&](std::uint32_t f) {
                return std::find(m_faces[f].begin(), m_faces[f].end(), b) != m_faces[f].end();
            }));
    }

    void propose(std::uint32_t a, std::uint32_t b) {
        const bool isRimA = isOnMirrorPlane(m_points[a]);
        const bool isRimB = isOnMirrorPlane(m_points[b]);
        if (isRimB && !isRimA) {
            std::swap(a, b);
        }
        const Quadric sum = m_quadrics[a] + m_quadrics[b];
        glm::dvec3 place = m_points[a];
        if (isRimA == isRimB) {
            place = bestPlace(sum, isRimA, (m_points[a] + m_points[b]) / 2.0);
        }
        m_queue.push({sum.error(place), a, b, m_stamps[a] + m_stamps[b], place});
    }

    static glm::dvec3 bestPlace(const Quadric& quadric, bool isRim, const glm::dvec3& middle) {
        glm::dmat3 a = quadric.a;
        glm::dvec3 b = -quadric.b;
        if (isRim) {
            // Solve in the plane: y is decoupled and pinned to zero.
            a[0].y = a[2].y = a[1].x = a[1].z = 0.0;
            a[1].y = 1.0;
            b.y = 0.0;
        }
        const glm::dvec3 place = glm::inverse(a) * b;
        const bool isSound = glm::distance(place, middle) < 0.1;
        return isSound ? glm::dvec3(place.x, isRim ? 0.0 : place.y, place.z) : middle;
    }

    bool isAllowed(const Collapse& collapse) const {
        const std::size_t shared = sharedFaces(collapse.kept, collapse.gone);
        const bool areBothRim =
            isOnMirrorPlane(m_points[collapse.kept]) && isOnMirrorPlane(m_points[collapse.gone]);
        if (shared != (areBothRim ? 1U : 2U)) {
            return false;
        }
        if (collapse.place.y <= 0.0 && !isOnMirrorPlane(m_points[collapse.kept])) {
            return false;
        }
        // The link condition: the ends share no neighbours but the tips of the faces that vanish.
        const auto aroundKept = neighboursOf(collapse.kept);
        const auto aroundGone = neighboursOf(collapse.gone);
        std::vector<std::uint32_t> common;
        std::set_intersection(aroundKept.begin(), aroundKept.end(), aroundGone.begin(), aroundGone.end(),
                              std::back_inserter(common));
        return common.size() == shared && leavesGoodFaces(collapse, collapse.kept, collapse.gone) &&
               leavesGoodFaces(collapse, collapse.gone, collapse.kept);
    }

    bool leavesGoodFaces(const Collapse& collapse, std::uint32_t moved, std::uint32_t other) const {
        for (const std::uint32_t f : m_facesOf[moved]) {
            const Triangle& face = m_faces[f];
            if (std::find(face.begin(), face.end(), other) != face.end()) {
                continue;
            }
            std::array<glm::dvec3, 3> before;
            std::array<glm::dvec3, 3> after;
            for (std::size_t i = 0; i < 3; ++i) {
                before[i] = m_points[face[i]];
                after[i] = face[i] == moved ? collapse.place : before[i];
                if (glm::distance(after[i], collapse.place) > m_target.longestEdge) {
                    return false;
                }
            }
            const glm::dvec3 was = areaOf(before[0], before[1], before[2]);
            const glm::dvec3 is = areaOf(after[0], after[1], after[2]);
            if (glm::dot(was, is) < kSmallestTurn * glm::length(was) * glm::length(is) ||
                shapeOf(after[0], after[1], after[2]) < kWorstShape) {
                return false;
            }
        }
        return true;
    }

    void carryOut(const Collapse& collapse) {
        m_points[collapse.kept] = collapse.place;
        m_quadrics[collapse.kept] = m_quadrics[collapse.kept] + m_quadrics[collapse.gone];
        for (const std::uint32_t f : std::exchange(m_facesOf[collapse.gone], {})) {
            Triangle& face = m_faces[f];
            if (std::find(face.begin(), face.end(), collapse.kept) != face.end()) {
                removeFace(f);
            } else {
                std::replace(face.begin(), face.end(), collapse.gone, collapse.kept);
                m_facesOf[collapse.kept].push_back(f);
            }
        }
        ++m_stamps[collapse.gone];
        ++m_stamps[collapse.kept];
        for (const std::uint32_t neighbour : neighboursOf(collapse.kept)) {
            propose(collapse.kept, neighbour);
        }
    }

    void removeFace(std::uint32_t f) {
        for (const std::uint32_t vertex : m_faces[f]) {
            std::erase(m_facesOf[vertex], f);
        }
        m_faces[f] = {};
        --m_alive;
    }

    std::vector<glm::dvec3> m_points;
    /// A removed face has three equal corners.
    std::vector<Triangle> m_faces;
    std::vector<std::vector<std::uint32_t>> m_facesOf;
    std::vector<Quadric> m_quadrics;
    /// Count of a vertex's moves: a proposal made before one is void.
    std::vector<std::uint32_t> m_stamps;
    std::priority_queue<Collapse> m_queue;
    DecimationTarget m_target;
    std::size_t m_alive;
};

} // namespace

TriangleSurface decimated(const TriangleSurface& surface, const DecimationTarget& target) {
    Decimation decimation(surface, target);
    decimation.run();
    return decimation.result();
}

} // namespace posewire::render::mannequin
