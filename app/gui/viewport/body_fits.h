// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "render/mesh/mannequin.h"
#include "render/mesh/null_pose_fit.h"
#include "render/picking.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>

namespace posewire::gui {

/// The mannequin as it was modelled, in the levels that are drawn; all characters share it.
struct MannequinMeshes {
    render::SkinnedMesh mesh;
    render::SkinnedMesh lowMesh; ///< in fewer triangles
    render::SegmentCapsules capsules{};
};

/// The mannequin fitted to one performer; never changed once made, so that threads may share it.
struct FigureBody {
    std::shared_ptr<const MannequinMeshes> mannequin;
    render::BodyFit fit;
    render::SegmentCapsules capsules{};
};

/// The mannequin as it fits each body, worked out once for all who have the same. At most kMost are kept,
/// those that were shown last.
class BodyFits {
public:
    static constexpr std::size_t kMost = 64;

    explicit BodyFits(render::Detail detail) : m_detail(detail) {}

    /// By the segment origins of a null pose, metres; they may be of any value. Fingers that are not numbers
    /// fit the hands.
    [[nodiscard]] std::shared_ptr<const FigureBody>
    of(const render::NullPose& performer, const render::FingerOrigins& fingers = render::unknownFingers());

    /// What is kept here, and the mannequin once more on the graphics side.
    [[nodiscard]] std::size_t memoryBytes() const;
    /// What that can become; 0 before anything was asked for.
    [[nodiscard]] std::size_t mostBytes() const;

private:
    /// As they came, so that what is not a number equals itself.
    using Body = std::array<std::uint32_t, 3 * (render::kSegmentCount + render::kFingerJointCount)>;
    struct Entry {
        std::shared_ptr<const FigureBody> body;
        std::uint64_t asked = 0; ///< when last
    };
    [[nodiscard]] std::size_t mannequinBytes() const;

    const render::Detail m_detail;
    std::shared_ptr<const MannequinMeshes> m_mannequin;
    std::map<Body, Entry> m_entries;
    std::uint64_t m_asked = 0;
};

} // namespace posewire::gui
