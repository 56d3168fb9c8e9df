// SPDX-License-Identifier: MIT
#pragma once

#include "render/camera.h"
#include "render/mesh/character_file.h"
#include "render/mesh/null_pose_fit.h"
#include "render/skinning.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

/// What one picture shows: plain data and spans, read during Renderer::draw only. World frame Z-up, metres.
/// Colours are display values (sRGB, 0 … 1).
namespace posewire::render {

/// A mesh that a renderer holds.
enum class MeshId : std::uint32_t { None = 0 };

/// A picture on a mesh: red, green, blue and alpha of each texel as display values, the top row first.
struct TextureImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> texels;
};

/// What a mesh has of its own where it is no mannequin.
struct MeshDress {
    /// By joint.
    std::span<const Segment> jointSegments;
    /// By segment: the joint that it is picked by, or -1.
    std::span<const int> segmentJoints;
    /// Of each vertex; may be empty.
    std::span<const glm::vec2> texturePlaces;
    std::span<const MeshPart> parts;
    /// Those that could not be had are empty.
    std::span<const TextureImage> textures;
};

/// The colours of everything that has none of its own; they come from the program's theme.
struct SceneColours {
    glm::vec3 backgroundTop{0.0F};
    glm::vec3 backgroundBottom{0.0F};
    glm::vec3 floor{0.0F};
    /// Lines each metre, and the finer ones each quarter of a metre.
    glm::vec3 gridMajor{0.0F};
    glm::vec3 gridMinor{0.0F};
    /// The floor in full shadow.
    glm::vec3 shadow{0.0F};
    /// The triangle at the origin that points along x.
    glm::vec3 origin{0.0F};
    glm::vec3 selection{0.0F};
    glm::vec3 axisX{0.0F};
    glm::vec3 axisY{0.0F};
    glm::vec3 axisZ{0.0F};
    /// The thin seam around axes, lines and points that keeps them apart from what is behind; alpha is its
    /// strength.
    glm::vec4 outline{0.0F};

    bool operator==(const SceneColours&) const = default;
};

SceneColours darkSceneColours();
SceneColours lightSceneColours();

struct Light {
    /// From the scene towards the key light; any length.
    glm::vec3 towards{1.2F, 1.1F, 1.9F};
};

/// The key light over the viewer's right shoulder, as in a photographer's studio: shadows fall to the back
/// left from wherever one looks.
Light keyLight(const Camera& camera);

/// Where the pose of a segment comes from, as far as it can be seen.
enum class Provenance : std::uint8_t {
    Sent,   ///< as the sender gave it: in the suit
    Solved, ///< worked out from other data: the suit's pattern fades to plain cloth
    Assumed ///< nothing tells where it is: hatched, in the colour of the surroundings
};

/// How a character is painted.
struct CharacterLook {
    glm::vec3 colour{0.20F, 0.45F, 0.75F};
    /// 0 is live, 1 has faded into the background.
    float dim = 0.0F;
    /// Below 1 it is a ghost: seen through, without a shadow.
    float opacity = 1.0F;
    /// Striped, for a character whose data have stopped.
    bool isHatched = false;
    /// Outlined as a whole.
    bool isSelected = false;
    /// Index of the segment to mark (MVN's ID − 1), or −1.
    int selectedSegment = -1;
    /// By segment (MVN's ID − 1); fingers count for their hand.
    std::array<Provenance, kSegmentCount> provenance{};

    bool operator==(const CharacterLook&) const = default;
};

/// One character.
struct SkinnedInstance {
    MeshId mesh = MeshId::None;
    /// The same body in fewer triangles, for its shadow and for where it is small in the picture; None where
    /// there is only one.
    MeshId lowMesh = MeshId::None;
    /// Rigid motions from the mesh's null pose to the world, one for each of its joints: kJointCount, as
    /// PaletteJob makes them, or those of OwnPaletteJob.
    std::span<const DualQuaternion> palette;
    CharacterLook look;
    /// What makes the mesh this body, by joint; none for the mesh as it is.
    std::span<const Stretch> fit{};
};

/// The local axes of one segment, tracker or prop, drawn over the body. Axes without length draw nothing.
struct AxesInstance {
    glm::vec3 position{0.0F};
    /// worldFromSegment.
    glm::quat orientation{1.0F, 0.0F, 0.0F, 0.0F};
    float length = 0.1F;
    float alpha = 1.0F;

    bool operator==(const AxesInstance&) const = default;
};

/// A straight line of constant width on the screen.
struct LineInstance {
    glm::vec3 from{0.0F};
    glm::vec3 to{0.0F};
    glm::vec4 colour{1.0F};
    /// Logical pixels.
    float width = 1.5F;
    /// Share of the alpha that remains behind other things: 0 hides, 1 shows through.
    float behind = 0.35F;

    bool operator==(const LineInstance&) const = default;
};

/// A round point of constant size on the screen.
struct PointInstance {
    glm::vec3 position{0.0F};
    glm::vec4 colour{1.0F};
    /// Logical pixels.
    float diameter = 7.0F;
    float behind = 0.35F;

    bool operator==(const PointInstance&) const = default;
};

struct Scene {
    Camera camera;
    Light light;
    SceneColours colours;
    std::span<const SkinnedInstance> characters;
    std::span<const AxesInstance> axes;
    std::span<const LineInstance> lines;
    std::span<const PointInstance> points;
    /// Logical pixels.
    float axesWidth = 1.7F;
    bool showFloor = true;
    bool showOrigin = true;
};

} // namespace posewire::render
