// SPDX-License-Identifier: MIT
#include "tests/render/poses.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace posewire::render::test {
namespace {

constexpr glm::vec3 kX{1.0F, 0.0F, 0.0F};
constexpr glm::vec3 kY{0.0F, 1.0F, 0.0F};
constexpr glm::vec3 kZ{0.0F, 0.0F, 1.0F};

glm::quat turned(const glm::vec3& axis, float degrees) {
    return glm::angleAxis(glm::radians(degrees), axis);
}

} // namespace

Pose poseFrom(const LocalRotations& rotations, const NullPose& nullPose) {
    Pose pose{nullPose, {}};
    pose.orientations.fill(glm::quat(1.0F, 0.0F, 0.0F, 0.0F));
    for (const auto& [segment, rotation] : rotations) {
        pose.orientations[segment] = rotation;
    }
    for (std::size_t segment = 1; segment < kSegmentCount; ++segment) {
        const auto parent = static_cast<std::size_t>(kSegmentParents[segment]);
        pose.orientations[segment] = pose.orientations[parent] * pose.orientations[segment];
        pose.positions[segment] =
            pose.positions[parent] + pose.orientations[parent] * (nullPose[segment] - nullPose[parent]);
    }
    return pose;
}

Pose tPose() {
    return poseFrom({});
}

Pose standingPose() {
    return poseFrom({{LeftShoulder, turned(kX, -6)},
                     {LeftUpperArm, turned(kX, -70)},
                     {LeftForeArm, turned(kZ, -18) * turned(kY, -25)},
                     {RightShoulder, turned(kX, 6)},
                     {RightUpperArm, turned(kX, 70)},
                     {RightForeArm, turned(kZ, 18) * turned(kY, -25)}});
}

Pose lungePose() {
    return poseFrom({{Pelvis, turned(kY, 5)},
                     {LeftUpperLeg, turned(kY, -80)},
                     {LeftLowerLeg, turned(kY, 85)},
                     {LeftFoot, turned(kY, -10)},
                     {RightUpperLeg, turned(kY, 20)},
                     {RightLowerLeg, turned(kY, 45)},
                     {RightFoot, turned(kY, 25)},
                     {RightToe, turned(kY, -40)},
                     {L5, turned(kZ, 9)},
                     {L3, turned(kZ, 9)},
                     {T12, turned(kZ, 9)},
                     {T8, turned(kZ, 9)},
                     {LeftUpperArm, turned(kZ, 25) * turned(kX, -60)},
                     {LeftForeArm, turned(kZ, -75) * turned(kY, -60)},
                     {RightUpperArm, turned(kZ, 60) * turned(kX, 15)},
                     {RightForeArm, turned(kZ, 90)},
                     {Head, turned(kZ, -25)}});
}

Pose squatPose() {
    return poseFrom({{Pelvis, turned(kY, 22)},
                     {L5, turned(kY, 12)},
                     {L3, turned(kY, 12)},
                     {T12, turned(kY, 10)},
                     {T8, turned(kY, 8)},
                     {Neck, turned(kY, -12)},
                     {Head, turned(kY, -22)},
                     {LeftUpperLeg, turned(kZ, 12) * turned(kY, -112)},
                     {LeftLowerLeg, turned(kY, 112)},
                     {LeftFoot, turned(kY, -22)},
                     {LeftUpperArm, turned(kZ, -75) * turned(kY, -10)},
                     {RightUpperLeg, turned(kZ, -12) * turned(kY, -112)},
                     {RightLowerLeg, turned(kY, 112)},
                     {RightFoot, turned(kY, -22)},
                     {RightUpperArm, turned(kZ, 75) * turned(kY, -10)}});
}

Pose elbowPose() {
    return poseFrom({{L5, turned(kZ, 5) * turned(kY, 10)},
                     {L3, turned(kZ, 5) * turned(kY, 9)},
                     {T12, turned(kZ, 5) * turned(kY, 9)},
                     {T8, turned(kZ, 5) * turned(kY, 7)},
                     {Neck, turned(kY, -8)},
                     {Head, turned(kZ, 15) * turned(kY, -10)},
                     {LeftUpperArm, turned(kX, -35)},
                     {LeftForeArm, turned(kZ, -90)},
                     {RightShoulder, turned(kX, -8)},
                     {RightUpperArm, turned(kX, -25)},
                     {RightForeArm, turned(kX, -90)},
                     {Pelvis, turned(kY, 15)},
                     {LeftUpperLeg, turned(kY, -110)},
                     {LeftLowerLeg, turned(kY, 90)},
                     {LeftFoot, turned(kY, 5)},
                     {RightUpperLeg, turned(kY, -90)},
                     {RightLowerLeg, turned(kY, 90)},
                     {RightFoot, turned(kY, -15)}});
}

Pose shrugPose() {
    return poseFrom({{LeftShoulder, turned(kX, 25)},
                     {LeftUpperArm, turned(kX, -95)},
                     {RightShoulder, turned(kX, -25)},
                     {RightUpperArm, turned(kX, 95)}});
}

Pose raisedArmsPose() {
    return poseFrom({{LeftShoulder, turned(kX, 20)},
                     {LeftUpperArm, turned(kX, 62)},
                     {RightShoulder, turned(kX, -20)},
                     {RightUpperArm, turned(kX, -62)}});
}

Pose sittingPose() {
    return poseFrom({{LeftUpperArm, turned(kX, -75)},
                     {RightUpperArm, turned(kX, 75)},
                     {LeftUpperLeg, turned(kZ, 4) * turned(kY, -90)},
                     {LeftLowerLeg, turned(kY, 90)},
                     {RightUpperLeg, turned(kZ, -4) * turned(kY, -90)},
                     {RightLowerLeg, turned(kY, 90)}});
}

Pose spreadLegsPose() {
    return poseFrom({{LeftUpperArm, turned(kX, -40)},
                     {RightUpperArm, turned(kX, 40)},
                     {LeftUpperLeg, turned(kX, 70)},
                     {RightUpperLeg, turned(kX, -70)}});
}

Pose nodPose() {
    return poseFrom({{LeftUpperArm, turned(kX, -70)},
                     {RightUpperArm, turned(kX, 70)},
                     {Neck, turned(kY, 20)},
                     {Head, turned(kY, 35)}});
}

Pose placed(const Pose& pose, const glm::vec3& offset, float turn) {
    const glm::quat rotation = glm::angleAxis(turn, kZ);
    Pose result;
    for (std::size_t segment = 0; segment < kSegmentCount; ++segment) {
        result.positions[segment] = rotation * pose.positions[segment] + offset;
        result.orientations[segment] = rotation * pose.orientations[segment];
    }
    return result;
}

std::vector<DualQuaternion> paletteOf(const Pose& pose, const NullPose& nullPose) {
    std::vector<DualQuaternion> palette(kJointCount);
    PaletteJob{pose.positions, pose.orientations, nullPose, palette}.run();
    return palette;
}

std::vector<DualQuaternion> fist(const Pose& pose) {
    std::array<glm::vec3, kFingerJointCount> positions;
    std::array<glm::quat, kFingerJointCount> orientations;
    for (std::size_t finger = 0; finger < kFingerJointCount; ++finger) {
        const std::size_t joint = kFirstFingerJoint + finger;
        const auto parent = static_cast<std::size_t>(jointParent(joint));
        const bool isOfBody = parent < kSegmentCount;
        const std::size_t index = finger % kHandSegmentCount;
        const float side = finger < kHandSegmentCount ? 1.0F : -1.0F;
        // Metacarpals stay, the thumb closes across the palm.
        const bool isMetacarpal = index == 0 || (index > 3 && index % 4 == 0);
        const glm::quat bend = index > 0 && index < 4
                                   ? turned(kY, 12) * turned(kZ, side * 22) * turned(kX, side * -12)
                                   : turned(kX, isMetacarpal ? 0.0F : side * -78);
        const glm::quat turn =
            isOfBody ? pose.orientations[parent] : orientations[parent - kFirstFingerJoint];
        const glm::vec3 place = isOfBody ? pose.positions[parent] : positions[parent - kFirstFingerJoint];
        positions[finger] = place + turn * (jointOrigin(joint) - jointOrigin(parent));
        orientations[finger] = turn * bend;
    }
    constexpr std::size_t kCount = kHandSegmentCount;
    std::vector<DualQuaternion> palette(kJointCount);
    PaletteJob job{pose.positions, pose.orientations, kReferenceNullPose, palette};
    job.leftHand = {std::span(positions).first(kCount), std::span(orientations).first(kCount)};
    job.rightHand = {std::span(positions).last(kCount), std::span(orientations).last(kCount)};
    job.run();
    return palette;
}

Pose grounded(const Pose& pose, const SkinnedMesh& mesh, const NullPose& nullPose) {
    const std::vector<DualQuaternion> palette = paletteOf(pose, nullPose);
    std::vector<glm::vec3> positions(mesh.vertexCount());
    std::vector<glm::vec3> normals(mesh.vertexCount());
    SkinJob{&mesh, palette, positions, normals}.run();
    const auto lowest = std::ranges::min_element(positions, {}, &glm::vec3::z);
    return lowest == positions.end() ? pose : placed(pose, {0.0F, 0.0F, -lowest->z});
}

} // namespace posewire::render::test
