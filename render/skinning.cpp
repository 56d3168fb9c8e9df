// SPDX-License-Identifier: MIT
#include "render/skinning.h"

#include "render/mesh/finite.h"
#include "render/mesh/null_pose_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace posewire::render {
namespace {

std::optional<glm::quat> unitQuaternion(const glm::quat& q) {
    const float length = glm::length(q);
    if (!std::isfinite(length) || length < 1e-6F) {
        return std::nullopt;
    }
    return q / length;
}

/// The part of a rotation that turns about the axis (swing-twist decomposition).
glm::quat twistAbout(const glm::quat& rotation, const glm::vec3& axis) {
    const float along = glm::dot(glm::vec3(rotation.x, rotation.y, rotation.z), axis);
    const glm::vec3 v = axis * along;
    // Half a turn about an axis across the bone has no twist to speak of.
    return unitQuaternion({rotation.w, v.x, v.y, v.z}).value_or(glm::quat(1.0F, 0.0F, 0.0F, 0.0F));
}

glm::quat alignedSign(const glm::quat& q, const glm::quat& reference) {
    return glm::dot(q, reference) < 0.0F ? -q : q;
}

/// Rotations and places in the world of joints that hang on one another.
template <std::size_t Count>
struct Placed {
    std::array<glm::quat, Count> rotations;
    std::array<glm::vec3, Count> places;
};

using PlacedBody = Placed<kSegmentCount>;
using PlacedHand = Placed<kHandSegmentCount>;

PlacedBody placedBody(const PaletteJob& job) {
    PlacedBody body;
    for (std::size_t i = 0; i < kSegmentCount; ++i) {
        const int parent = kSegmentParents[i];
        const glm::quat parentRotation =
            parent < 0 ? glm::quat(1.0F, 0.0F, 0.0F, 0.0F) : body.rotations[parent];
        const glm::vec3 rest =
            parent < 0 ? job.origins[i]
                       : body.places[parent] + parentRotation * (job.origins[i] - job.origins[parent]);
        body.rotations[i] =
            alignedSign(unitQuaternion(job.orientations[i]).value_or(parentRotation), parentRotation);
        body.places[i] = isFinite(job.positions[i]) ? job.positions[i] : rest;
    }
    return body;
}

/// A segment's rotation against its parent without the twist about its bone.
glm::quat swingOf(const PlacedBody& body, Segment segment, const glm::vec3& axis) {
    const glm::quat& parent = body.rotations[kSegmentParents[segment]];
    const glm::quat relative = glm::conjugate(parent) * body.rotations[segment];
    return relative * glm::conjugate(twistAbout(relative, axis));
}

void placeTwistJoints(const PaletteJob& job, const PlacedBody& body) {
    for (std::size_t i = 0; i < kTwistJointCount; ++i) {
        const auto [segment, axis] = kTwistJoints[i];
        const glm::quat& parent = body.rotations[kSegmentParents[segment]];
        const glm::quat rotation =
            alignedSign(parent * swingOf(body, segment, axis), body.rotations[segment]);
        job.palette[kSegmentCount + i] = rigidMotion(rotation, job.origins[segment], body.places[segment]);
    }
}

/// How far the flesh of a shoulder gives way, in metres on the reference body and in the parent's frame, for
/// a left arm that points along `bone` (unit): one that hangs takes the shoulder down with it, one that is
/// raised draws in the skin below it.
glm::vec3 shoulderShift(const glm::vec3& bone) {
    const float down = std::max(-bone.z, 0.0F);
    const float up = std::max(bone.z, 0.0F);
    return down * down * glm::vec3(0.0F, -0.016F, -0.020F) + up * up * glm::vec3(0.0F, -0.046F, 0.0F);
}

void placeHalfJoints(const PaletteJob& job, const PlacedBody& body) {
    for (std::size_t i = 0; i < kHalfJointCount; ++i) {
        const Segment segment = kHalfJoints[i];
        const auto parent = static_cast<std::size_t>(kSegmentParents[segment]);
        const bool isArm = segment == RightUpperArm || segment == LeftUpperArm;
        const glm::vec3 axis = isArm ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(0.0F, 0.0F, 1.0F);
        const glm::quat swing = swingOf(body, segment, axis);
        const glm::quat half = glm::normalize(swing + glm::quat(1.0F, 0.0F, 0.0F, 0.0F));
        glm::vec3 place = body.places[segment];
        if (isArm) {
            const glm::vec3 mirror(1.0F, segment == LeftUpperArm ? 1.0F : -1.0F, 1.0F);
            const float size = glm::distance(job.origins[segment], job.origins[parent]) /
                               glm::distance(kReferenceNullPose[segment], kReferenceNullPose[parent]);
            place +=
                body.rotations[parent] * (size * mirror * shoulderShift(mirror * (swing * (mirror * axis))));
        }
        job.palette[kFirstHalfJoint + i] =
            rigidMotion(body.rotations[parent] * half, job.origins[segment], place);
    }
}

/// A left hand at rest: turns against the parent segment as rotation vectors in degrees.
constexpr std::array<glm::vec3, kHandSegmentCount> kRelaxedHand{{
    {0.0F, 0.0F, 0.0F},  {0.0F, 18.0F, 6.0F},   {0.0F, 6.0F, 8.0F},   {-6.0F, 4.0F, 14.0F},
    {0.0F, 0.0F, 0.0F},  {-16.0F, 0.0F, 3.0F},  {-24.0F, 0.0F, 0.0F}, {-13.0F, 0.0F, 0.0F},
    {0.0F, 0.0F, 0.0F},  {-22.0F, 0.0F, 1.0F},  {-29.0F, 0.0F, 0.0F}, {-16.0F, 0.0F, 0.0F},
    {0.0F, 0.0F, 0.0F},  {-27.0F, 0.0F, -1.0F}, {-31.0F, 0.0F, 0.0F}, {-17.0F, 0.0F, 0.0F},
    {-2.0F, 0.0F, 0.0F}, {-30.0F, 0.0F, -4.0F}, {-31.0F, 0.0F, 0.0F}, {-17.0F, 0.0F, 0.0F},
}};

using HandRotations = std::array<glm::quat, kHandSegmentCount>;

const HandRotations& relaxedHand(bool isLeft) {
    const auto turns = [](const glm::vec3& mirror) {
        HandRotations rotations;
        for (std::size_t finger = 0; finger < kHandSegmentCount; ++finger) {
            const glm::vec3 turn = mirror * glm::radians(kRelaxedHand[finger]);
            const float angle = glm::length(turn);
            rotations[finger] =
                angle > 0.0F ? glm::angleAxis(angle, turn / angle) : glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
        }
        return rotations;
    };
    static const HandRotations kLeft = turns({1.0F, 1.0F, 1.0F});
    static const HandRotations kRight = turns({-1.0F, 1.0F, -1.0F});
    return isLeft ? kLeft : kRight;
}

void placeHand(const PaletteJob& job, const PlacedBody& body, std::span<const glm::vec3> origins,
               Segment hand) {
    const bool isLeft = hand == LeftHand;
    const FingerPose& pose = isLeft ? job.leftHand : job.rightHand;
    const std::size_t first = kFirstFingerJoint + (isLeft ? 0U : kHandSegmentCount);
    PlacedHand fingers;
    for (std::size_t i = 0; i < kHandSegmentCount; ++i) {
        const int parent = kFingerParents[i];
        const glm::quat parentRotation = parent < 0 ? body.rotations[hand] : fingers.rotations[parent];
        const glm::vec3 parentOrigin = parent < 0 ? job.origins[hand] : origins[parent];
        const glm::vec3 origin = origins[i];
        fingers.places[i] = (parent < 0 ? body.places[hand] : fingers.places[parent]) +
                            parentRotation * (origin - parentOrigin);
        fingers.rotations[i] = parentRotation;
        if (!pose.isPresent()) {
            fingers.rotations[i] = parentRotation * relaxedHand(isLeft)[i];
        } else {
            fingers.rotations[i] =
                alignedSign(unitQuaternion(pose.orientations[i]).value_or(parentRotation), parentRotation);
            fingers.places[i] = isFinite(pose.positions[i]) ? pose.positions[i] : fingers.places[i];
        }
        job.palette[first + i] = rigidMotion(fingers.rotations[i], origin, fingers.places[i]);
    }
}

bool isWhole(const FingerPose& pose) {
    return pose.positions.size() == pose.orientations.size() &&
           (pose.positions.empty() || pose.positions.size() == kHandSegmentCount);
}

glm::vec3 rotate(const glm::vec4& q, const glm::vec3& v) {
    const glm::vec3 axis(q);
    return v + 2.0F * glm::cross(axis, glm::cross(axis, v) + q.w * v);
}

DualQuaternion blend(std::span<const DualQuaternion> palette, const JointIndices& joints,
                     const glm::vec4& weights) {
    DualQuaternion sum{glm::vec4(0.0F), glm::vec4(0.0F)};
    const glm::vec4& pivot = palette[joints[0]].real;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const DualQuaternion& joint = palette[joints[i]];
        const float weight = weights[static_cast<int>(i)];
        const float signedWeight = glm::dot(joint.real, pivot) < 0.0F ? -weight : weight;
        sum.real += signedWeight * joint.real;
        sum.dual += signedWeight * joint.dual;
    }
    const float length = glm::length(sum.real);
    return {sum.real / length, sum.dual / length};
}

} // namespace

DualQuaternion rigidMotion(const glm::quat& rotation, const glm::vec3& origin, const glm::vec3& position) {
    const glm::vec3 t = position - rotation * origin;
    const glm::quat dual = glm::quat(0.0F, t.x, t.y, t.z) * rotation * 0.5F;
    return {{rotation.x, rotation.y, rotation.z, rotation.w}, {dual.x, dual.y, dual.z, dual.w}};
}

glm::vec3 transformPoint(const DualQuaternion& motion, const glm::vec3& point) {
    const glm::vec3 real(motion.real);
    const glm::vec3 dual(motion.dual);
    const glm::vec3 translation =
        2.0F * (motion.real.w * dual - motion.dual.w * real + glm::cross(real, dual));
    return rotate(motion.real, point) + translation;
}

tl::expected<void, std::string> PaletteJob::validate() const {
    if (positions.size() != kSegmentCount || orientations.size() != kSegmentCount ||
        origins.size() != kSegmentCount) {
        return tl::make_unexpected("a palette needs the pose and the origins of 23 segments");
    }
    if (palette.size() != kJointCount) {
        return tl::make_unexpected("a palette has " + std::to_string(kJointCount) + " joints");
    }
    if (!isWhole(leftHand) || !isWhole(rightHand)) {
        return tl::make_unexpected("a hand has 20 segments, or none is known");
    }
    if (!fingerOrigins.empty() && fingerOrigins.size() != kFingerJointCount) {
        return tl::make_unexpected("both hands have 40 segments");
    }
    return {};
}

void PaletteJob::run() const {
    const PlacedBody body = placedBody(*this);
    for (std::size_t i = 0; i < kSegmentCount; ++i) {
        palette[i] = rigidMotion(body.rotations[i], origins[i], body.places[i]);
    }
    placeTwistJoints(*this, body);
    placeHalfJoints(*this, body);
    const FingerOrigins fitted = fingerOrigins.empty() ? fittedFingers(origins) : FingerOrigins{};
    const std::span<const glm::vec3> fingers = fingerOrigins.empty() ? std::span(fitted) : fingerOrigins;
    placeHand(*this, body, fingers.first(kHandSegmentCount), LeftHand);
    placeHand(*this, body, fingers.last(kHandSegmentCount), RightHand);
}

tl::expected<void, std::string> SkinJob::validate() const {
    if (mesh == nullptr) {
        return tl::make_unexpected("there is no mesh to skin");
    }
    if (positions.size() != mesh->vertexCount() || normals.size() != mesh->vertexCount()) {
        return tl::make_unexpected("the output differs in size from the mesh");
    }
    return mesh->validate(palette.size());
}

void SkinJob::run() const {
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const DualQuaternion motion = blend(palette, mesh->joints[i], mesh->weights[i]);
        positions[i] = transformPoint(motion, mesh->positions[i]);
        normals[i] = glm::normalize(rotate(motion.real, mesh->normals[i]));
    }
}

} // namespace posewire::render
