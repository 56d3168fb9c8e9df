// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/body_meshes.h"
#include "core/log/time.h"
#include "core/model/body/character_pose.h"
#include "core/model/keys.h"
#include "core/model/session/session_view.h"
#include "render/renderer.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace posewire::gui {

/// One character in a picture.
struct Figure {
    model::CharacterKey key;
    std::shared_ptr<const FigureMesh> mesh;
    std::array<render::DualQuaternion, render::kJointCount> palette{};
    render::CharacterLook look;
    glm::vec3 labelPosition{0.0F}; ///< above the head
    render::Bounds bounds;         ///< of the segment origins
};

/// Everything that one picture shows, by value: it may be drawn on another thread while the session moves on.
struct SceneFrame {
    render::Camera camera;
    render::SceneColours colours;
    std::vector<Figure> figures;
    std::vector<Figure> ghosts; ///< not to be picked, without labels
    std::vector<render::AxesInstance> axes;
    std::vector<render::LineInstance> lines;
    int width = 1; ///< device pixels
    int height = 1;
    float pixelRatio = 1.0F;
    log::Stamp built{}; ///< the session's time
};

/// Turns frames into scenes for one renderer: uploads meshes when they are first seen, releases those no
/// longer shown. Belongs to the renderer's thread.
class SceneUpload {
public:
    /// The spans of the result last until the next call, and no longer than `frame`.
    [[nodiscard]] render::Scene prepare(const SceneFrame& frame, render::Renderer& renderer);

private:
    void add(const Figure& figure, render::Renderer& renderer);
    void releaseUnused(const SceneFrame& frame, render::Renderer& renderer);

    std::map<std::shared_ptr<const FigureMesh>, render::MeshId> m_meshes;
    std::vector<render::SkinnedInstance> m_instances;
};

enum class AxesMode : std::uint8_t { All, Selected, None };

/// How far a figure has faded: 0 for live data, a step at kSilentAge, rising to its greatest value at
/// kStaleAge.
[[nodiscard]] float dimFor(double ageSeconds);

/// Session to picture: the newest pose of each character at the cursor.
class SceneBuilder {
public:
    SceneBuilder(model::SessionView& session, render::Detail detail) : m_session(session), m_meshes(detail) {}

    /// Fills figures, axes, lines and colours; camera and size are the caller's. Hidden characters
    /// are left out.
    void build(AxesMode axes, SceneFrame& frame);
    /// Of the bodies in the scenes.
    [[nodiscard]] const BodyMeshes& meshes() const { return m_meshes; }

private:
    [[nodiscard]] std::shared_ptr<const FigureMesh> meshOf(const model::CharacterKey& key);
    void addFigure(const model::Character& character, const model::CharacterPose& pose, SceneFrame& frame);
    /// On the floor under the live pelvis, turned as it is; nothing where no null pose was sent.
    void addGhost(const Figure& figure, const model::CharacterPose& pose, SceneFrame& frame) const;
    /// `strength` below 1 for data that have faded.
    void addAxes(const model::CharacterPose& pose, int selectedSegment, float strength,
                 SceneFrame& frame) const;
    void addFingers(const model::CharacterPose& pose, const glm::vec3& colour, SceneFrame& frame) const;

    model::SessionView& m_session;
    BodyMeshes m_meshes;
};

} // namespace posewire::gui
