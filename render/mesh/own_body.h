// SPDX-License-Identifier: MIT
#pragma once

#include "render/mesh/bone_mapping.h"
#include "render/skinning.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace posewire::render {

/// What the operator says about the rest pose of a file, where it is not to be found out.
struct RestChoice {
    /// Metres of a unit of the file; 0 finds it by the height.
    float unit = 0.0F;
    /// Quarter turns to the left, seen from above, after the heading that is found.
    int quarterTurns = 0;
    /// Arms, legs, hands and feet are turned into MVN's T-pose; else the rest pose is taken for it.
    bool isStraightened = true;

    bool operator==(const RestChoice&) const = default;
};

/// What was found about it.
struct RestReading {
    /// Metres of a unit of the file, as used.
    float unit = 1.0F;
    /// From the lowest to the highest vertex.
    float height = 0.0F;
    /// How far the upper arms hang below level, degrees: 0 in a T-pose, about 45 in an A-pose.
    float armsBelowLevel = 0.0F;
    /// How far the file was turned for Z up and X ahead, degrees.
    float turned = 0.0F;
    /// In metres the body would have no person's height.
    bool isInOtherUnit = false;
    /// Left and right may be swapped.
    bool pointsBackwards = false;
};

/// A joint of a body that moves as one or between two of the mannequin's.
struct OwnJoint {
    /// Comes before it; -1 for none.
    int parent = -1;
    glm::vec3 origin{0.0F};
    /// The joint of the mannequin that turns it, or -1: then it is fixed to its parent.
    int from = -1;
    /// Another one, `share` of the way to which it turns.
    int to = -1;
    float share = 0.0F;
    /// Moves with the pelvis, whatever its parent: the pelvis itself, and what is above it.
    bool isRoot = false;
};

/// A place at the bottom of a foot.
struct SolePoint {
    std::size_t joint = 0;
    glm::vec3 position{0.0F};
};

/// A user's own character ready to be posed: in MVN's T-pose, where all orientations are identity; metres,
/// Z-up, X ahead, standing on z = 0 with the middle between the hips above the origin.
struct OwnBody {
    SkinnedMesh mesh;
    std::vector<glm::vec2> texturePlaces;
    std::vector<MeshPart> parts;
    std::vector<OwnJoint> joints;
    /// By joint: what it is picked and marked as.
    std::vector<Segment> jointSegments;
    /// By segment: the joint that its capsule moves with, or -1.
    std::array<int, kSegmentCount> segmentJoints{};
    std::vector<SolePoint> soles;
    /// The middle between the upper legs' origins.
    glm::vec3 hips{0.0F};
    glm::vec3 head{0.0F};
    RestReading reading;
};

/// The mapping must pass checkMapping(). Fails with what is wrong.
tl::expected<OwnBody, std::string> makeOwnBody(const ImportedCharacter& character, const BoneMapping& mapping,
                                               const RestChoice& choice);

/// How much larger than the body a performer of these null-pose origins is.
float scaleFor(const OwnBody& body, std::span<const glm::vec3> origins);

/// The palette of a user's own character for a pose of the mannequin: joint i maps v to R (v − scale oᵢ) +
/// pᵢ. Every bone keeps the file's length, larger by `scale`; the hips are where the performer's are, and
/// moved up or down so that the lower foot is as high as the performer's.
struct OwnPaletteJob {
    const OwnBody* body = nullptr;
    float scale = 1.0F;
    /// kJointCount, of PaletteJob.
    std::span<const DualQuaternion> pose;
    /// The null-pose origins that it was made with, kSegmentCount.
    std::span<const glm::vec3> origins;
    /// One for each joint of the body.
    std::span<DualQuaternion> palette;

    tl::expected<void, std::string> validate() const;
    void run() const;
};

} // namespace posewire::render
