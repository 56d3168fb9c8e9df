// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/bodies.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/pose_interpolation.h"
#include "core/model/session/roster.h"
#include "core/model/session/session_view.h"
#include "render/mesh/prop_shapes.h"
#include "render/renderer.h"

#include <QColor>
#include <QString>

#include <array>
#include <bitset>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace posewire::gui {

enum class Overlay : std::uint8_t {
    SegmentNames,
    JointAngles,
    Markers,
    Trackers,
    CentreOfMass,
    Contacts,
    Velocity,
    Acceleration,
    Trails,
};
inline constexpr std::size_t kOverlayCount = 9;

class Overlays {
public:
    [[nodiscard]] bool has(Overlay overlay) const { return m_on[static_cast<std::size_t>(overlay)]; }
    void toggle(Overlay overlay) { m_on.flip(static_cast<std::size_t>(overlay)); }
    [[nodiscard]] bool isAny() const { return m_on.any(); }
    friend bool operator==(const Overlays&, const Overlays&) = default;

private:
    std::bitset<kOverlayCount> m_on;
};

struct ComparisonState;

/// A prop of a character in a picture, in the shape that its name asks for.
struct FigureProp {
    render::PropShape shape = render::PropShape::Generic;
    std::array<render::DualQuaternion, 1> motion{};

    bool operator==(const FigureProp&) const = default;
};

struct FreeSegment {
    int segment = -1;
    glm::vec3 origin{0.0F};

    bool operator==(const FreeSegment&) const = default;
};

struct Figure {
    model::CharacterKey key;
    std::shared_ptr<const FigureBody> body;    ///< null for tracked objects: they have axes alone
    std::shared_ptr<const OwnFigure> own;      ///< drawn instead of the mannequin; null for none
    std::vector<render::DualQuaternion> bones; ///< of that
    std::array<render::DualQuaternion, render::kJointCount> palette{};
    std::vector<FigureProp> props;
    std::vector<FreeSegment> free; ///< picked by their origins
    render::CharacterLook look;
    glm::vec3 labelPosition{0.0F}; ///< above the head; above all of who is upside down
    render::Bounds bounds;         ///< of the segment origins

    bool operator==(const Figure&) const = default;

    /// What is drawn of it, the same for all that share it; null for nothing.
    [[nodiscard]] std::shared_ptr<const void> drawn() const {
        const auto mannequin = body != nullptr ? body->mannequin : nullptr;
        return own != nullptr ? std::shared_ptr<const void>(own) : std::shared_ptr<const void>(mannequin);
    }
    /// By joint of that; none if it is drawn as it is.
    [[nodiscard]] std::span<const render::Stretch> fit() const {
        return own != nullptr || body == nullptr ? std::span<const render::Stretch>() : body->fit.stretches;
    }
    [[nodiscard]] const render::SegmentCapsules& capsules() const {
        return own != nullptr ? own->capsules : body->capsules;
    }
    [[nodiscard]] std::span<const render::DualQuaternion> drawnPalette() const {
        return own != nullptr ? std::span(bones) : std::span<const render::DualQuaternion>(palette);
    }
};

struct SceneText {
    glm::vec3 position{0.0F};
    QString text;
    QColor colour;
    bool isScale = false;  ///< a number of the floor: it gives way to all others
    bool isOfBody = false; ///< names something on a body: fainter on its far side

    bool operator==(const SceneText&) const = default;
};

/// Everything that one picture shows, by value: it may be drawn on another thread while the session moves on.
/// Equal frames give the same picture.
struct SceneFrame {
    render::Camera camera;
    render::SceneColours colours;
    std::vector<Figure> figures;
    std::vector<Figure> ghosts;             ///< not to be picked, without labels
    std::vector<render::AxesInstance> axes; ///< lengths in logical pixels until sizeAxes()
    std::size_t selectedAxes = 0;           ///< the first of those of the selected character
    std::size_t selectedAxesCount = 0;
    std::vector<render::LineInstance> lines;
    std::vector<render::PointInstance> points;
    std::vector<SceneText> texts;
    bool hasNamesLeftOut = false; ///< of several figures with none selected: too many for words
    int x = 0;                    ///< of a pane in the picture, device pixels
    int y = 0;
    int width = 1; ///< device pixels
    int height = 1;
    float pixelRatio = 1.0F;
    std::vector<SceneFrame> panes; ///< the views of a split picture, drawn instead of this one; else empty
    bool isBest = false;           ///< to be drawn as well as it can be, however long that takes

    bool operator==(const SceneFrame&) const = default;

    [[nodiscard]] render::Pane place() const { return {x, y, width, height}; }
};

/// Turns frames into scenes for one renderer: uploads meshes when they are first seen, releases those no
/// longer shown. Belongs to the renderer's thread.
class SceneUpload {
public:
    /// The spans of the result last until the next call, and no longer than `frame`.
    [[nodiscard]] render::Scene prepare(const SceneFrame& frame, render::Renderer& renderer);

private:
    /// As the renderer knows them.
    struct Meshes {
        render::MeshId mesh = render::MeshId::None;
        render::MeshId low = render::MeshId::None;
    };
    void add(const Figure& figure, render::Renderer& renderer);
    void releaseUnused(const SceneFrame& frame, render::Renderer& renderer);

    std::map<std::shared_ptr<const void>, Meshes> m_meshes;        ///< by what is drawn
    std::array<render::MeshId, render::kPropShapeCount> m_props{}; ///< those that were drawn
    std::vector<render::SkinnedInstance> m_instances;
};

[[nodiscard]] render::SceneColours themedSceneColours();

/// Gives axes their length in space: the same on the screen wherever they are, but never smaller or larger
/// than makes sense on a body. For when camera and size of a frame are known.
void sizeAxes(SceneFrame& frame);

enum class AxesMode : std::uint8_t { All, Selected, None };

/// How far a figure has faded: 0 for live data, a step at kSilentAge, rising to its greatest value at
/// kStaleAge.
[[nodiscard]] float dimFor(double ageSeconds);

/// Session to picture: the newest pose of each character at the cursor.
class SceneBuilder {
public:
    SceneBuilder(model::SessionView& session, render::Detail detail) : m_session(session), m_bodies(detail) {}

    /// Fills figures, axes, lines, points, texts and colours; camera and size are the caller's. Hidden
    /// characters are left out. Overlays are drawn of the selected character, of all where none is selected.
    void build(AxesMode axes, const Overlays& overlays, SceneFrame& frame);
    void setWardrobe(const Wardrobe& wardrobe) { m_wardrobe = wardrobe; }
    /// Bodies glide from sample to sample while what is received is followed.
    void setInterpolating(bool isInterpolating) { m_isInterpolating = isInterpolating; }
    /// What is compared is drawn as well, through: it outlives this. Null for nothing.
    void setComparison(const ComparisonState* comparison) { m_comparison = comparison; }
    /// Whether the same poses would be shown elsewhere a little later.
    [[nodiscard]] bool isUnderWay() const;
    [[nodiscard]] const BodyFits& bodies() const { return m_bodies; }
    [[nodiscard]] const OwnFigures& ownFigures() const { return m_ownFigures; }

private:
    /// To what is known of the performer, times `scale`.
    [[nodiscard]] std::shared_ptr<const FigureBody> fitOf(const model::SessionView& session,
                                                          const model::CharacterKey& key, double scale);
    /// With body, palette and place, as yet without a look.
    [[nodiscard]] Figure bodyOf(const model::SessionView& session, const model::CharacterKey& key,
                                const model::CharacterPose& pose);
    [[nodiscard]] render::CharacterLook lookOf(const model::CharacterKey& key) const;
    void dress(Figure& figure);
    void addProps(const model::CharacterPose& pose, Figure& figure) const;
    void addFigure(const model::Character& character, const model::CharacterPose& pose, SceneFrame& frame);
    /// MotionGrid tags, older ones fainter and with their age; none of a character that is hidden.
    void addTags(const model::CharacterKey& key, const model::CharacterPose* pose, SceneFrame& frame) const;
    void addObjects(const model::Character& character, const model::CharacterPose& pose, SceneFrame& frame);
    /// On the floor under the live pelvis, turned as it is; nothing if no null pose was sent.
    void addGhost(const Figure& figure, const model::CharacterPose& pose, SceneFrame& frame);
    /// The bodies of the second recording, and how far the segments of the compared one are apart.
    void addCompared(SceneFrame& frame);
    void addDifferences(const model::CharacterPose& first, const model::CharacterPose& second,
                        SceneFrame& frame) const;
    /// `strength` below 1 for data that have faded.
    void addAxes(const model::CharacterPose& pose, int selectedSegment, float strength,
                 SceneFrame& frame) const;

    /// The pose at the cursor, or on the way to it.
    [[nodiscard]] const model::CharacterPose* poseOf(const model::CharacterKey& key);

    model::SessionView& m_session;
    BodyFits m_bodies;
    OwnFigures m_ownFigures;
    Wardrobe m_wardrobe;
    bool m_isInterpolating = false;
    const ComparisonState* m_comparison = nullptr;
    std::map<model::CharacterKey, model::PoseInterpolation> m_motions; ///< of characters in the last frame
};

} // namespace posewire::gui
