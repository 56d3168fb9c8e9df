// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/figure_meshes.h"
#include "app/gui/viewport/scene_frame.h"
#include "core/model/body/character_pose.h"
#include "core/model/session/session_view.h"

#include <cstdint>

namespace posewire::gui {

enum class AxesMode : std::uint8_t { All, Selected, None };

/// How far a figure has faded: 0 for live data, a step at kSilentAge, rising to its greatest value at
/// kStaleAge.
[[nodiscard]] float dimFor(double ageSeconds);

/// Session to picture: the newest pose of each character at the cursor.
class SceneBuilder {
public:
    SceneBuilder(model::SessionView& session, render::Detail detail) : m_session(session), m_meshes(detail) {}

    /// Fills figures, axes, lines, points and colours; camera and size are the caller's. Hidden characters
    /// are left out.
    void build(AxesMode axes, SceneFrame& frame);

private:
    void addFigure(const model::Character& character, const model::CharacterPose& pose, SceneFrame& frame);
    /// On the floor under the live pelvis, turned as it is; nothing where no null pose was sent.
    void addGhost(const Figure& figure, const model::CharacterPose& pose, SceneFrame& frame) const;
    /// `strength` below 1 for data that have faded.
    void addAxes(const model::CharacterPose& pose, int selectedSegment, float strength,
                 SceneFrame& frame) const;
    void addFingers(const model::CharacterPose& pose, const glm::vec3& colour, SceneFrame& frame) const;

    model::SessionView& m_session;
    FigureMeshes m_meshes;
};

/// The theme's colours as the renderer wants them.
[[nodiscard]] render::SceneColours themedSceneColours();

} // namespace posewire::gui
