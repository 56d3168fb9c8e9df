// SPDX-License-Identifier: MIT
#include "render/passes/mesh_store.h"

#include <algorithm>

namespace posewire::render {
namespace {

/// Vertices that are assumed to stay transformed: about what hardware keeps.
constexpr int kCacheSize = 24;

/// The triangles about each vertex: those of v are triangles[starts[v]] … triangles[starts[v + 1]].
struct Fans {
    std::vector<std::uint32_t> starts;
    std::vector<std::uint32_t> triangles;
};

Fans fansOf(std::span<const std::uint32_t> indices, std::size_t vertexCount) {
    Fans fans;
    fans.starts.assign(vertexCount + 1, 0);
    for (const std::uint32_t vertex : indices) {
        ++fans.starts[vertex + 1];
    }
    for (std::size_t v = 0; v < vertexCount; ++v) {
        fans.starts[v + 1] += fans.starts[v];
    }
    fans.triangles.resize(indices.size());
    std::vector<std::uint32_t> next(fans.starts.begin(), fans.starts.end() - 1);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        fans.triangles[next[indices[i]]++] = static_cast<std::uint32_t>(i / 3);
    }
    return fans;
}

class Tipsify {
public:
    Tipsify(std::span<const std::uint32_t> indices, std::size_t vertexCount)
        : m_indices(indices),
          m_fans(fansOf(indices, vertexCount)),
          m_open(vertexCount),
          m_stamps(vertexCount, 0),
          m_isEmitted(indices.size() / 3, false) {
        for (std::size_t v = 0; v < vertexCount; ++v) {
            m_open[v] = static_cast<int>(m_fans.starts[v + 1] - m_fans.starts[v]);
        }
    }

    std::vector<std::uint32_t> run() {
        m_order.reserve(m_indices.size());
        for (int fan = 0; fan >= 0; fan = nextFan()) {
            emitFan(static_cast<std::uint32_t>(fan));
        }
        return std::move(m_order);
    }

private:
    void emitFan(std::uint32_t fan) {
        m_ring.clear();
        for (std::uint32_t i = m_fans.starts[fan]; i < m_fans.starts[fan + 1]; ++i) {
            const std::uint32_t triangle = m_fans.triangles[i];
            if (m_isEmitted[triangle]) {
                continue;
            }
            m_isEmitted[triangle] = true;
            for (std::size_t corner = 0; corner < 3; ++corner) {
                emitVertex(m_indices[std::size_t{3} * triangle + corner]);
            }
        }
    }

    void emitVertex(std::uint32_t vertex) {
        m_order.push_back(vertex);
        m_deadEnds.push_back(vertex);
        m_ring.push_back(vertex);
        --m_open[vertex];
        if (m_time - m_stamps[vertex] > kCacheSize) {
            m_stamps[vertex] = m_time++;
        }
    }

    /// The vertex about which to go on: the oldest one of the last fan that will still be in the cache.
    int nextFan() {
        int best = -1;
        int bestAge = -1;
        for (const std::uint32_t vertex : m_ring) {
            if (m_open[vertex] <= 0) {
                continue;
            }
            const int age = m_time - m_stamps[vertex];
            const int priority = age + 2 * m_open[vertex] <= kCacheSize ? age : 0;
            if (priority > bestAge) {
                bestAge = priority;
                best = static_cast<int>(vertex);
            }
        }
        return best >= 0 ? best : skipDeadEnd();
    }

    int skipDeadEnd() {
        while (!m_deadEnds.empty()) {
            const std::uint32_t vertex = m_deadEnds.back();
            m_deadEnds.pop_back();
            if (m_open[vertex] > 0) {
                return static_cast<int>(vertex);
            }
        }
        for (; m_cursor < m_open.size(); ++m_cursor) {
            if (m_open[m_cursor] > 0) {
                return static_cast<int>(m_cursor);
            }
        }
        return -1;
    }

    std::span<const std::uint32_t> m_indices;
    Fans m_fans;
    /// Triangles of each vertex that have not been emitted.
    std::vector<int> m_open;
    std::vector<int> m_stamps;
    std::vector<bool> m_isEmitted;
    std::vector<std::uint32_t> m_order;
    std::vector<std::uint32_t> m_deadEnds;
    std::vector<std::uint32_t> m_ring;
    std::size_t m_cursor = 0;
    int m_time = kCacheSize + 1;
};

} // namespace

std::vector<std::uint32_t> orderForVertexReuse(std::span<const std::uint32_t> indices,
                                               std::size_t vertexCount) {
    if (indices.empty()) {
        return {};
    }
    return Tipsify(indices, vertexCount).run();
}

} // namespace posewire::render
