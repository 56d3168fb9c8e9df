// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/ring.h"
#include "render/passes/frame.h"

#include <cstdint>
#include <span>
#include <vector>

namespace posewire::render {

/// Characters that one call draws: all of one mesh that are painted alike, or one with a mesh of its own.
struct InstanceRun {
    const GpuMesh* mesh = nullptr;
    int first = 0; ///< in the buffer
    int count = 0;
    /// Some of them have selected, solved or assumed segments.
    bool hasMarks = false;
    /// The only one, where the mesh is a user's own.
    const DrawnCharacter* own = nullptr;
};

/// What differs from character to character while a mesh is drawn, as vertex attributes that advance once for
/// each.
class Instances {
public:
    /// Of the context that is current.
    Instances() : m_buffers(&gl::Buffer::create) {}

    /// For the characters of the frame; at most `atOnce` to a run, 0 for any number.
    void upload(const Frame& frame, int atOnce);

    /// What is painted, without ghosts and what is out of sight.
    std::span<const InstanceRun> solids() const { return m_solids; }
    /// What throws shadows.
    std::span<const InstanceRun> casters() const { return m_casters; }
    /// One character of the frame by one of its meshes.
    static InstanceRun only(const Frame& frame, const DrawnCharacter& character, const GpuMesh& mesh);

    void draw(const InstanceRun& run) const;
    void drawPoints(const InstanceRun& run) const;
    /// Before parts of it.
    void attach(const InstanceRun& run) const;
    static void drawPart(const InstanceRun& run, const MeshPart& part);

private:
    struct Data {
        std::int32_t firstTexel = 0; ///< in both buffers of Palettes
        std::int32_t selected = 0;   ///< a bit for each segment
        std::int32_t solved = 0;
        std::int32_t assumed = 0;
        glm::vec3 colour{0.0F};
        float dim = 0.0F;
        float opacity = 1.0F;
        float hatched = 0.0F;
    };

    static Data dataOf(const DrawnCharacter& character);
    /// Of m_ordered, which it sorts. `paints`: those with marks are drawn otherwise.
    void addRuns(const GpuMesh* DrawnCharacter::*mesh, bool paints, int atOnce,
                 std::vector<InstanceRun>& runs);

    gl::Ring<gl::Buffer, kMostViews> m_buffers;
    std::vector<Data> m_data; ///< first of all characters in their order, then by runs
    std::vector<const DrawnCharacter*> m_ordered;
    std::vector<InstanceRun> m_solids;
    std::vector<InstanceRun> m_casters;
};

} // namespace posewire::render
