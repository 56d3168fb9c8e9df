// SPDX-License-Identifier: MIT
#include "packaging/mannequin/half_surface.h"
#include "packaging/mannequin/lattice.h"

#include <limits>
#include <utility>

namespace posewire::render::mannequin {
namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

using Cell = std::array<std::size_t, 3>;

class SurfaceNets {
public:
    SurfaceNets(const Body& body, double step)
        : m_lattice(step), m_sizes{m_lattice.sizeX(), m_lattice.sizeY(), m_lattice.sizeZ()} {
        m_values.resize(m_sizes[0] * m_sizes[1] * m_sizes[2]);
        m_vertices.resize(m_values.size(), kNoVertex);
        forEachNode(0, [&](const Cell& node) {
            m_values[at(node)] = body.distance(m_lattice.node(node[0], node[1], node[2]));
        });
    }

    QuadSurface extract() {
        forEachNode(1, [&](const Cell& cell) { placeVertex(cell); });
        for (std::size_t axis = 0; axis < 3; ++axis) {
            forEachNode(1, [&](const Cell& node) { addQuad(node, axis); });
        }
        return std::move(m_surface);
    }

private:
    std::size_t at(const Cell& node) const { return m_lattice.index(node[0], node[1], node[2]); }
    bool isInside(const Cell& node) const { return m_values[at(node)] < 0.0; }

    template <typename Visit>
    void forEachNode(std::size_t margin, Visit visit) const {
        for (std::size_t i = 0; i + margin < m_sizes[0]; ++i) {
            for (std::size_t j = 0; j + margin < m_sizes[1]; ++j) {
                for (std::size_t k = 0; k + margin < m_sizes[2]; ++k) {
                    visit(Cell{i, j, k});
                }
            }
        }
    }

    /// The mean of the places where the cell's edges cross the surface.
    void placeVertex(const Cell& cell) {
        glm::dvec3 sum(0.0);
        int crossings = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t u = (axis + 1) % 3;
            const std::size_t v = (axis + 2) % 3;
            for (std::size_t edge = 0; edge < 4; ++edge) {
                Cell from = cell;
                from[u] += edge & 1U;
                from[v] += edge >> 1U;
                Cell to = from;
                ++to[axis];
                const double a = m_values[at(from)];
                const double b = m_values[at(to)];
                if ((a < 0.0) != (b < 0.0)) {
                    const double t = a / (a - b);
                    sum += place(from) * (1.0 - t) + place(to) * t;
                    ++crossings;
                }
            }
        }
        if (crossings == 0) {
            return;
        }
        glm::dvec3 point = sum / static_cast<double>(crossings);
        if (cell[1] == 0) {
            point.y = 0.0;
        }
        m_vertices[at(cell)] = static_cast<std::uint32_t>(m_surface.points.size());
        m_surface.points.push_back(point);
    }

    /// Joins the four cells around the edge from the node along the axis, where the edge changes sign.
    void addQuad(const Cell& node, std::size_t axis) {
        const std::size_t u = (axis + 1) % 3;
        const std::size_t v = (axis + 2) % 3;
        Cell end = node;
        ++end[axis];
        if (node[u] == 0 || node[v] == 0 || isInside(node) == isInside(end)) {
            return;
        }
        const auto vertex = [&](std::size_t backU, std::size_t backV) {
            Cell cell = node;
            cell[u] -= backU;
            cell[v] -= backV;
            return m_vertices[at(cell)];
        };
        if (isInside(node)) {
            m_surface.faces.push_back({vertex(1, 1), vertex(0, 1), vertex(0, 0), vertex(1, 0)});
        } else {
            m_surface.faces.push_back({vertex(1, 0), vertex(0, 0), vertex(0, 1), vertex(1, 1)});
        }
    }

    glm::dvec3 place(const Cell& node) const { return m_lattice.node(node[0], node[1], node[2]); }

    Lattice m_lattice;
    std::array<std::size_t, 3> m_sizes;
    std::vector<double> m_values;
    /// By the cell's lowest node.
    std::vector<std::uint32_t> m_vertices;
    QuadSurface m_surface;
};

} // namespace

QuadSurface extractSurface(const Body& body, double step) {
    return SurfaceNets(body, step).extract();
}

} // namespace posewire::render::mannequin
