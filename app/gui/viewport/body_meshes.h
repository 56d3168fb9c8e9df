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
#include <vector>

namespace posewire::gui {

/// The mannequin fitted to one performer; never changed once made, so that threads may share it.
struct FigureMesh {
    render::SkinnedMesh mesh;
    std::vector<glm::vec3> templatePositions; ///< of each vertex on the mannequin before the fit
    render::SkinnedMesh lowMesh;              ///< in fewer triangles
    std::vector<glm::vec3> lowTemplatePositions;
    render::NullPose origins{};            ///< what palettes of this mesh are made with
    render::FingerOrigins fingerOrigins{}; ///< likewise
    render::SegmentCapsules capsules{};
};

/// The mannequin as it fits each body, made once for all who have the same. At most kMost are kept, those
/// that were shown last; at most kFitsAtOnce are made for a picture, since each takes time. The mannequin as
/// it is stands in for what is not made yet, and where there are more bodies at once.
class BodyMeshes {
public:
    static constexpr std::size_t kMost = 32;
    static constexpr int kFitsAtOnce = 2;

    explicit BodyMeshes(render::Detail detail) : m_detail(detail) {}

    /// What of() is asked for from here on is for one picture.
    void beginPicture();
    /// By the segment origins of a null pose, metres; they may be of any value. Fingers that are not numbers
    /// fit the hands.
    [[nodiscard]] std::shared_ptr<const FigureMesh>
    of(const render::NullPose& performer, const render::FingerOrigins& fingers = unknownFingers());
    [[nodiscard]] static const render::FingerOrigins& unknownFingers();
    /// Whether something stands in that could be made for the next picture.
    [[nodiscard]] bool isBehind() const { return m_isBehind; }

    /// What is kept here, and as much again on the graphics side.
    [[nodiscard]] std::size_t memoryBytes() const;
    /// What that can become; 0 before anything was asked for.
    [[nodiscard]] std::size_t mostBytes() const;

private:
    /// As they came, so that what is not a number equals itself.
    using Body = std::array<std::uint32_t, 3 * (render::kSegmentCount + render::kFingerJointCount)>;
    struct Entry {
        std::shared_ptr<const FigureMesh> mesh;
        std::uint64_t picture = 0; ///< the newest with it
    };
    [[nodiscard]] std::shared_ptr<const FigureMesh> fitted(const render::NullPose& performer,
                                                           const render::FingerOrigins& fingers);
    [[nodiscard]] bool makeRoom();
    [[nodiscard]] std::size_t bytesOfOne() const;

    render::Detail m_detail;
    std::unique_ptr<const render::SkinnedMesh> m_mannequin; ///< loaded for the first figure
    std::unique_ptr<const render::SkinnedMesh> m_lowMannequin;
    std::shared_ptr<const FigureMesh> m_standIn;
    std::map<Body, Entry> m_entries;
    std::uint64_t m_picture = 0;
    int m_fits = 0; ///< for this picture
    bool m_isBehind = false;
};

} // namespace posewire::gui
