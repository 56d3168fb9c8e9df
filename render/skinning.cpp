// SPDX-License-Identifier: MIT
#include "render/skinning.h"

#include "render/mesh/finite.h"

#include <array>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

namespace posewire::render {
namespace {

std::optional<glm::quat> unitQuaternion(const glm::quat& q) {
    const float length = glm::length(q);
    if (!std::isfinite(length) || length < 1e-6F) {
        return std::nullopt;
    }
    return q / length;
}

/// The motion v → R (v − origin) + position (Kavan et al., Geometric Skinning with Approximate Dual
/// Quaternion Blending).
DualQuaternion makeMotion(const glm::quat& rotation, const glm::vec3& origin, const glm::vec3& position) {
    const glm::vec3 t = position - rotation * origin;
    const glm::quat dual = glm::quat(0.0F, t.x, t.y, t.z) * rotation * 0.5F;
    return {{rotation.x, rotation.y, rotation.z, rotation.w}, {dual.x, dual.y, dual.z, dual.w}};
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
        return tl::make_unexpected("a palette has 29 joints");
    }
    return {};
}

void PaletteJob::run() const {
    std::array<glm::quat, kSegmentCount> rotations;
    std::array<glm::vec3, kSegmentCount> places;
    for (std::size_t i = 0; i < kSegmentCount; ++i) {
        const int parent = kSegmentParents[i];
        const glm::quat parentRotation = parent < 0 ? glm::quat(1.0F, 0.0F, 0.0F, 0.0F) : rotations[parent];
        const glm::vec3 rest =
            parent < 0 ? origins[i] : places[parent] + parentRotation * (origins[i] - origins[parent]);
        rotations[i] = alignedSign(unitQuaternion(orientations[i]).value_or(parentRotation), parentRotation);
        places[i] = isFinite(positions[i]) ? positions[i] : rest;
        palette[i] = makeMotion(rotations[i], origins[i], places[i]);
    }
    for (std::size_t i = 0; i < kTwistJointCount; ++i) {
        const auto [segment, axis] = kTwistJoints[i];
        const glm::quat& parent = rotations[kSegmentParents[segment]];
        const glm::quat relative = glm::conjugate(parent) * rotations[segment];
        const glm::quat swing = relative * glm::conjugate(twistAbout(relative, axis));
        palette[kSegmentCount + i] =
            makeMotion(alignedSign(parent * swing, rotations[segment]), origins[segment], places[segment]);
    }
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
