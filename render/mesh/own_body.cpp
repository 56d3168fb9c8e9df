// SPDX-License-Identifier: MIT
#include "render/mesh/own_body.h"

#include "render/bounds.h"
#include "render/mesh/finite.h"
#include "render/mesh/rest_pose.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace posewire::render {
namespace {

/// Of the floor's height and above it, metres: what a foot stands on.
constexpr float kSoleHeight = 0.025F;

/// The joint of the mannequin that turns a bone beside a limb's: without the limb's twist, unless the bone is
/// named as one of the mannequin's own.
int turnerBeside(std::string_view bone, int limb) {
    const auto helpers = std::span(kJointNames).subspan(kSegmentCount, kTwistJointCount + kHalfJointCount);
    const auto named = std::ranges::find(helpers, bone);
    if (named != helpers.end()) {
        return static_cast<int>(kSegmentCount) + static_cast<int>(named - helpers.begin());
    }
    const auto* twist = std::ranges::find(kTwistJoints, static_cast<Segment>(limb), &TwistJoint::segment);
    return twist == kTwistJoints.end() ? limb
                                       : static_cast<int>(kSegmentCount + (twist - kTwistJoints.begin()));
}

/// Which joints of the mannequin turn each bone: mapped ones as their segment, those of the trunk and the
/// neck between two mapped ones part of the way, those beside a limb with it, others as their parent.
std::vector<OwnJoint> jointsOf(std::span<const ImportedBone> bones, const BoneMapping& mapping,
                               std::span<const glm::vec3> origins) {
    std::vector<OwnJoint> joints(bones.size());
    std::vector<int> mapped(bones.size(), -1);
    for (std::size_t i = 0; i < kMappableCount; ++i) {
        if (mapping.bones[i] >= 0) {
            mapped[static_cast<std::size_t>(mapping.bones[i])] = static_cast<int>(mappableJoint(i));
        }
    }
    for (std::size_t i = 0; i < bones.size(); ++i) {
        joints[i].parent = bones[i].parent;
        joints[i].from = mapped[i];
    }
    const std::vector<int> limbs = limbsBeside(bones, mapping, origins);
    for (std::size_t i = 0; i < bones.size(); ++i) {
        joints[i].from = limbs[i] < 0 ? joints[i].from : turnerBeside(bones[i].name, limbs[i]);
    }
    constexpr std::array kTrunk{L5, L3, T12, T8, Neck, Head};
    for (const Segment segment : kTrunk) {
        std::vector<int> between;
        int bone = mapping.bones[segment];
        bone = bone < 0 ? -1 : bones[static_cast<std::size_t>(bone)].parent;
        while (bone >= 0 && mapped[static_cast<std::size_t>(bone)] < 0) {
            between.push_back(bone);
            bone = bones[static_cast<std::size_t>(bone)].parent;
        }
        for (std::size_t i = 0; bone >= 0 && i < between.size(); ++i) {
            OwnJoint& joint = joints[static_cast<std::size_t>(between[i])];
            joint.from = mapped[static_cast<std::size_t>(bone)];
            joint.to = segment;
            joint.share = 1.0F - static_cast<float>(i + 1) / static_cast<float>(between.size() + 1);
        }
    }
    for (int bone = mapping.bones[Pelvis]; bone >= 0; bone = bones[static_cast<std::size_t>(bone)].parent) {
        joints[static_cast<std::size_t>(bone)].isRoot = true;
        joints[static_cast<std::size_t>(bone)].from = Pelvis;
    }
    for (OwnJoint& joint : joints) {
        joint.isRoot = joint.isRoot || (joint.parent < 0 && joint.from < 0);
    }
    return joints;
}

std::vector<Segment> segmentsOf(std::span<const OwnJoint> joints) {
    std::vector<Segment> segments(joints.size(), Pelvis);
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const OwnJoint& joint = joints[i];
        const int turns = joint.to >= 0 && joint.share > 0.5F ? joint.to : joint.from;
        if (turns >= 0) {
            segments[i] = jointSegment(static_cast<std::size_t>(turns));
        } else if (joint.parent >= 0) {
            segments[i] = segments[static_cast<std::size_t>(joint.parent)];
        }
    }
    return segments;
}

/// Turns the mesh into the T-pose, and the joints with it.
void straighten(std::span<const glm::quat> turns, OwnBody& body) {
    std::vector<DualQuaternion> palette(body.joints.size());
    std::vector<glm::vec3> places(body.joints.size());
    for (std::size_t i = 0; i < body.joints.size(); ++i) {
        const OwnJoint& joint = body.joints[i];
        places[i] = joint.origin;
        if (joint.parent >= 0) {
            const auto parent = static_cast<std::size_t>(joint.parent);
            places[i] = places[parent] + turns[parent] * (joint.origin - body.joints[parent].origin);
        }
        palette[i] = rigidMotion(turns[i], joint.origin, places[i]);
    }
    const SkinnedMesh rest = body.mesh;
    const SkinJob job{&rest, palette, body.mesh.positions, body.mesh.normals};
    job.run();
    for (std::size_t i = 0; i < places.size(); ++i) {
        body.joints[i].origin = places[i];
    }
}

/// Puts the lowest vertex on the floor, and the hips above the origin.
void putOnFloor(const BoneMapping& mapping, OwnBody& body) {
    Bounds bounds;
    for (const glm::vec3& position : body.mesh.positions) {
        bounds.add(position);
    }
    const auto origin = [&](Segment segment) -> const glm::vec3& {
        return body.joints[static_cast<std::size_t>(mapping.bones[segment])].origin;
    };
    const glm::vec3 hips = 0.5F * (origin(LeftUpperLeg) + origin(RightUpperLeg));
    const glm::vec3 shift(-hips.x, -hips.y, -bounds.min.z);
    for (glm::vec3& position : body.mesh.positions) {
        position += shift;
    }
    for (OwnJoint& joint : body.joints) {
        joint.origin += shift;
    }
    body.hips = hips + shift;
    body.head = origin(Head);
    body.reading.height = bounds.max.z - bounds.min.z;
}

/// The hindmost and the foremost low place of each part of a foot, in the middle of its width: an edge would
/// be far below where legs are spread.
void findSoles(OwnBody& body) {
    const float low = kSoleHeight * std::max(body.reading.height / kReferenceStature, 0.1F);
    for (const Segment segment : {RightFoot, RightToe, LeftFoot, LeftToe}) {
        std::optional<std::size_t> back;
        std::optional<std::size_t> front;
        float right = std::numeric_limits<float>::max();
        float left = std::numeric_limits<float>::lowest();
        for (std::size_t i = 0; i < body.mesh.vertexCount(); ++i) {
            const glm::vec3& at = body.mesh.positions[i];
            if (at.z > low || body.jointSegments[body.mesh.joints[i][0]] != segment) {
                continue;
            }
            right = std::min(right, at.y);
            left = std::max(left, at.y);
            back = !back || at.x < body.mesh.positions[*back].x ? i : *back;
            front = !front || at.x > body.mesh.positions[*front].x ? i : *front;
        }
        for (const std::optional<std::size_t>& vertex : {back, front}) {
            if (vertex) {
                const glm::vec3& at = body.mesh.positions[*vertex];
                body.soles.push_back({body.mesh.joints[*vertex][0], {at.x, 0.5F * (right + left), at.z}});
            }
        }
    }
}

/// Points under a performer's heel, ball and toes in the null pose, by the mannequin's own foot.
struct PerformerSoles {
    std::array<glm::vec3, 2> foot;
    std::array<glm::vec3, 2> toe;
};

PerformerSoles solesOf(std::span<const glm::vec3> origins, Segment foot, Segment toe) {
    const float size = glm::distance(origins[foot], origins[foot - 1]) /
                       glm::distance(kReferenceNullPose[foot], kReferenceNullPose[foot - 1]);
    const float floor = origins[toe].z - size * kReferenceNullPose[toe].z;
    const auto under = [&](Segment segment, float ahead) {
        return glm::vec3(origins[segment].x + size * ahead, origins[segment].y, floor);
    };
    return {{under(foot, -0.055F), under(foot, 0.03F)}, {under(toe, 0.0F), under(toe, 0.065F)}};
}

/// Zero turned into what is near it: signs of a palette follow the hierarchy.
glm::quat rotationOf(const DualQuaternion& motion) {
    return {motion.real.w, motion.real.x, motion.real.y, motion.real.z};
}

glm::quat between(const glm::quat& from, const glm::quat& to, float share) {
    const glm::quat near = glm::dot(from, to) < 0.0F ? -to : to;
    const glm::quat mixed = from * (1.0F - share) + near * share;
    const float length = glm::length(mixed);
    return length > 1e-6F ? mixed / length : from;
}

} // namespace

tl::expected<OwnBody, std::string> makeOwnBody(const ImportedCharacter& character, const BoneMapping& mapping,
                                               const RestChoice& choice) {
    if (const auto fit = checkMapping(mapping, character.bones); !fit) {
        return tl::make_unexpected(fit.error());
    }
    auto rest = readRestPose(character, mapping, choice);
    if (!rest) {
        return tl::make_unexpected(rest.error());
    }
    OwnBody body;
    body.mesh = character.mesh;
    body.texturePlaces = character.texturePlaces;
    body.parts = character.parts;
    body.reading = rest->reading;
    body.joints = jointsOf(character.bones, mapping, rest->origins);
    body.jointSegments = segmentsOf(body.joints);
    for (glm::vec3& position : body.mesh.positions) {
        position = rest->reading.unit * (rest->turn * position);
    }
    for (glm::vec3& normal : body.mesh.normals) {
        normal = rest->turn * normal;
    }
    for (std::size_t i = 0; i < body.joints.size(); ++i) {
        body.joints[i].origin = rest->origins[i];
    }
    body.segmentJoints.fill(-1);
    std::copy_n(mapping.bones.begin(), kSegmentCount, body.segmentJoints.begin());
    straighten(straightTurns(character.bones, mapping, rest->origins, choice.isStraightened), body);
    putOnFloor(mapping, body);
    findSoles(body);
    if (const auto sound = body.mesh.validate(body.joints.size()); !sound) {
        return tl::make_unexpected(sound.error());
    }
    return body;
}

float scaleFor(const OwnBody& body, std::span<const glm::vec3> origins) {
    const float floor = std::min(origins[LeftToe].z, origins[RightToe].z) - kReferenceNullPose[LeftToe].z;
    const float scale = (origins[Head].z - floor) / body.head.z;
    constexpr float kMost = 100.0F;
    return std::isfinite(scale) && scale > 1.0F / kMost && scale < kMost ? scale : 1.0F;
}

tl::expected<void, std::string> OwnPaletteJob::validate() const {
    if (body == nullptr || palette.size() != body->joints.size()) {
        return tl::make_unexpected("the palette differs in size from the body");
    }
    if (pose.size() != kJointCount || origins.size() != kSegmentCount || !(scale > 0.0F)) {
        return tl::make_unexpected("a pose has the mannequin's joints and the origins of 23 segments");
    }
    return {};
}

void OwnPaletteJob::run() const {
    const std::vector<OwnJoint>& joints = body->joints;
    std::vector<glm::quat> turns(joints.size());
    std::vector<glm::vec3> places(joints.size());
    const glm::quat pelvis = rotationOf(pose[Pelvis]);
    const glm::vec3 hips =
        transformPoint(pose[Pelvis], 0.5F * (origins[LeftUpperLeg] + origins[RightUpperLeg]));
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const OwnJoint& joint = joints[i];
        const auto parent = static_cast<std::size_t>(std::max(joint.parent, 0));
        const glm::quat inherited = joint.isRoot ? pelvis : turns[parent];
        turns[i] = joint.from < 0 ? inherited : rotationOf(pose[static_cast<std::size_t>(joint.from)]);
        if (joint.to >= 0) {
            turns[i] = between(turns[i], rotationOf(pose[static_cast<std::size_t>(joint.to)]), joint.share);
        }
        turns[i] = glm::dot(turns[i], inherited) < 0.0F ? -turns[i] : turns[i];
        places[i] = joint.isRoot
                        ? hips + pelvis * (scale * (joint.origin - body->hips))
                        : places[parent] + turns[parent] * (scale * (joint.origin - joints[parent].origin));
    }
    float lowest = std::numeric_limits<float>::max();
    for (const SolePoint& sole : body->soles) {
        const glm::vec3 offset = scale * (sole.position - joints[sole.joint].origin);
        lowest = std::min(lowest, (places[sole.joint] + turns[sole.joint] * offset).z);
    }
    float wanted = std::numeric_limits<float>::max();
    for (const auto& [foot, toe] : {std::pair{RightFoot, RightToe}, std::pair{LeftFoot, LeftToe}}) {
        const PerformerSoles soles = solesOf(origins, foot, toe);
        for (std::size_t i = 0; i < 2; ++i) {
            wanted = std::min({wanted, transformPoint(pose[foot], soles.foot[i]).z,
                               transformPoint(pose[toe], soles.toe[i]).z});
        }
    }
    const float lift = body->soles.empty() || !std::isfinite(wanted - lowest) ? 0.0F : wanted - lowest;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        palette[i] = rigidMotion(turns[i], scale * joints[i].origin, places[i] + glm::vec3(0.0F, 0.0F, lift));
    }
}

} // namespace posewire::render
